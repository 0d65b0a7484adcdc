// reference: logs of other makers than candump, written by python-can itself and read back; what is said where it is
// missing. Skips where no Python environment can be had.
#include "cockpit_io/can_log.h"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/cockpit_io/oracle.h"
#include "tests/paths.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

class CanLogs : public testing::Test {
 protected:
  CanLogs() : folder_(fs::temp_directory_path() / ("phare-can-log-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    spdlog::set_level(spdlog::level::off);
  }
  ~CanLogs() override {
    spdlog::set_level(spdlog::level::info);
    unsetenv("PHARE_PYTHON");
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  /// A program in the place of Python.
  void python_is(const std::string& script) {
    std::ofstream(folder_ / "python") << "#!/bin/sh\n" << script;
    fs::permissions(folder_ / "python", fs::perms::owner_all);
    setenv("PHARE_PYTHON", (folder_ / "python").c_str(), 1);
  }
  fs::path touched(const std::string& name) {
    std::ofstream(folder_ / name) << "x";
    return folder_ / name;
  }
  fs::path folder_;
};

TEST_F(CanLogs, CandumpsOwnNeedNothing) {
  setenv("PHARE_PYTHON", "/nowhere", 1);
  const auto log = read_can_log(source_dir() + "/config/examples/stalk.log");
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->log.entries.size(), 480u);
  EXPECT_EQ(log->read_with, "");
}

TEST_F(CanLogs, WhatIsMissingIsNamedWithItsPackage) {
  setenv("PHARE_PYTHON", "/nowhere", 1);
  const fs::path blf = touched("it's a drive.blf");
  EXPECT_NE(read_can_log(blf).error().text().find("apt-get install python3-can"), std::string::npos);
  python_is("echo '#missing'");
  EXPECT_NE(read_can_log(blf).error().text().find("is read with python-can; apt-get install python3-can"),
            std::string::npos);
  EXPECT_NE(read_can_log(folder_ / "none.asc").error().text().find("no such file"), std::string::npos);
}

TEST_F(CanLogs, ALogThatBreaksOffIsUsedUpToThere) {
  python_is("echo '#with python-can 9, BLFReader'; echo '(1.5) can0 123#00'; echo '#failed cut short'");
  const auto log = read_can_log(touched("a.BLF"));
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->log.entries.size(), 1u);
  EXPECT_EQ(log->log.broken_lines, 1u);
  EXPECT_EQ(log->log.problems.back().reason, "python-can 9, BLFReader breaks off here: cut short");
  EXPECT_EQ(log->read_with, "python-can 9, BLFReader");
  python_is("echo '#with python-can 9, BLFReader'; printf '(1.5) can0 123#00\\n(2.5) can0 1'; kill -KILL $$");
  const auto killed = read_can_log(touched("a.BLF"));
  ASSERT_TRUE(killed) << killed.error().text();
  EXPECT_EQ(killed->log.entries.size(), 1u);
  // Its lines are not the log's: its frames are counted.
  python_is("echo '#with python-can 9, BLFReader'; printf '(2.5) 0 123#00\\n(1.5) 0 123#00\\n'");
  const auto said = doubts(read_can_log(touched("a.BLF"))->log);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("a.BLF: frame 2: the stamp goes back by 1.000000 s"), std::string::npos) << said[0];
  EXPECT_EQ(killed->log.problems.back().reason,
            "python-can 9, BLFReader breaks off here: Python was ended before the end of the log");
  python_is("echo '#with python-can 4.1.0'; echo '#failed no such format'");
  EXPECT_NE(read_can_log(touched("a.mf4")).error().text().find("python-can 4.1.0: no such format"), std::string::npos);
}

// A drive that the format's own writer has written, as candump's log has it; stamps to the format's own steps.
void says_what_candump_says(const fs::path& folder, const std::string& python, const std::string& ending) {
  setenv("PHARE_PYTHON", python.c_str(), 1);
  // Classic frames of 11 and 29 bits. A TRC file of python-can begins at its first frame.
  const fs::path candump = folder / "drive.log", file = folder / ("drive." + ending);
  std::ofstream(candump) << "(1700000000.000000) can0 123#0102030405060708\n(1700000000.010000) can0 18FEF100#AA\n"
                            "(1700000000.020500) can0 7FF#\n(1700000003.250000) can0 200#FFFF\n";
  const auto want = read_can_log(candump);
  ASSERT_TRUE(want);
  const std::string command = "'" + python +
                              "' -c 'import can,sys\nw = can.Logger(sys.argv[2])\n"
                              "for m in can.LogReader(sys.argv[1]):\n  m.is_rx = True\n  w(m)\nw.stop()' '" +
                              candump.string() + "' '" + file.string() + "' 2>&1";
  const auto [out, failed] = output_of(command);
  ASSERT_EQ(failed, 0) << out;
  const auto got = read_can_log(file);
  ASSERT_TRUE(got) << got.error().text();
  EXPECT_NE(got->read_with.find("Reader"), std::string::npos) << got->read_with;
  ASSERT_EQ(got->log.entries.size(), want->log.entries.size());
  EXPECT_EQ(got->log.broken_lines, 0u);
  for (std::size_t i = 0; i < want->log.entries.size(); ++i) {
    const CandumpEntry &a = want->log.entries[i], &b = got->log.entries[i];
    EXPECT_EQ(a.frame.id, b.frame.id) << i;
    EXPECT_EQ(a.frame.extended, b.frame.extended);
    EXPECT_EQ(a.frame.length, b.frame.length);
    EXPECT_EQ(a.frame.data, b.frame.data);
    const std::int64_t since_a = a.stamp_ns - want->log.entries[0].stamp_ns,
                       since_b = b.stamp_ns - got->log.entries[0].stamp_ns;
    EXPECT_NEAR(static_cast<double>(since_a), static_cast<double>(since_b), 110'000.0) << "TRC has 0.1 ms";
  }
  std::printf("%s: %s\n", ending.c_str(), got->read_with.c_str());
}

TEST_F(CanLogs, VectorAndPeakLogsSayWhatCandumpSays) {
  const auto [why, status] = make_oracle_venv();
  if (status != 0) GTEST_SKIP() << "no Python environment: " << why;
  for (const char* ending : {"asc", "blf", "trc"}) {
    SCOPED_TRACE(ending);
    says_what_candump_says(folder_, build_root("oracle") + "/bin/python", ending);
  }
}

// Vector's relative stamps count from the event above, also from those that are no frames.
TEST_F(CanLogs, RelativeStampsOfAnAscLogAreAddedUp) {
  const auto [why, status] = make_oracle_venv();
  if (status != 0) GTEST_SKIP() << "no Python environment: " << why;
  setenv("PHARE_PYTHON", (build_root("oracle") + "/bin/python").c_str(), 1);
  const auto stamps_of = [&](const std::string& kind) {
    std::ofstream(folder_ / "drive.ASC") << "date Mon Nov 23 08:00:00.000 2026\nbase hex  timestamps " + kind +
                                                "\ninternal events logged\n"
                                                "Begin Triggerblock Mon Nov 23 08:00:00.000 2026\n"
                                                "   0.000000 Start of measurement\n"
                                                "   0.010000 1  123             Rx   d 2 01 02\n"
                                                "   0.010000 1  123             Rx   d 2 01 03\n"
                                                "   0.004000 1  Statistic: D 2 R 0 XD 0 XR 0 E 0 O 0 B 0.10%\n"
                                                "   0.006000 2  123             Rx   d 2 01 04\nEnd TriggerBlock\n";
    const auto log = read_can_log(folder_ / "drive.ASC");
    EXPECT_TRUE(log) << log.error().text();
    std::vector<std::int64_t> stamps_us;
    for (const CandumpEntry& entry : log->log.entries) stamps_us.push_back(entry.stamp_ns / 1000);
    EXPECT_EQ(log->log.interfaces.size(), 2u);
    return stamps_us;
  };
  EXPECT_EQ(stamps_of("relative"), (std::vector<std::int64_t>{10'000, 20'000, 30'000}));
  EXPECT_EQ(stamps_of("absolute"), (std::vector<std::int64_t>{10'000, 10'000, 6'000}));
}

TEST_F(CanLogs, ABlfFileThatIsCutOffIsTold) {
  const auto [why, status] = make_oracle_venv();
  if (status != 0) GTEST_SKIP() << "no Python environment: " << why;
  const std::string python = build_root("oracle") + "/bin/python";
  setenv("PHARE_PYTHON", python.c_str(), 1);
  const fs::path whole = folder_ / "whole.blf", cut = folder_ / "cut.blf", unsaid = folder_ / "unsaid.blf";
  const auto [out, failed] =
      output_of("'" + python +
                "' -c 'import can,struct,sys\nw = can.Logger(sys.argv[1])\n"
                "for i in range(500): w(can.Message(arbitration_id=0x123, timestamp=1.7e9 + i, data=[i * 37 & 255, i * "
                "91 & 255]))\n"
                "w.stop()\ndata = open(sys.argv[1], \"rb\").read()[:-150]\nopen(sys.argv[2], \"wb\").write(data)\n"
                "open(sys.argv[3], \"wb\").write(data[:16] + struct.pack(\"<Q\", 144) + data[24:])' '" +
                whole.string() + "' '" + cut.string() + "' '" + unsaid.string() + "' 2>&1");
  ASSERT_EQ(failed, 0) << out;
  const auto good = read_can_log(whole);
  ASSERT_TRUE(good) << good.error().text();
  EXPECT_EQ(good->log.entries.size(), 500u);
  EXPECT_EQ(good->log.broken_lines, 0u);
  const std::uintmax_t size = fs::file_size(whole);
  const std::string by_header =
      "the file is cut off, " + std::to_string(size - 150) + " of its " + std::to_string(size) + " bytes are there";
  // A logger that lost its power has not written the size: the last object is longer than the file.
  for (const auto& [file, reason] :
       {std::pair(cut, by_header), std::pair(unsaid, std::string("the file is cut off within "))}) {
    const auto read = read_can_log(file);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_GT(read->log.entries.size(), 0u);
    EXPECT_LT(read->log.entries.size(), 500u);
    ASSERT_EQ(read->log.broken_lines, 1u);
    EXPECT_NE(read->log.problems.back().reason.find("BLFReader breaks off here: " + reason), std::string::npos)
        << read->log.problems.back().reason;
  }
}

TEST_F(CanLogs, Mf4SaysWhatCandumpSays) {
  const auto [why, status] = make_mf4_venv();
  if (status != 0) GTEST_SKIP() << "no Python environment with asammdf: " << why;
  says_what_candump_says(folder_, build_root("oracle_mf4") + "/bin/python", "mf4");
}

// An environment's python3 (pyenv, conda) comes first in PATH and has no python-can: the one that the remedy installs
// is asked then.
TEST_F(CanLogs, DebiansPythonIsAskedWhereAnotherHidesIt) {
  if (std::system("/usr/bin/python3 -c 'import can' >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no python3-can of Debian's";
  python_is("echo '#missing'");
  fs::rename(folder_ / "python", folder_ / "python3");
  unsetenv("PHARE_PYTHON");
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder_.string() + ":" + path).c_str(), 1);
  std::ofstream(folder_ / "drive.asc") << "date Mon Nov 23 08:00:00.000 2026\nbase hex  timestamps absolute\n"
                                          "internal events logged\nBegin Triggerblock Mon Nov 23 08:00:00.000 2026\n"
                                          "   0.000000 Start of measurement\n"
                                          "   0.010000 1  123             Rx   d 2 01 02\n"
                                          "   0.020500 1  18FEF100x       Rx   d 1 AA\nEnd TriggerBlock\n";
  const auto log = read_can_log(folder_ / "drive.asc");
  EXPECT_TRUE(reads_foreign_can_logs());
  setenv("PATH", path.c_str(), 1);
  ASSERT_TRUE(log) << log.error().text();
  ASSERT_EQ(log->log.entries.size(), 2u);
  EXPECT_EQ(log->log.entries[0].frame.id, 0x123u);
  EXPECT_EQ(log->log.entries[1].frame.id, 0x18FEF100u);
  EXPECT_TRUE(log->log.entries[1].frame.extended);
}

}  // namespace
}  // namespace phare
