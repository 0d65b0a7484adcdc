#include "net/drive_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <sstream>

#include "config/base/content_hash.h"
#include "net/channels.h"
#include "net/wire.h"
#include "tests/net/sample.h"

namespace phare {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Runs a command, gives its standard output; nullopt when it fails.
std::optional<std::string> output_of(const std::string& command) {
  std::FILE* const pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  char piece[4096];
  while (const std::size_t count = std::fread(piece, 1, sizeof piece, pipe)) text.append(piece, count);
  return pclose(pipe) == 0 ? std::optional(text) : std::nullopt;
}

bool installed(const std::string& program) {
  return output_of("command -v " + program).has_value();
}

class DriveFile : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / ("phare_drive_" + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
    path_ = directory_ / "test.drive.pcap";
    std::int64_t ns = 0;
    for (Datagram datagram : test::samples(11)) {
      datagram.sim_time.ns = ns;
      ns += 1'000'000'007;
      written_.push_back(datagram);
    }
    auto writer = DriveWriter::create(path_, 47000);
    ASSERT_TRUE(writer) << writer.error().text();
    record_ends_.push_back(std::filesystem::file_size(path_));
    for (const Datagram& datagram : written_) {
      const Status status = writer->write(datagram, test::view(encode(datagram)));
      ASSERT_TRUE(status) << status.error().text();
      record_ends_.push_back(std::filesystem::file_size(path_));  // on disk as soon as written
    }
    writer->close();
    EXPECT_FALSE(writer->write(written_[0], test::view(encode(written_[0]))));
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path directory_;
  std::filesystem::path path_;
  std::vector<Datagram> written_;
  std::vector<std::uintmax_t> record_ends_;
};

TEST_F(DriveFile, ComesBackAsWritten) {
  const auto drive = read_drive(path_);
  ASSERT_TRUE(drive) << drive.error().text();
  EXPECT_FALSE(drive->cut);
  EXPECT_EQ(drive->refused, 0u);
  ASSERT_EQ(drive->datagrams.size(), written_.size());
  for (std::size_t i = 0; i < written_.size(); ++i) EXPECT_TRUE(test::equal(drive->datagrams[i], written_[i])) << i;
  EXPECT_EQ(drive->duration, written_.back().sim_time);
  EXPECT_EQ(drive->content_hash, content_hash(test::view(contents(path_))));
}

TEST_F(DriveFile, CutAnywhereOpensUpToItsLastWholeRecord) {
  const std::string whole = contents(path_);
  ASSERT_EQ(whole.size(), record_ends_.back());
  const std::filesystem::path cut_path = directory_ / "cut.pcap";
  std::size_t records = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    if (records < written_.size() && size >= record_ends_[records + 1]) ++records;
    write(cut_path, whole.substr(0, size));
    const auto drive = read_drive(cut_path);
    ASSERT_TRUE(drive) << size << ": " << drive.error().text();
    ASSERT_EQ(drive->datagrams.size(), records) << "cut at " << size;
    ASSERT_EQ(drive->refused, 0u);
    const bool at_border = size == record_ends_[records];
    ASSERT_EQ(drive->cut, !at_border) << "cut at " << size;
  }
}

TEST_F(DriveFile, IsRefusedWhenItIsNone) {
  const std::filesystem::path other = directory_ / "other";
  write(other, "IESNA:LM-63-2002\n[TEST] a lamp, not a drive\n");
  const auto text = read_drive(other);
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().text().find("no drive file"), std::string::npos) << text.error().text();
  write(other, "IES");
  EXPECT_FALSE(read_drive(other));
  EXPECT_FALSE(read_drive(directory_));
  EXPECT_FALSE(read_drive(directory_ / "absent"));
  EXPECT_FALSE(DriveWriter::create(directory_ / "absent" / "file", 47000));
}

TEST_F(DriveFile, DamageNeverCrashes) {
  const std::string whole = contents(path_);
  const std::filesystem::path damaged = directory_ / "damaged.pcap";
  std::mt19937_64 random(12);
  for (int round = 0; round < 300; ++round) {
    std::string bytes = whole;
    for (std::uint64_t flips = 1 + random() % 4; flips > 0; --flips) {
      const std::size_t bit = random() % (bytes.size() * 8);
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    }
    write(damaged, bytes);
    const auto drive = read_drive(damaged);
    if (!drive) continue;
    for (const Datagram& datagram : drive->datagrams) ASSERT_EQ(check(datagram), Refusal::kNone);
  }
}

TEST_F(DriveFile, WithMicrosecondStampsOrFromTcpdumpIsReadToo) {
  std::string bytes = contents(path_);
  bytes[0] = '\xd4', bytes[1] = '\xc3', bytes[2] = '\xb2', bytes[3] = '\xa1';
  const std::filesystem::path micro = directory_ / "micro.pcap";
  write(micro, bytes);
  const auto drive = read_drive(micro);
  ASSERT_TRUE(drive) << drive.error().text();
  EXPECT_EQ(drive->datagrams.size(), written_.size());
  EXPECT_EQ(drive->duration, written_.back().sim_time);
}

TEST_F(DriveFile, HoldsForeignPacketsAsRefused) {
  auto writer = DriveWriter::create(path_, 47000);
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write(written_[0], test::view(encode(written_[0]))));
  ASSERT_TRUE(writer->write(written_[1], test::view("something else")));
  ASSERT_TRUE(writer->write(written_[2], {}));
  writer->close();
  const auto drive = read_drive(path_);
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->datagrams.size(), 1u);
  EXPECT_EQ(drive->refused, 2u);
  Datagram before_start = written_[0];
  before_start.sim_time.ns = -1;
  auto again = DriveWriter::create(path_, 47000);
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->write(before_start, test::view(encode(before_start))));
}

TEST_F(DriveFile, SaysWhenTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_FALSE(DriveWriter::create("/dev/full", 47000));
}

TEST_F(DriveFile, TsharkReadsPortsStampsAndChecksums) {
  if (!installed("tshark")) GTEST_SKIP() << "tshark is not installed";
  const auto text =
      output_of("tshark -n -r " + path_.string() +
                " -o ip.check_checksum:TRUE -T fields -e frame.time_epoch -e ip.src -e udp.srcport -e udp.dstport"
                " -e ip.checksum.status -e udp.length");
  ASSERT_TRUE(text);
  std::istringstream lines(*text);
  std::string line;
  for (const Datagram& datagram : written_) {
    ASSERT_TRUE(std::getline(lines, line));
    char expected[200];
    const bool to_recorder = kChannels[datagram.payload.index()].receivers.has(Role::kRecorder);
    std::snprintf(expected, sizeof expected, "%lld.%09lld\t127.0.0.1\t%d\t%d\t1\t%zu",
                  static_cast<long long>(datagram.sim_time.ns / 1'000'000'000),
                  static_cast<long long>(datagram.sim_time.ns % 1'000'000'000),
                  47000 + port_offset_of_sender(datagram.sender, datagram.sender_channel), to_recorder ? 47002 : 47010,
                  encode(datagram).size() + 8);
    EXPECT_EQ(line, expected);
  }
}

TEST_F(DriveFile, EditcapCutsItAndWeReadWhatIsLeft) {
  if (!installed("editcap")) GTEST_SKIP() << "editcap is not installed";
  for (const char* format : {"nsecpcap", "pcap", "pcapng"}) {
    const std::filesystem::path out = directory_ / "edited.pcap";
    ASSERT_TRUE(output_of(std::string("editcap -F ") + format + " -r " + path_.string() + " " + out.string() + " 2-4"));
    const auto drive = read_drive(out);
    ASSERT_TRUE(drive) << format << ": " << drive.error().text();
    EXPECT_FALSE(drive->cut) << format;
    ASSERT_EQ(drive->datagrams.size(), 3u) << format;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(test::equal(drive->datagrams[i], written_[i + 1])) << format;
  }
}

TEST(ContentHash, IsSha256) {
  // FIPS 180-4 examples
  EXPECT_EQ(content_hash(test::view("abc")), "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(content_hash({}), "sha256:e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_FALSE(content_hash_of_file("/nowhere/at/all"));
}

}  // namespace
}  // namespace phare
