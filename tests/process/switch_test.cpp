// process: the stalk of a candump log moves the beam of a drive, and the first frame due at or after that moment shows
// it. Counted by the program in report.json, and seen in the pictures.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFrames = 48;  // 0.8 s at 60 Hz

struct Move {
  int at_ms = 0;
  int beam = 2;  ///< BEAM_SWITCH of phare_stalk.dbc: 2 low, 3 high
  bool flash = false;
};

/// The three messages of phare_stalk.dbc every 20 ms, the stalk's also at once when it moves; ignition on, wheel
/// straight, no pedal.
void write_log(const fs::path& file, const std::vector<Move>& moves) {
  std::ofstream log(file);
  const auto write = [&](int at_ms, unsigned id, unsigned first_bytes) {
    char line[64];
    std::snprintf(line, sizeof line, "(1700000000.%03d000) can0 %03X#%04X000000000000\n", at_ms, id, first_bytes);
    log << line;
  };
  std::size_t now = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    const bool moved = now + 1 < moves.size() && moves[now + 1].at_ms == ms;
    if (moved) ++now;
    const unsigned stalk = static_cast<unsigned>(moves[now].beam) | (moves[now].flash ? 4u : 0u);
    if (moved || ms % 20 == 0) write(ms, 0x500, stalk << 8 | 1u);
    if (ms % 20 == 0) write(ms, 0x501, 0), write(ms, 0x502, 0);
  }
}

json drive_log(const TemporaryFolder& folder, const std::string& name, const std::vector<Move>& moves) {
  write_log(folder / (name + ".log"), moves);
  const std::string cockpit = source_dir() + "/config/cockpits/phare_stalk.toml";
  EXPECT_EQ(
      drive(folder / name, folder.path(),
            {"--frames", std::to_string(kFrames), "--log", (folder / (name + ".log")).string(), "--cockpit", cockpit}),
      0);
  return report_of(folder / name);
}

TEST(SwitchToPhoton, TheFirstFrameAfterTheStalkShowsTheNewBeam) {
  const TemporaryFolder folder;
  const json still = drive_log(folder, "still", {{0, 2, false}});
  // High at 205 ms, low at 400 ms, on a frame's own moment (frame 24), a flash from 507 to 623 ms.
  const json moved =
      drive_log(folder, "moved", {{0, 2, false}, {205, 3, false}, {400, 2, false}, {507, 2, true}, {623, 2, false}});
  EXPECT_EQ(still["summary"]["switch_to_photon"]["changes"], 0);

  const json& switches = moved["summary"]["switch_to_photon"];
  EXPECT_EQ(switches["changes"], 4);
  std::uint64_t within_two = 0;
  for (const auto& [frames, changes] : switches["frames"].items()) {
    EXPECT_LE(std::stoi(frames), 2);
    within_two += changes.get<std::uint64_t>();
  }
  EXPECT_EQ(within_two, 4u);
  std::printf("switch to photon: %s frames, %.1f ms median, %.1f ms at most\n", switches["frames"].dump().c_str(),
              switches["ms"]["median"].get<double>(), switches["ms"]["max"].get<double>());

  // Frame k is due at k/60 s: high from 12.3, low from 24, flash from 30.4 to 37.4.
  const auto without = pictures_of(folder / "still"), with = pictures_of(folder / "moved");
  ASSERT_EQ(without.size(), with.size());
  for (int frame = 0; frame < kFrames; ++frame) {
    const bool high = (frame >= 13 && frame < 24) || (frame >= 31 && frame < 38);
    char name[40];
    std::snprintf(name, sizeof name, "frames/%06d.png", frame);
    EXPECT_EQ(without.at(name) != with.at(name), high) << name;
  }
  std::ifstream page(folder / "moved/index.html");
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  EXPECT_NE(html.find("Light switch to photon"), std::string::npos);
}

}  // namespace
}  // namespace phare::test
