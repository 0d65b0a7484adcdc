// unit: places and turns of lamps written into rig files as people write them.
#include "config/rig_edit.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "config/base/whole_file.h"
#include "config/rig.h"
#include "config/rig_writer.h"
#include "tests/paths.h"

namespace phare {
namespace {

namespace fs = std::filesystem;
constexpr double kRad = 3.14159265358979323846 / 180.0;

std::string text_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

constexpr const char* kRig = R"(# Ein Prüfstand
name = "bench"     # kept
scene = "s.glb"
vehicle = "v.toml"
cockpit = "c.toml"

[[channel]]
name = "front"

[[design]]
name = "halogen"

[[design.lamp]]
name = "headlamp"
pair = true                      # the left one
position_m = [3.45, 0.62, 0.66]  # measured

[[design.lamp.source]]
function = "low"
file = "é low.ies"   # ours
pitch_deg = -0.573   # -1 %
colour_temperature_k = 3200.0

[[design.lamp.source]]
function = "high"
file = "high.ies"
pitch_deg = -0.573

# The fog lamps: both alike.
[[design.lamp]]
name = "fog"
pair = true
position_m = [
  3.5, 0.55, 0.35
]
source = [ { function = "fog", file = "fog.ies" } ]

[dynamics]  # behind the lamps
level = "kinematic"
)";

const SavedMount kLeft{"halogen", "headlamp left", {3.5, 0.7, 0.8}, {{0.0, 0.01, 0.0}, {0.02, 0.0, 0.001}}};
const SavedMount kRight{"halogen", "headlamp right", {3.5, -0.7, 0.8}, {{0.0, 0.01, 0.0}, {-0.02, 0.0, -0.001}}};

Rig rig_of(const std::string& text) {
  const auto reading = read_rig_text(text, "/x/rig.toml");
  EXPECT_TRUE(reading.ok());
  EXPECT_TRUE(reading->problems.empty()) << reading->problems.front().text() << "\n" << text;
  return reading->rig;
}

TEST(RigEdit, APairThatMirrorsStaysOneAndEveryCommentStays) {
  const SavedMount mounts[] = {kLeft, kRight};
  const auto edited = with_mounts(kRig, "/x/rig.toml", mounts);
  ASSERT_TRUE(edited) << edited.error().text();
  for (const char* kept :
       {"# Ein Prüfstand\n", "name = \"bench\"     # kept\n", "pair = true                      # the left one\n",
        "position_m = [3.5, 0.7, 0.8]  # measured\n", "file = \"é low.ies\"   # ours\n",
        "pitch_deg = 0.572958   # -1 %\n", "# The fog lamps: both alike.\n", "  3.5, 0.55, 0.35\n",
        "[dynamics]  # behind the lamps\n", "file = \"high.ies\"\n"})
    EXPECT_NE(edited->find(kept), std::string::npos) << kept << "\n" << *edited;
  const Rig rig = rig_of(*edited);
  ASSERT_EQ(rig.designs[0].lamps.size(), 4u);
  const LampConfig &left = rig.designs[0].lamps[0], &right = rig.designs[0].lamps[1];
  EXPECT_EQ(left.name, "headlamp left");
  EXPECT_EQ(right.position_m, glm::dvec3(3.5, -0.7, 0.8));
  // Rounded to 1e-6 degrees: half of that.
  EXPECT_NEAR(left.sources[1].yaw_rad, 0.02, 0.51e-6 * kRad);
  EXPECT_NEAR(right.sources[1].roll_rad, -0.001, 0.51e-6 * kRad);
  EXPECT_NEAR(left.sources[1].pitch_rad, 0.0, 0.51e-6 * kRad);
  // What holds is written again as it is.
  EXPECT_EQ(*with_mounts(*edited, "/x/rig.toml", mounts), *edited);
}

TEST(RigEdit, ThoseThatNoLongerMirrorBecomeTwo) {
  SavedMount higher = kRight;
  higher.position_m.z = 0.9;
  const SavedMount mounts[] = {higher};  // the left one stays
  const auto edited = with_mounts(kRig, "/x/rig.toml", mounts);
  ASSERT_TRUE(edited) << edited.error().text();
  const Rig rig = rig_of(*edited), before = rig_of(kRig);
  ASSERT_EQ(rig.designs[0].lamps.size(), 4u);
  EXPECT_EQ(rig.designs[0].lamps[1].name, "headlamp right");
  EXPECT_EQ(rig.designs[0].lamps[1].position_m.z, 0.9);
  EXPECT_EQ(rig.designs[0].lamps[0].position_m, before.designs[0].lamps[0].position_m);
  EXPECT_EQ(rig.designs[0].lamps[2], before.designs[0].lamps[2]);
  EXPECT_NE(edited->find("# The fog lamps: both alike.\n[[design.lamp]]"), std::string::npos) << *edited;
  // And both again, now that they are two.
  const SavedMount both[] = {kLeft, kRight};
  const auto again = with_mounts(*edited, "/x/rig.toml", both);
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(rig_of(*again).designs[0].lamps[1].position_m.z, 0.8);
}

// What a new rig says of a pair goes with it; a comment of one's own stays.
TEST(RigEdit, NoLampAloneIsToldToBeAPair) {
  SavedMount higher = kRight;
  higher.position_m.z = 0.9;
  const SavedMount mounts[] = {higher};
  EXPECT_NE(with_mounts(kRig, "/x/rig.toml", mounts)->find("pair = false                      # the left one\n"),
            std::string::npos);
  const std::string own = "pair = true                      # the left one\n";
  for (const std::string end : {"\n", "\r\n"}) {
    std::string text = kRig;
    text.replace(text.find(own), own.size(), "pair = true  # " + std::string(kPairSays) + " " + end);
    const auto edited = with_mounts(text, "/x/rig.toml", mounts);
    ASSERT_TRUE(edited) << edited.error().text();
    EXPECT_EQ(edited->find("twin"), std::string::npos) << *edited;
    EXPECT_NE(edited->find("pair = false" + end + "position_m = [3.5, -0.7, 0.9]  # measured\n"), std::string::npos)
        << *edited;
  }
}

TEST(RigEdit, AMatrixInOneFileIsTurnedAsOne) {
  std::string text = kRig;
  const std::string low = "file = \"é low.ies\"   # ours\n";
  text.insert(text.find(low) + low.size(), "emitters = 2\n");
  const SavedMount::Turn one{0.0, 0.01, 0.0}, other{0.02, 0.0, 0.0};
  const SavedMount mounts[] = {{"halogen", "headlamp left", {3.5, 0.7, 0.8}, {one, one, other}},
                               {"halogen", "headlamp right", {3.5, -0.7, 0.8}, {one, one, {-0.02, 0.0, 0.0}}}};
  const auto edited = with_mounts(text, "/x/rig.toml", mounts);
  ASSERT_TRUE(edited) << edited.error().text();
  const Rig rig = rig_of(*edited);
  const LampConfig& left = rig.designs[0].lamps[0];
  ASSERT_EQ(left.sources.size(), 3u);
  EXPECT_NEAR(left.sources[1].pitch_rad, 0.01, 0.51e-6 * kRad);
  EXPECT_NEAR(left.sources[2].yaw_rad, 0.02, 0.51e-6 * kRad);
  // Its emitters turned apart cannot be written into one table: nothing is.
  const SavedMount apart[] = {{"halogen", "headlamp left", {3.5, 0.7, 0.8}, {one, other, other}}};
  EXPECT_FALSE(with_mounts(text, "/x/rig.toml", apart));
}

TEST(RigEdit, TablesInBracesAreEditedAndSplit) {
  std::string text = kRig;
  const std::size_t begin = text.find("[[design.lamp]]"), end = text.find("[dynamics]");
  text.replace(
      begin, end - begin,
      "lamp = [ { name = \"fog\", pair = true, position_m = [3.5, 0.55, 0.35], source = [ { function = \"fog\", "
      "file = \"fog.ies\" } ] } ]  # one line\n");
  const SavedMount left{"halogen", "fog left", {3.5, 0.6, 0.35}, {{0.0, -0.03, 0.0}}};
  const SavedMount alone[] = {left};
  const auto split = with_mounts(text, "/x/rig.toml", alone);
  ASSERT_TRUE(split) << split.error().text();
  EXPECT_EQ(rig_of(*split).designs[0].lamps[0].position_m.y, 0.6);
  EXPECT_EQ(rig_of(*split).designs[0].lamps[1].position_m.y, -0.55);
  SavedMount right = left;
  right.lamp = "fog right", right.position_m.y = -0.6;
  const SavedMount pair[] = {left, right};
  const auto whole = with_mounts(text, "/x/rig.toml", pair);
  ASSERT_TRUE(whole) << whole.error().text();
  EXPECT_NE(whole->find("pair = true"), std::string::npos);
  EXPECT_NE(whole->find("pitch_deg = -1.718873"), std::string::npos) << *whole;
}

TEST(RigEdit, WhatAimDidIsInTheAnglesThen) {
  std::string text = kRig;
  text.replace(text.find("position_m = [3.45"), 0, "aim = \"cut-off\"  # UN R48\n");
  const SavedMount mounts[] = {kLeft, kRight};
  const auto edited = with_mounts(text, "/x/rig.toml", mounts);
  ASSERT_TRUE(edited) << edited.error().text();
  EXPECT_NE(edited->find("aim = \"as-filed\"  # UN R48\n"), std::string::npos) << *edited;
}

TEST(RigEdit, TheShippedRigsCanBeEdited) {
  for (const char* name : {"country_road", "matrix"}) {
    const fs::path file = phare::source_dir() + "/config/rigs/" + name + ".toml";
    const auto rig = read_rig(file);
    ASSERT_TRUE(rig);
    std::vector<SavedMount> mounts;
    for (const DesignConfig& design : rig->designs)
      for (const LampConfig& lamp : design.lamps) {
        mounts.push_back({design.name, lamp.name, lamp.position_m + glm::dvec3(0.1, 0.0, 0.05), {}});
        for (const SourceConfig& s : lamp.sources) mounts.back().sources.push_back({s.yaw_rad, s.pitch_rad, 0.01});
      }
    const auto edited = with_mounts(text_of_file(file), file, mounts);  // rolled alike, so no pair mirrors
    ASSERT_TRUE(edited) << edited.error().text();
  }
}

TEST(RigEdit, WhatCannotBeEditedIsRefusedAndStays) {
  const auto reason = [](const std::string& text, const SavedMount& mount) {
    const SavedMount mounts[] = {mount};
    const auto edited = with_mounts(text, "/x/rig.toml", mounts);
    return edited ? "edited" : edited.error().text();
  };
  SavedMount other = kLeft;
  other.lamp = "roof left";
  EXPECT_NE(reason(kRig, other).find("/x/rig.toml: has not all of the lamps that were moved"), std::string::npos);
  other = kLeft;
  other.sources.pop_back();
  EXPECT_NE(reason(kRig, other).find("nothing is written"), std::string::npos);
  EXPECT_NE(reason("name = \n", kLeft).find("/x/rig.toml:1"), std::string::npos);
  EXPECT_NE(reason(std::string(kRig) + "kolour = 1\n", kLeft).find("kolour"), std::string::npos);
}

class RigSave : public testing::Test {
 protected:
  RigSave() : folder_(fs::path(testing::TempDir()) / ("phare_rig_save_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "rig.toml", std::ios::binary) << kRig;
  }
  ~RigSave() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path folder_;
};

TEST_F(RigSave, GoesToItselfOrBesideWholeOrNotAtAll) {
  const SavedMount mounts[] = {kLeft, kRight};
  ASSERT_TRUE(save_mounts(folder_ / "rig.toml", folder_ / "other.toml", mounts));
  EXPECT_EQ(text_of_file(folder_ / "rig.toml"), kRig) << "it was saved elsewhere";
  ASSERT_TRUE(save_mounts(folder_ / "rig.toml", "", mounts));
  EXPECT_EQ(text_of_file(folder_ / "rig.toml"), text_of_file(folder_ / "other.toml"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2) << "nothing else is left";

  std::ofstream(folder_ / "other.toml") << "another rig";
  const Status over = save_mounts(folder_ / "rig.toml", folder_ / "other.toml", mounts);
  ASSERT_FALSE(over);
  EXPECT_NE(over.error().text().find("other.toml: is there already"), std::string::npos) << over.error().text();
  EXPECT_EQ(text_of_file(folder_ / "other.toml"), "another rig");
  EXPECT_TRUE(save_mounts(folder_ / "rig.toml", folder_ / "rig.toml", mounts)) << "itself by its name";
  const Status elsewhere = save_mounts(folder_ / "rig.toml", "/tmp/phare_no_such_folder/rig.toml", mounts);
  ASSERT_FALSE(elsewhere);
  EXPECT_NE(elsewhere.error().text().find("relative to its folder"), std::string::npos);
  fs::remove(folder_ / "rig.toml");
  EXPECT_FALSE(save_mounts(folder_ / "rig.toml", "", mounts)) << "gone meanwhile";
}

TEST_F(RigSave, WhatTheDiskDoesNotTakeIsSaidAndTheFileStays) {
  const SavedMount mounts[] = {kLeft, kRight};
  const std::string long_name(300, 'x');  // longer than a name may be, for root too
  const Status refused = save_mounts(folder_ / "rig.toml", folder_ / long_name, mounts);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text().find(long_name), std::string::npos) << refused.error().text();
  EXPECT_EQ(text_of_file(folder_ / "rig.toml"), kRig);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "nothing half-written is left";
}

/// Cameras of one's own go where the desk is, or where none is behind everything; all else stays, comments too.
TEST(RigEdit, PutsCamerasIntoTheDesk) {
  const NamedEye roof{"roof", {.position_m = {0.5, 0.0, 2.25}, .yaw_deg = 0.0, .pitch_deg = -10.0, .fov_deg = 70.0}};
  const NamedEye kerb{"kerb", {.frame = Probe::Frame::kWorld, .position_m = {60.0, -6.0, 1.6}}};
  const std::string text(kRig);
  const auto first = with_cameras(text, "/x/rig.toml", std::vector{roof, kerb});
  ASSERT_TRUE(first) << first.error().text();
  EXPECT_TRUE(first->starts_with(text)) << *first;
  EXPECT_NE(first->find("[desk]\ncameras = [\"roof car 0.5 0 2.25 0 -10 70\", \"kerb world 60 -6 1.6 -12 -8 60\"]\n"),
            std::string::npos)
      << *first;
  const auto fewer = with_cameras(*first, "/x/rig.toml", std::vector{kerb});
  ASSERT_TRUE(fewer) << fewer.error().text();
  EXPECT_EQ(fewer->find("roof"), std::string::npos);
  const auto none = with_cameras(*first, "/x/rig.toml", {});
  ASSERT_TRUE(none) << none.error().text();
  EXPECT_TRUE(none->ends_with("\n[desk]\ncameras = \"none\"\n")) << *none;
  NamedEye moved = roof;
  moved.eye.position_m.z = 3.0;
  const auto chosen = with_cameras(*first + "camera = \"roof\"\n", "/x/rig.toml", std::vector{moved, kerb});
  ASSERT_TRUE(chosen) << chosen.error().text();
  EXPECT_NE(chosen->find("roof car 0.5 0 3 0 -10 70"), std::string::npos) << *chosen;
  const auto gone = with_cameras(*chosen, "/x/rig.toml", std::vector{kerb});
  ASSERT_TRUE(gone) << gone.error().text();
  EXPECT_TRUE(gone->ends_with("camera = \"driver\"\n")) << *gone;
  for (const char* desk : {"desk = {}\n", "desk = { }\n", "desk = { grid_m = 10 }\n"}) {
    const auto in_line = with_cameras(desk + text, "/x/rig.toml", std::vector{roof});
    ASSERT_TRUE(in_line) << desk << in_line.error().text();
    EXPECT_TRUE(in_line->starts_with("desk = { cameras = [\"roof ")) << *in_line;
  }
  const auto with_desk =
      with_cameras(text + "\n[desk]  # mine\ncamera = \"chase\"\n", "/x/rig.toml", std::vector{roof});
  ASSERT_TRUE(with_desk) << with_desk.error().text();
  EXPECT_TRUE(
      with_desk->ends_with("[desk]  # mine\ncameras = [\"roof car 0.5 0 2.25 0 -10 70\"]\ncamera = \"chase\"\n"))
      << *with_desk;
}

}  // namespace
}  // namespace phare
