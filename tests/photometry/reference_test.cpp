// The float64 path against the photometry reference set (an independent program's values, see its README): intensities
// of every LM-63 file, illuminance on road, wall and plates, hard single-lamp cases, and flux.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "photometry_test_files.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/table/illuminance.h"

namespace phare {
namespace {

using test::Csv;
using test::shared_data;

constexpr double kTolerance = 1e-10;  // relative; the set's own limit for a double reference

glm::dvec3 vector_of(const nlohmann::json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

class Reference : public ::testing::Test {
 protected:
  void SetUp() override {
    PHARE_NEEDS_SHARED_DATA("photometry-reference/manifest.json");
    std::ifstream(folder() / "manifest.json") >> manifest_;
    for (const auto& [key, file] : manifest_.at("files").items()) {
      const std::string name = file.at("file").get<std::string>();
      LampReadSettings settings;
      if (file.contains("frame_in_lamp_axes")) {
        const auto& frame = file.at("frame_in_lamp_axes");
        const glm::dvec3 c0 = vector_of(frame.at("c0")), g0 = vector_of(frame.at("g0"));
        if (g0 == glm::dvec3{0, 0, -1}) {
          settings.axis = GammaAxis::kGamma90;
          settings.c0_turn_deg = glm::degrees(std::atan2(c0.y, c0.x));
        } else {
          ASSERT_EQ(g0, (glm::dvec3{1, 0, 0}));
          settings.c0_turn_deg = glm::degrees(std::atan2(c0.z, -c0.y));  // ours: C 0 right, C 90 up
        }
      }
      auto table = read_lamp(folder() / name, settings);
      ASSERT_TRUE(table.ok()) << table.error().text();
      if (file.contains("max_cd")) {
        EXPECT_NEAR(table->peak_cd(), file.at("max_cd").get<double>(), 1e-9);
      }
      lamps_.emplace(key, std::move(*table));
    }
    ASSERT_EQ(lamps_.size(), 15u);
  }

  static std::filesystem::path folder() { return shared_data("photometry-reference"); }

  /// Compares and keeps the worst relative difference (absolute where the expected value is 0).
  void compare(double actual, double expected, const std::string& what) {
    const double difference = std::abs(actual - expected) / (expected == 0.0 ? 1.0 : std::abs(expected));
    if (difference > worst_) worst_ = difference;
    ++count_;
    ASSERT_LE(difference, kTolerance) << what << ": expected " << expected << ", got " << actual;
  }

  void say(const std::string& what) const {
    std::printf("%s: %zu values, worst relative difference %.2g\n", what.c_str(), count_, worst_);
  }

  /// Both lamps of a kind with the table of `key`.
  std::vector<PlacedSource> mounted(const std::string& kind, const std::string& key) const {
    std::vector<PlacedSource> sources;
    for (const auto& mount : manifest_.at("mounting").at(kind)) {
      const IntensityTable& lamp = lamps_.at(key);
      const glm::dmat3 world_from_lamp{vector_of(mount.at("forward")), vector_of(mount.at("left")),
                                       vector_of(mount.at("up"))};
      sources.push_back({&lamp, vector_of(mount.at("position_m")), world_from_lamp, 1.0, sources.size()});
    }
    return sources;
  }

  nlohmann::json manifest_;
  std::map<std::string, IntensityTable> lamps_;
  double worst_ = 0.0;
  std::size_t count_ = 0;
};

TEST_F(Reference, IntensityOfEveryFile) {
  const Csv csv(folder() / "0_intensity.csv");
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const auto found = lamps_.find(csv.text(i, "file_key"));
    ASSERT_NE(found, lamps_.end()) << csv.text(i, "file_key");
    const glm::dvec3 direction{csv.number(i, "dx"), csv.number(i, "dy"), csv.number(i, "dz")};
    compare(found->second.intensity_cd(direction), csv.number(i, "I_cd"),
            found->first + " row " + std::to_string(i + 2));
    if (HasFatalFailure()) return;
  }
  ASSERT_EQ(count_, 14u * 96u);
  say("intensity");
}

TEST_F(Reference, IlluminanceOnRoadAndWall) {
  for (const char* beam : {"low", "high", "fog"}) {
    const std::string primary = manifest_.at("primary_file_per_beam").at(beam);
    for (const bool wall : {false, true}) {
      const Csv csv(folder() / ((wall ? "b_wall25_" : "a_road_flat_") + std::string(beam) + ".csv"));
      ASSERT_GT(csv.rows.size(), 1000u);
      const double wall_x_m = manifest_.at("wall_x_m");
      std::size_t other_formats = 0;
      for (const auto& [key, lamp] : lamps_) {
        const bool is_primary = key == primary;
        const std::string column = is_primary ? "E" : "E[" + key + "]";
        if (!is_primary && !csv.has(column)) continue;
        other_formats += is_primary ? 0 : 1;
        const auto sources = mounted(beam, key);
        for (std::size_t i = 0; i < csv.rows.size(); ++i) {
          const glm::dvec3 point = wall ? glm::dvec3{wall_x_m, csv.number(i, "y"), csv.number(i, "z")}
                                        : glm::dvec3{csv.number(i, "x"), csv.number(i, "y"), 0.0};
          const glm::dvec3 normal = wall ? glm::dvec3{-1, 0, 0} : glm::dvec3{0, 0, 1};
          const Illuminance e = illuminance_lx(sources, sources.size(), point, normal);
          const std::string what =
              std::string(beam) + (wall ? " wall " : " road ") + column + " row " + std::to_string(i + 2);
          compare(e.total_lx, csv.number(i, column), what);
          if (is_primary) {
            compare(e.lamps_lx[0], csv.number(i, "E_left"), what + " left");
            compare(e.lamps_lx[1], csv.number(i, "E_right"), what + " right");
          }
          if (HasFatalFailure()) return;
        }
      }
      EXPECT_EQ(other_formats, std::string(beam) == "low" ? 6u : std::string(beam) == "high" ? 3u : 2u);
    }
  }
  say("road and wall");
}

TEST_F(Reference, IlluminanceOnPlates) {
  const Csv csv(folder() / "c_plates.csv");
  auto sources = mounted("low", "low_A");
  for (PlacedSource source : mounted("high", "high_A")) {
    source.lamp += 2;
    sources.push_back(source);
  }
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const Illuminance e = illuminance_lx(sources, 4, {csv.number(i, "x"), csv.number(i, "y"), csv.number(i, "z")},
                                         {csv.number(i, "nx"), csv.number(i, "ny"), csv.number(i, "nz")});
    const std::string what = "row " + std::to_string(i + 2);
    compare(e.total_lx, csv.number(i, "E"), what);
    std::size_t lamp = 0;
    for (const char* column : {"E_low_left", "E_low_right", "E_high_left", "E_high_right"}) {
      compare(e.lamps_lx[lamp++], csv.number(i, column), what + column);
    }
    if (HasFatalFailure()) return;
  }
  ASSERT_GE(count_, 3000u);
  say("plates");
}

TEST_F(Reference, HardSingleLampCases) {
  const Csv csv(folder() / "j_hard.csv");
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const auto found = lamps_.find(csv.text(i, "file_key"));
    ASSERT_NE(found, lamps_.end()) << csv.text(i, "file_key");
    const auto n = [&](const char* column) { return csv.number(i, column); };
    const glm::dmat3 aim = aim_rotation(glm::radians(n("yaw")), glm::radians(n("pitch")), glm::radians(n("roll")));
    const double e = illuminance_lx({n("lx"), n("ly"), n("lz")}, aim, found->second, 1.0, {n("px"), n("py"), n("pz")},
                                    {n("nx"), n("ny"), n("nz")});
    compare(e, n("E_lx"), csv.text(i, "case") + " of " + found->first);
    if (HasFatalFailure()) return;
  }
  ASSERT_GE(count_, 90u);
  say("hard cases");
}

TEST_F(Reference, ConstantSourceInARoom) {
  const Csv csv(folder() / "k_room.csv");
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    if (csv.text(i, "what").starts_with("flux")) continue;
    const auto n = [&](const char* column) { return csv.number(i, column); };
    const glm::dvec3 lamp{n("sx"), n("sy"), n("sz")};
    compare(illuminance_lx(lamp, glm::dmat3{1.0}, lamps_.at("iso_C"), 1.0, {n("x"), n("y"), n("z")},
                           {n("nx"), n("ny"), n("nz")}),
            n("E_lx_or_flux_lm"), "row " + std::to_string(i + 2));
    if (HasFatalFailure()) return;
  }
  say("room");
}

TEST_F(Reference, FluxIsTheExactIntegral) {
  const Csv csv(folder() / "f_flux.csv");
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const auto found = lamps_.find(csv.text(i, "file_key"));
    if (csv.text(i, "what") != "sphere") continue;
    ASSERT_NE(found, lamps_.end()) << csv.text(i, "file_key");
    compare(found->second.flux_lm(), csv.number(i, "flux_lm"), found->first);
    if (HasFatalFailure()) return;
  }
  compare(lamps_.at("iso_C").flux_lm(), 4.0 * std::acos(-1.0) * 1000.0, "iso_C");
  ASSERT_GE(count_, 8u);
  say("flux");
}

TEST_F(Reference, OddFilesAreRead) {
  const Csv csv(folder() / "formats" / "expected_intensity.csv");
  std::map<std::string, IntensityTable> tables;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const std::string name = csv.text(i, "file");
    if (!tables.contains(name)) {
      auto table = read_lamp(folder() / "formats" / name);
      ASSERT_TRUE(table.ok()) << table.error().text();
      tables.emplace(name, std::move(*table));
    }
    compare(tables.at(name).intensity_cd({csv.number(i, "dx"), csv.number(i, "dy"), csv.number(i, "dz")}),
            csv.number(i, "I_cd"), name + " row " + std::to_string(i + 2));
    if (HasFatalFailure()) return;
  }
  nlohmann::json expected;
  std::ifstream(folder() / "formats" / "expected.json") >> expected;
  EXPECT_EQ(tables.size(), expected.at("must_load").size());
  say("odd files");
}

TEST_F(Reference, BrokenFilesAreRefusedByName) {
  nlohmann::json expected;
  std::ifstream(folder() / "formats" / "expected.json") >> expected;
  for (const auto& [name, why] : expected.at("must_refuse").items()) {
    const auto table = read_lamp(folder() / "formats" / name);
    ASSERT_FALSE(table.ok()) << name << ": " << why;
    EXPECT_NE(table.error().text().find(name), std::string::npos) << table.error().text();
    EXPECT_FALSE(table.error().reason.empty());
    std::printf("%s\n", table.error().text().substr(folder().string().size() + 1).c_str());
  }
}

// A file cut off anywhere is refused or read, without a crash; only a cut within the last number can go unseen.
TEST_F(Reference, CutFilesDoNotCrash) {
  std::size_t refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder() / "formats")) {
    if (entry.path().extension() != ".ies") continue;
    const std::string content = test::content_of(entry.path());
    const std::size_t last_number = content.find_last_of(" \n", content.find_last_not_of(" \r\n"));
    for (std::size_t length = 0; length < content.size(); length += 7) {
      const auto table = parse_lamp(content.substr(0, length), "cut.ies");
      if (last_number != std::string::npos && length <= last_number) {
        EXPECT_FALSE(table.ok()) << entry.path() << " cut at " << length;
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace phare
