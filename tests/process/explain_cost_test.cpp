// process: what --explain --cost says of a moment is what the report of a drive says that ends with it, effect by
// effect.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <sstream>

#include "tests/paths.h"
#include "tests/process/drive_run.h"
#include "visual/effects.h"

namespace phare::test {
namespace {

struct Told {
  int code = -1;
  std::string text;  ///< on stdout and stderr
};

Told told_by(const std::string& command) {
  Told told;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return told;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) told.text.push_back(static_cast<char>(c));
  const int status = pclose(pipe);
  told.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return told;
}

/// `phare drive --headless --lockstep --size 160x90 --explain … words`, after words for env.
Told explain_with(const std::string& words, const std::string& environment = "") {
  return told_by("timeout 110 env -u DISPLAY -u WAYLAND_DISPLAY " + environment + " '" + program("phare") +
                 "' drive --headless --lockstep --size 160x90 --explain " + words + " 2>&1 </dev/null");
}

struct Row {
  std::string level, ms, reason;
  std::uint64_t passes = 0, bytes = 0;
};

/// Lines that begin with a name of 16 letters.
std::map<std::string, Row> rows_of(const std::string& text) {
  std::map<std::string, Row> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.size() < 20 || (line.starts_with("#") && !line.starts_with("# any frame "))) continue;
    const std::string name = line.substr(0, line.find("  "));
    std::istringstream rest(line.substr(16));
    Row row;
    if (!name.starts_with("#")) rest >> row.level;
    rest >> row.passes >> row.bytes >> row.ms >> std::ws;
    std::getline(rest, row.reason);
    rows[name] = row;
  }
  return rows;
}

/// A frame of the demo drive in lockstep, and the same moment.
void expect_same(const std::vector<std::string>& set, const std::vector<std::string>& on) {
  const TemporaryFolder folder;
  std::vector<std::string> drive_words{"--frames", "31"};
  std::string words = "--cost --frames 3 --still-at 0.5";  // frame 30 of 60 a second
  for (const std::string& one : set) {
    drive_words.insert(drive_words.end(), {"--set", one});
    words += " --set " + one;
  }
  ASSERT_EQ(drive(folder / "out", folder.path(), drive_words), 0);
  const nlohmann::json report = report_of(folder / "out")["processes"]["visual-0"];
  ASSERT_NEAR(report["sim_time_s"].get<double>(), 0.5, 1e-9);
  const Told told = explain_with(words);
  ASSERT_EQ(told.code, 0) << told.text;
  const std::map<std::string, Row> rows = rows_of(told.text);
  ASSERT_EQ(rows.size(), kEffectCount + 1) << told.text;
  std::uint64_t passes = rows.at("# any frame").passes;
  for (const nlohmann::json& effect : report["effects"]) {
    const std::string name = effect["name"];
    ASSERT_TRUE(rows.contains(name)) << name;
    const Row& row = rows.at(name);
    EXPECT_EQ(row.level, effect["level"]) << name;
    EXPECT_EQ(row.reason, effect["because"]) << name;
    EXPECT_EQ(row.passes, effect["passes"]) << name;
    EXPECT_EQ(row.bytes, effect["bytes"]) << name;
    EXPECT_EQ(row.ms == "-", row.passes == 0) << name << ": " << row.ms;
    passes += row.passes;
  }
  EXPECT_EQ(passes, report["passes"]) << told.text;
  // The car of the drive is driven, that of the moment recorded: a few of the triangles may be others.
  const std::string drawn = report["draws"].dump() + " draws of ";
  const std::size_t at = told.text.find(drawn);
  ASSERT_NE(at, std::string::npos) << drawn << told.text;
  const double triangles = report["triangles"];
  EXPECT_NEAR(std::stod(told.text.substr(at + drawn.size())), triangles, 0.005 * triangles) << told.text;
  for (const std::string& name : on)
    EXPECT_GT(rows.at(name).passes + rows.at(name).bytes, 0u) << name << " is to be on";
}

TEST(ExplainCost, IsThatOfADriveInClearAir) {
  expect_same({}, {"shadows"});
}

TEST(ExplainCost, IsThatOfADriveInRainBehindAWindscreen) {
  expect_same({"rain_mmph=10", "windscreen=on"}, {"shadows", "hdr image", "fog", "windscreen"});
}

// Other eyes, and what is drawn over the picture.
TEST(ExplainCost, IsThatOfADriveWithMirrorsAndASecondCamera) {
  expect_same({"mirrors=on", "layout=inset", "road_isolux=on", "visibility_m=80"}, {"shadows", "overlay", "fog"});
}

TEST(ExplainCost, IsThatOfADriveWithTwoDesigns) {
  expect_same({"compare=split", "depth_first=on"}, {"shadows", "overlay"});
  expect_same({"compare=difference"}, {"shadows", "overlay"});
}

// Nothing is drawn without --cost, and nothing can be where there is no device.
TEST(ExplainCost, NeedsADevice) {
  const std::string none = "VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json";
  const Told plain = explain_with("--light low", none);
  EXPECT_EQ(plain.code, 0) << plain.text;
  EXPECT_TRUE(plain.text.ends_with("# --explain --cost draws this moment and adds passes, bytes and ms\n"))
      << plain.text;
  const Told cost = explain_with("--light low --cost", none);
  EXPECT_EQ(cost.code, kExitBadInput) << cost.text;
  EXPECT_TRUE(cost.text.starts_with("phare-visual: ")) << cost.text;
  EXPECT_NE(cost.text.find("Vulkan"), std::string::npos) << cost.text;
  EXPECT_EQ(explain_with("--light low --cost --device absent").code, kExitBadInput);
}

// Who explains may be killed, or fall.
TEST(ExplainCost, SaysThatItsProgramWasKilled) {
  const Told told =
      told_by("'" + program("phare") +
              "' drive --headless --size 160x90 --explain --cost --frames 1000000 2>&1 </dev/null & P=$!; "
              "for i in $(seq 400); do "
              "kill -SEGV $(cat /proc/$P/task/$P/children) 2>/dev/null && break; sleep 0.05; done; "
              "wait $P");
  EXPECT_EQ(told.code, kExitCheckFailed) << told.text;
  EXPECT_NE(told.text.find("phare: phare-visual, which explains, ended with SIGSEGV\n"), std::string::npos)
      << told.text;
}

// Who ignores the ends of his children hands that down: ours are heard of all the same.
TEST(Explain, EndsWhereTheCallerIgnoresTheEndsOfChildren) {
  const Told told = explain_with("--light low", "--ignore-signal=CHLD");
  EXPECT_EQ(told.code, 0) << told.text;
}

// While nothing moves a grid of fog is kept: what it took is told.
TEST(ExplainCost, TellsWhatAStandingCarKeeps) {
  const Told told = explain_with("--light low --cost --frames 2 --set visibility_m=80");
  ASSERT_EQ(told.code, 0) << told.text;
  EXPECT_EQ(rows_of(told.text).at("fog").passes, 0u) << told.text;
  EXPECT_NE(told.text.find("# fog: kept from the frame before; 1 pass, "), std::string::npos) << told.text;
}

}  // namespace
}  // namespace phare::test
