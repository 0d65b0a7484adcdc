// Decoding and encoding against cantools (PyPI), bit for bit, on every signal of every DBC file at hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "cockpit_io/dbc.h"
#include "tests/cockpit_io/oracle.h"
#include "tests/paths.h"

namespace phare {
namespace {

const std::filesystem::path kShared = shared_data_dir();
const std::string kVenv = build_root("oracle");
const std::string kTests = tests_dir("cockpit_io");

CanFrame frame_with(const DbcMessage& message, const std::vector<std::uint8_t>& bytes) {
  CanFrame frame;
  frame.id = message.id;
  frame.extended = message.extended;
  frame.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

/// Reads the oracle's records and compares as it goes.
class Comparison {
 public:
  explicit Comparison(const Dbc& dbc) : dbc_(dbc) {}

  void take(const std::string& line) {
    std::istringstream words(line);
    std::string kind, first, second, third;
    words >> kind >> first >> second >> third;
    if (kind == "dropped") {
      dropped.insert(std::stoi(first));
    } else if (kind == "message") {
      end_frame();
      message_ = dbc_.find(static_cast<std::uint32_t>(std::stoul(first)), second == "1");
      EXPECT_NE(message_, nullptr) << line;
      ++messages;
      if (message_ != nullptr) {
        EXPECT_EQ(message_->length_bytes, std::stoul(third)) << line;
      }
    } else if (message_ == nullptr) {
      return;
    } else if (kind == "frame") {
      end_frame();
      frame_ = frame_with(*message_, bytes_of(first));
      in_frame_ = true;
      ++frames;
    } else if (kind == "signal") {
      signal(first, std::stoull(second, nullptr, 16), std::strtod(third.c_str(), nullptr));
    } else if (kind == "encoded" || kind == "scaled") {
      encoded(kind == "scaled", bytes_of(first));
    } else {
      ADD_FAILURE() << line;
    }
  }

  void end_frame() {
    if (!in_frame_) return;
    in_frame_ = false;
    // What cantools does not find in the frame we must not find either.
    for (const DbcSignal& s : message_->signals) {
      if (theirs_.count(s.name) == 0) {
        EXPECT_FALSE(is_present(*message_, s, frame_.bytes())) << message_->name << "." << s.name;
      }
    }
    theirs_.clear();
  }

  std::set<int> dropped;
  std::size_t messages = 0, frames = 0, values = 0, encodings = 0;
  std::set<std::string> seen;  // message.signal

 private:
  void signal(const std::string& name, std::uint64_t raw, double value) {
    const std::string where = dbc_.file.filename().string() + ": " + message_->name + "." + name;
    const DbcSignal* s = message_->find(name);
    ASSERT_NE(s, nullptr) << where;
    EXPECT_TRUE(is_present(*message_, *s, frame_.bytes())) << where;
    EXPECT_EQ(raw_bits(*s, frame_.bytes()), raw) << where;
    const auto decoded = decode(*message_, *s, frame_);
    ASSERT_TRUE(decoded) << where;
    EXPECT_EQ(*decoded, value) << where;  // bit for bit, but for the sign of zero
    theirs_[name] = raw;
    seen.insert(message_->name + "." + name);
    ++values;
  }

  void encoded(bool scaled, const std::vector<std::uint8_t>& expected) {
    CanFrame frame = frame_with(*message_, std::vector<std::uint8_t>(message_->length_bytes));
    for (const auto& [name, raw] : theirs_) {
      const DbcSignal& s = *message_->find(name);
      // A double cannot carry whole numbers beyond 2^53; Python's can, so there only raw bits compare.
      const bool exact =
          s.length_bits <= 53 || !(s.type == DbcSignal::Type::kUnsigned || s.type == DbcSignal::Type::kSigned);
      if (scaled && exact) {
        ASSERT_TRUE(encode(*message_, s, *decode(*message_, s, frame_), frame)) << message_->name << "." << name;
      } else {
        ASSERT_TRUE(encode_raw(*message_, s, raw, frame)) << message_->name << "." << name;
      }
    }
    EXPECT_EQ(frame, frame_with(*message_, expected)) << dbc_.file << " " << message_->name;
    ++encodings;
  }

  const Dbc& dbc_;
  const DbcMessage* message_ = nullptr;
  CanFrame frame_;
  bool in_frame_ = false;
  std::map<std::string, std::uint64_t> theirs_;
};

TEST(DbcOracle, AgreesWithCantoolsOnEverySignalOfEveryFile) {
  if (!std::filesystem::exists(kShared / "dbc")) GTEST_SKIP() << "no " << kShared / "dbc";
  const auto [why, status] = make_oracle_venv();
  if (status == 77) GTEST_SKIP() << "no cantools to compare with: " << why;
  ASSERT_EQ(status, 0) << why;

  std::size_t files = 0, all_signals = 0, all_values = 0, all_encodings = 0;
  for (const char* folder : {"opendbc", "cantools"}) {
    for (const auto& entry : std::filesystem::directory_iterator(kShared / "dbc" / folder)) {
      if (entry.path().extension() != ".dbc") continue;
      SCOPED_TRACE(entry.path().filename().string());
      const auto dbc = read_dbc(entry.path());
      ASSERT_TRUE(dbc.ok()) << dbc.error().text();
      const auto [text, exit] =
          output_of(kVenv + "/bin/python " + kTests + "/dbc_oracle.py '" + entry.path().string() + "'");
      ASSERT_EQ(exit, 0);
      Comparison comparison(*dbc);
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line) && !testing::Test::HasFailure();) comparison.take(line);
      comparison.end_frame();
      // What cantools' grammar refuses, our reader reports.
      for (const int dropped : comparison.dropped) {
        const bool reported = std::any_of(dbc->problems.begin(), dbc->problems.end(),
                                          [&](const DbcProblem& problem) { return problem.line == dropped; });
        EXPECT_TRUE(reported) << entry.path() << ":" << dropped;
      }
      EXPECT_EQ(comparison.messages, dbc->messages.size());
      EXPECT_EQ(comparison.seen.size(), dbc->signal_count()) << "every signal was compared";
      ++files;
      all_signals += comparison.seen.size();
      all_values += comparison.values;
      all_encodings += comparison.encodings;
      ASSERT_FALSE(testing::Test::HasFailure());
    }
  }
  std::printf("%zu files, %zu signals: %zu values and %zu encoded frames equal\n", files, all_signals, all_values,
              all_encodings);
  EXPECT_GE(files, 16u);
}

}  // namespace
}  // namespace phare
