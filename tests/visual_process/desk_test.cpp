// unit: what is set of the picture: every setting, every refusal, and the same command from every side.
#include "config/desk.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "config/desk_cameras.h"
#include "config/key_bindings.h"
#include "config/picture_options.h"
#include "visual/process/screens.h"
#include "visual/process/verbs.h"

namespace phare {
namespace {

TEST(Desk, DoesEverySettingAndSaysWhatHolds) {
  struct Case {
    const char* setting;
    const char* value;
    const char* now;
  };
  const Case cases[] = {
      {"camera", "chase", "camera chase"},
      {"camera", "next", "camera oncoming"},
      {"camera", "next", "camera wall"},
      {"layout", "next", "layout split"},
      {"layout", "inset", "layout inset"},
      {"layout", "next", "layout full"},
      {"second_camera", "birds-eye", "second_camera birds-eye"},
      {"plot", "on", "plot on"},
      {"camera", "free", "camera free"},
      {"camera", "next", "camera driver"},
      {"cameras", "roof car 0 0 2 0 -5", "cameras roof car 0 0 2 0 -5 60"},
      {"cameras", "none", "cameras none"},
      {"free_eye", "world 1 2 3 90 -10", "free_eye world 1 2 3 90 -10 60"},
      {"free_eye", "car -6 2.5 2.2 -12 -8 45", "free_eye car -6 2.5 2.2 -12 -8 45"},
      {"mirrors", "on", "mirrors on"},
      {"compare", "next", "compare split"},
      {"compare", "flicker", "compare flicker"},
      {"compare", "next", "compare difference"},
      {"compare", "next", "compare ratio"},
      {"compare", "next", "compare off"},
      {"versus_aligned", "on", "versus_aligned on"},
      {"versus", "1", "versus 1"},
      {"versus", "next", "versus next"},
      {"view", "false-colour", "view false-colour"},
      {"view", "next", "view clipping"},
      {"view", "next", "view photo"},
      {"method", "vertex-1998", "method vertex-1998"},
      {"method", "next", "method reference"},
      {"method", "next", "method fragment"},
      {"method", "reference", "method reference"},
      {"isolux_lx", "0.5, 2 8", "isolux_lx 0.5 2 8"},
      {"isolux_lx", "default", "isolux_lx 1 3 5 10 30 50 100"},
      {"exposure_per_cdm2", "0.25", "exposure_per_cdm2 0.25"},
      {"adaptation_k", "4000", "adaptation_k 4000"},
      {"adaptation_k", "auto", "adaptation_k auto"},
      {"design", "1", "design 1"},
      {"design", "cockpit", "design cockpit"},
      {"probes", "car 25 0 0.01; world 1 2 3 0 0 2", "probes car 25 0 0.01; world 1 2 3"},
      {"probes", "add car 50 -1.5 0 -1 0 0", "probes car 25 0 0.01; world 1 2 3; car 50 -1.5 0 -1 0 0"},
      {"probes", "none", "probes none"},
      {"probes", "road 120 -1.75; road 50 0 1.5", "probes road 120 -1.75; road 50 0 1.5"},
      {"point", "picture 0.5 0.6", "point picture 0.5 0.6"},
      {"point", "road 100 2 0 0 0 2", "point road 100 2"},
      {"point", "world 1 2 3 -1 0 0", "point world 1 2 3 -1 0 0"},
      {"point", "none", "point none"},
      {"grid_m", "5", "grid_m 5"},
      {"grid_m", "off", "grid_m off"},
      {"grid_m", "next", "grid_m 10"},
      {"grid_m", "next", "grid_m 20"},
      {"grid_m", "next", "grid_m off"},
      {"road_isolux", "on", "road_isolux on"},
      {"scale", "toggle", "scale off"},
      {"reach", "on", "reach on"},
      {"lines", "off", "lines off"},
      {"instruments", "toggle", "instruments off"},
      {"effects", "on", "effects on"},
      {"help", "toggle", "help on"},
      {"panel", "toggle", "panel on"},
      {"depth_first", "off", "depth_first off"},
      {"depth_first", "auto", "depth_first auto"},
      {"hdr_image", "on", "hdr_image on"},
      {"hdr_image", "auto", "hdr_image auto"},
      {"overlay", "off", "overlay off"},
      {"overlay", "auto", "overlay auto"},
      {"shadows", "fine", "shadows fine"},
      {"shadows", "rays", "shadows rays"},
      {"shadows", "lens", "shadows lens"},
      {"shadows", "auto", "shadows auto"},
      {"fog", "fine", "fog fine"},
      {"fog", "auto", "fog auto"},
      {"precipitation", "off", "precipitation off"},
      {"precipitation", "auto", "precipitation auto"},
      {"rain_mmph", "12.5", "rain_mmph 12.5"},
      {"snow_mmph", "2", "snow_mmph 2"},
      {"snow_cover", "0.7", "snow_cover 0.7"},
      {"weather_ahead", "on", "weather_ahead on"},
      {"weather_ahead", "auto", "weather_ahead auto"},
      {"ground", "wet", "ground wet"},
      {"ground", "auto", "ground auto"},
      {"glare", "off", "glare off"},
      {"glare", "auto", "glare auto"},
      {"fixed_light", "off", "fixed_light off"},
      {"fixed_light", "auto", "fixed_light auto"},
      {"asphalt", "lambert", "asphalt lambert"},
      {"asphalt", "auto", "asphalt auto"},
      {"windscreen", "on", "windscreen on"},
      {"wiper", "fast", "wiper fast"},
      {"windscreen_drawn", "off", "windscreen_drawn off"},
      {"windscreen_drawn", "auto", "windscreen_drawn auto"},
      {"snow_cover_drawn", "on", "snow_cover_drawn on"},
      {"snow_cover_drawn", "auto", "snow_cover_drawn auto"},
      {"eyeshine", "off", "eyeshine off"},
      {"eyeshine", "auto", "eyeshine auto"},
      {"spray", "off", "spray off"},
      {"spray", "auto", "spray auto"},
      {"age_years", "65", "age_years 65"},
      {"iris_pigment", "1.2", "iris_pigment 1.2"},
      {"visibility_m", "80", "visibility_m 80"},
      {"visibility_m", "clear", "visibility_m clear"}};
  Desk desk;
  std::set<std::string_view> tried;
  for (const Case& c : cases) {
    const auto done = apply(desk, {c.setting, c.value}, {.designs = 2});
    ASSERT_TRUE(done) << c.setting << ": " << done.error().text();
    EXPECT_EQ(*done, c.now);
    EXPECT_EQ(*apply(desk, {c.setting}), c.now) << "asked";
    tried.insert(c.setting);
  }
  for (const DeskSetting& setting : desk_settings()) EXPECT_TRUE(tried.contains(setting.name)) << setting.name;
}

// Cameras of one's own: kept where the free eye stands, chosen by name and in turn, moved, replaced, removed; and said
// in words that make the same desk.
TEST(Desk, HasCamerasOfOnesOwn) {
  Desk desk;
  const auto say = [&](const std::string& words) {
    const std::size_t space = words.find(' ');
    const auto done = apply(desk, {words.substr(0, space), words.substr(space + 1)}, {});
    return done ? std::string() : done.error().text();
  };
  EXPECT_EQ(say("free_eye car 1 2 3 10 -5 70"), "");
  EXPECT_EQ(say("cameras add roof"), "");
  EXPECT_EQ(say("cameras add kerb world 20 0 1.2 180 0"), "");
  ASSERT_EQ(desk.cameras.size(), 2u);
  EXPECT_EQ(desk.cameras[0].eye.position_m, glm::dvec3(1, 2, 3));
  EXPECT_EQ(desk.cameras[1].eye.frame, Probe::Frame::kWorld);
  EXPECT_EQ(say("camera kerb"), "");
  EXPECT_EQ(desk.camera, CameraKind::kFree);
  EXPECT_EQ(desk.free_eye.position_m.x, 20.0);
  EXPECT_EQ(say("camera next"), "") << "behind the last the driver's is next";
  EXPECT_EQ(desk.camera, CameraKind::kDriver);
  std::string in_turn;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(say("camera next"), "");
    in_turn += apply(desk, {"camera"}, {})->substr(7) + " ";
  }
  EXPECT_EQ(in_turn, "birds-eye chase oncoming wall left-mirror inner-mirror right-mirror free roof kerb ");

  // Moved by the mouse it is where it was moved to, until it is chosen anew; kept, it is there for good.
  EXPECT_EQ(say("camera roof"), "");
  desk.free_eye.position_m.z = 5.0;
  EXPECT_EQ(desk.cameras[0].eye.position_m.z, 3.0);
  Desk told;
  for (const DeskSetting& setting : desk_settings())
    ASSERT_TRUE(apply(told, {std::string(setting.name), setting.get(desk)}, {})) << setting.name;
  EXPECT_EQ(told, desk);
  EXPECT_EQ(say("cameras add roof"), "");
  EXPECT_EQ(desk.cameras[0].eye.position_m.z, 5.0);
  EXPECT_EQ(desk.cameras.size(), 2u);
  EXPECT_EQ(say("cameras remove roof"), "");
  EXPECT_TRUE(desk.own_camera.empty());
  EXPECT_EQ(desk.camera, CameraKind::kFree) << "where it was";
  for (int i = 0; i < 7; ++i) EXPECT_EQ(say("cameras add c" + std::to_string(i)), "");
  EXPECT_EQ(say("cameras add c7"), "cameras: at most 8 cameras");
  EXPECT_EQ(say("cameras a car 0 0 2 0 0; b car 0 0 2 0 0; a car 9 0 2 0 0"), "cameras: a is there twice");
  EXPECT_EQ(desk.cameras.size(), 8u) << "nothing is lost";
  EXPECT_EQ(say("cameras none"), "");
  EXPECT_TRUE(desk.cameras.empty());
}

// A camera that is added stands where the picture is seen from; the one that is shown beside another goes with its
// name.
TEST(Desk, AddsACameraWhereThePictureIsSeenFrom) {
  Desk desk;
  const DeskContext context{.seen_from =
                                FreeEye{.position_m = {-9, 0, 3.2}, .yaw_deg = 1, .pitch_deg = -4, .fov_deg = 50}};
  ASSERT_TRUE(apply(desk, desk_command("cameras add behind"), context));
  EXPECT_EQ(desk.cameras.at(0).eye, *context.seen_from);
  ASSERT_TRUE(apply(desk, desk_command("cameras add kerb world 1 2 3 4 5"), context));
  EXPECT_EQ(desk.cameras.at(1).eye.position_m.x, 1.0) << "unless a place is said";
  EXPECT_EQ(eye_named(desk, "behind").eye, *context.seen_from);
  EXPECT_EQ(eye_named(desk, "wall").kind, CameraKind::kWall);
  ASSERT_TRUE(apply(desk, desk_command("second_camera kerb")));
  ASSERT_TRUE(apply(desk, desk_command("cameras remove behind")));
  EXPECT_EQ(desk.second_camera, "kerb");
  ASSERT_TRUE(apply(desk, desk_command("cameras remove kerb")));
  EXPECT_EQ(desk.second_camera, "chase") << "which there is always";
}

// As lamps are: a rig file is read by people.
TEST(Desk, ACameraThatIsAddedIsRounded) {
  Desk desk;
  const DeskContext context{.seen_from = FreeEye{.position_m = {0.1 + 0.2, -9.00000012, 3.2},
                                                 .yaw_deg = 1.0 / 3.0,
                                                 .pitch_deg = -1e-9,
                                                 .fov_deg = 50.0000004}};
  EXPECT_EQ(*apply(desk, desk_command("cameras add k"), context), "cameras k car 0.3 -9 3.2 0.333333 0 50");
}

TEST(Desk, TheHalvesOfThePictureAreOnesOnly) {
  const DeskContext two{.designs = 2};
  Desk desk;
  ASSERT_TRUE(apply(desk, desk_command("compare split"), two));
  EXPECT_EQ(apply(desk, desk_command("layout split")).error().text(),
            "layout: the halves of the picture are taken by compare split");
  EXPECT_EQ(desk.layout, Layout::kFull);
  EXPECT_EQ(*apply(desk, desk_command("layout next")), "layout inset") << "the key passes them by";
  ASSERT_TRUE(apply(desk, desk_command("compare off"), two));
  ASSERT_TRUE(apply(desk, desk_command("layout split")));
  EXPECT_FALSE(apply(desk, desk_command("compare split"), two));
  EXPECT_EQ(*apply(desk, desk_command("compare next"), two), "compare flicker") << "the key passes them by";
}

TEST(Desk, ComparesNothingWhereTheRigHasOneDesign) {
  Desk desk;
  for (const char* words : {"compare split", "compare next", "versus_aligned on", "versus_aligned toggle"}) {
    const DeskCommand command = desk_command(words);
    const auto done = apply(desk, command, {.designs = 1});
    ASSERT_FALSE(done) << words;
    EXPECT_EQ(done.error().text(), command.setting + ": the rig has one design");
  }
  EXPECT_EQ(desk, Desk{});
  EXPECT_TRUE(apply(desk, desk_command("compare off"), {.designs = 1}));
}

TEST(Desk, RefusesWithTheReasonAndChangesNothing) {
  const std::map<std::string, std::string> cases{
      {"camera roof",
       "camera: \"roof\" is none of driver, birds-eye, chase, oncoming, wall, left-mirror, inner-mirror, right-mirror, "
       "free, next"},
      {"layout both", "layout: \"both\" is none of full, split, inset, next"},
      {"second_camera next",
       "second_camera: \"next\" is none of driver, birds-eye, chase, oncoming, wall, left-mirror, inner-mirror, "
       "right-mirror, free"},
      {"plot 1", "plot: \"1\" is none of off, on, toggle"},
      {"cameras roof", "cameras: roof: where is it? add roof takes the place of the present view"},
      {"cameras add wall", "cameras: \"wall\" means something else already"},
      {"cameras add next", "cameras: \"next\" means something else already"},
      {"cameras add free car 1 2 3 0 0", "cameras: \"free\" means something else already"},
      {"cameras add a/b", "cameras: \"a/b\" is no name of a camera: 1 to 24 letters, digits, - and _"},
      {"cameras roof car 1 2 3 0 95", "cameras: roof: 95 is outside -89 to 89"},
      {"cameras remove roof", "cameras: there is no camera \"roof\"; there are: none"},
      {"free_eye car 1 2 3",
       "free_eye: expected car or world, x, y, z in m, degrees to the left and up, and the field in degrees if it is "
       "not "
       "60"},
      {"free_eye car 1 2 3 0 95", "free_eye: 95 is outside -89 to 89"},
      {"mirrors 3", "mirrors: \"3\" is none of off, on, toggle"},
      {"compare both", "compare: \"both\" is none of off, split, flicker, difference, ratio, next"},
      {"versus_aligned 1", "versus_aligned: \"1\" is none of off, on, toggle"},
      {"versus two", "versus: expected next or a design's number, got \"two\""},
      {"view lux", "view: \"lux\" is none of photo, false-colour, clipping, next"},
      {"method gouraud", "method: \"gouraud\" is none of fragment, vertex, vertex-1998, reference, next"},
      {"isolux_lx 3 1", "isolux_lx: the levels have to rise"},
      {"isolux_lx 1 2 3 4 5 6 7 8 9", "isolux_lx: at most 8 levels, not 9"},
      {"isolux_lx ,", "isolux_lx: expected at least one level"},
      {"isolux_lx 1 x", "isolux_lx: expected a number, got \"x\""},
      {"isolux_lx 0", "isolux_lx: 0 is outside 0.001 to 1e+06"},
      {"exposure_per_cdm2 nan", "exposure_per_cdm2: expected a number, got \"nan\""},
      {"exposure_per_cdm2 0", "exposure_per_cdm2: 0 is outside 1e-06 to 1e+06"},
      {"adaptation_k 1000", "adaptation_k: expected auto or a colour temperature of 2000 to 25000 K, got \"1000\""},
      {"design 2", "design: 2: the rig has 2, counted from 0"},
      {"design -1", "design: expected cockpit or a design's number, got \"-1\""},
      {"probes car 1 2",
       "probes: a probe is car or world, x, y, z in m, and a normal of three numbers unless it is up; or road, s, to "
       "the "
       "left, and above it unless on it"},
      {"probes sky 1 2 3", "probes: \"sky\" is none of car, world, road"},
      {"probes picture 0.5 0.5", "probes: \"picture\" is none of car, world, road"},
      {"point picture 0.5 1.5", "point: 1.5 is outside 0 to 1"},
      {"point picture 0.5", "point: a point of the picture is its shares of width and height, 0 to 1"},
      {"grid_m 0.5", "grid_m: 0.5 is outside 1 to 100"},
      {"road_isolux 1", "road_isolux: \"1\" is none of off, on, toggle"},
      {"scale 1", "scale: \"1\" is none of off, on, toggle"},
      {"reach 1", "reach: \"1\" is none of off, on, toggle"},
      {"probes car 1 2 3 0 0 0", "probes: a normal of no length"},
      {"probes add", "probes: \"add\" is none of car, world, road"},
      {"lines maybe", "lines: \"maybe\" is none of off, on, toggle"},
      {"instruments 1", "instruments: \"1\" is none of off, on, toggle"},
      {"effects yes", "effects: \"yes\" is none of off, on, toggle"},
      {"panel me", "panel: \"me\" is none of off, on, toggle"},
      {"help me", "help: \"me\" is none of off, on, toggle"},
      {"depth_first 2", "depth_first: \"2\" is none of auto, off, on"},
      {"hdr_image float", "hdr_image: \"float\" is none of auto, off, on"},
      {"overlay toggle", "overlay: \"toggle\" is none of auto, off, on"},
      {"windscreen_drawn wet", "windscreen_drawn: \"wet\" is none of auto, off, on"},
      {"snow_cover_drawn 0.5", "snow_cover_drawn: \"0.5\" is none of auto, off, on"},
      {"shadows on", "shadows: \"on\" is none of auto, off, hard, soft, fine, rays, lens"},
      {"fog thick", "fog: \"thick\" is none of auto, off, coarse, medium, fine, shadowed, finest"},
      {"visibility_m 0.5", "visibility_m: 0.5 is outside 1 to 1e+05; or clear"},
      {"rain_mmph -1", "rain_mmph: -1 is outside 0 to 100"},
      {"rain_mmph 101", "rain_mmph: 101 is outside 0 to 100"},
      {"snow_mmph 11", "snow_mmph: 11 is outside 0 to 10"},
      {"snow_mmph nan", "snow_mmph: expected a number, got \"nan\""},
      {"precipitation 1", "precipitation: \"1\" is none of auto, off, on"},
      {"windscreen 1", "windscreen: \"1\" is none of off, on, toggle"},
      {"wiper on", "wiper: \"on\" is none of off, interval, slow, fast"},
      {"snow_cover 1.5", "snow_cover: 1.5 is outside 0 to 1"},
      {"weather_ahead soon", "weather_ahead: \"soon\" is none of auto, off, on"},
      {"eyeshine 1", "eyeshine: \"1\" is none of auto, off, on"},
      {"spray 1", "spray: \"1\" is none of auto, off, on"},
      {"ground soaked", "ground: \"soaked\" is none of auto, dry, damp, wet, flooded"},
      {"glare 1", "glare: \"1\" is none of auto, off, on"},
      {"fixed_light 1", "fixed_light: \"1\" is none of auto, off, on"},
      {"asphalt R3", "asphalt: \"R3\" is none of auto, lambert, r-table"},
      {"age_years 0", "age_years: 0 is outside 1 to 120"},
      {"iris_pigment 1.3", "iris_pigment: 1.3 is outside 0 to 1.2"},
      {"visibility_m foggy", "visibility_m: expected a number, got \"foggy\"; or clear"},
  };
  std::set<std::string> tried;
  Desk desk;
  for (const auto& [words, reason] : cases) {
    const auto done = apply(desk, desk_command(words), {.designs = 2});
    ASSERT_FALSE(done) << words;
    EXPECT_EQ(done.error().text(), reason);
    tried.insert(desk_command(words).setting);
  }
  EXPECT_EQ(desk, Desk{});
  EXPECT_EQ(tried.size(), desk_settings().size()) << "every setting refuses something";
  std::string many = "none";
  for (std::size_t i = 0; i <= kMostProbes; ++i) many = i == 0 ? "car 1 0 0" : many + "; car 1 0 0";
  EXPECT_EQ(apply(desk, {"probes", many}).error().text(), "probes: at most 16 probes");
  EXPECT_NE(apply(desk, {"kamera", "chase"}).error().text().find("\"camera\""), std::string::npos);
}

/// What was written of a desk makes the same desk again: the rig file, the status.
TEST(Desk, ItsDifferenceMakesItAgain) {
  Desk desk;
  for (const char* words : {"cameras roof car 0 0 2 0 -5 60; kerb world 1 2 3 4 5 50",
                            "camera roof",
                            "layout inset",
                            "second_camera kerb",
                            "plot on",
                            "compare ratio",
                            "versus_aligned on",
                            "free_eye car 0 0 3 0 -5 60",
                            "view false-colour",
                            "isolux_lx 0.1 0.30000000000000004",
                            "exposure_per_cdm2 0.7",
                            "adaptation_k 5500",
                            "design 1",
                            "lines off",
                            "depth_first on",
                            "shadows hard",
                            "fog coarse",
                            "glare off",
                            "fixed_light off",
                            "asphalt lambert",
                            "precipitation off",
                            "ground damp",
                            "age_years 70",
                            "visibility_m 80",
                            "rain_mmph 7.5",
                            "snow_mmph 0.5",
                            "snow_cover 0.4",
                            "windscreen on",
                            "wiper interval",
                            "eyeshine off",
                            "spray on",
                            "hdr_image on",
                            "overlay off",
                            "snow_cover_drawn off",
                            "windscreen_drawn on",
                            "probes car 1 2 3 0.6 0 0.8; world -1e6 0 0.1"})
    ASSERT_TRUE(apply(desk, desk_command(words), {.designs = 2})) << words;
  Desk again;
  for (const DeskCommand& command : difference(desk)) ASSERT_TRUE(apply(again, command, {.designs = 2}));
  EXPECT_EQ(again, desk);
  EXPECT_TRUE(difference(Desk{}).empty());
}

// ---- from every side

Desk by_key(KeyAction action) {
  Desk desk;
  Screens screens({});
  const KeyAction presses[] = {action};
  EXPECT_FALSE(screens.press(presses, true, desk,
                             [&](const DeskCommand& command) { EXPECT_TRUE(apply(desk, command, {.designs = 2})); }));
  return desk;
}

Desk by_command_line(std::vector<std::string> words) {
  CLI::App app;
  PictureOptions options;
  options.add_to(app);
  std::ranges::reverse(words);
  app.parse(words);
  Desk desk;
  for (const DeskCommand& command : options.desk) EXPECT_TRUE(apply(desk, command, {.designs = 2}));
  return desk;
}

TEST(Desk, TellsWhyADeviceWithoutFloat64DrawsByNoReference) {
  Desk desk;
  desk.method = Method::kVertex1998;
  const DeskContext lacking{.no_reference = "the device has no shaderFloat64"};
  const auto refused = apply(desk, {"method", "reference"}, lacking);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text(), "method: reference: the device has no shaderFloat64");
  EXPECT_EQ(desk.method, Method::kVertex1998) << "nothing has changed";
  EXPECT_TRUE(apply(desk, {"method", "next"}, lacking));
  EXPECT_EQ(desk.method, Method::kFragment) << "the key passes it by";
}

TEST(Desk, IsTheSameByKeyCommandLineAndBus) {
  Rig rig;
  rig.designs = {{"one", {}}, {"two", {}}};
  Lamps none = std::move(*Lamps::load(rig));
  const auto by_bus = [&](const char* words) {
    Desk desk;
    const DeskCommand command = desk_command(words);
    const ControlReply reply =
        visual_verbs(none, rig, desk)(RigControl{RigControl::Set{command.setting, command.value}});
    EXPECT_EQ(reply.verdict, Verdict::kAccepted) << reply.reason;
    return desk;
  };
  EXPECT_EQ(by_key(KeyAction::kCamera).camera, CameraKind::kBirdsEye);
  EXPECT_EQ(by_key(KeyAction::kCamera), by_command_line({"--camera", "birds-eye"}));
  EXPECT_EQ(by_key(KeyAction::kCamera), by_bus("camera next"));
  EXPECT_EQ(by_key(KeyAction::kFalseColour).view, View::kFalseColour);
  EXPECT_EQ(by_key(KeyAction::kFalseColour), by_command_line({"--false-colour"}));
  EXPECT_EQ(by_key(KeyAction::kFalseColour), by_bus("view false-colour"));
  EXPECT_EQ(by_key(KeyAction::kEffects), by_command_line({"--set", "effects=on"}));
  EXPECT_EQ(by_key(KeyAction::kEffects), by_bus("effects on"));
  EXPECT_EQ(
      by_command_line({"--exposure", "0.5", "--adaptation", "5000", "--set", "isolux_lx=1 2", "--set", "design=1"}),
      by_command_line({"--set", "exposure_per_cdm2=0.5", "--set", "adaptation_k=5000", "--set", "isolux_lx=1,2",
                       "--set", "design=1"}));
  EXPECT_EQ(by_command_line({"--camera", "wall"}).camera, CameraKind::kWall);
  EXPECT_THROW(by_command_line({"--camera", "next door"}), CLI::ParseError);
  EXPECT_THROW(by_command_line({"--set", "camera=next door"}), CLI::ParseError);
  EXPECT_THROW(by_command_line({"--set", "camera"}), CLI::ParseError);
  EXPECT_THROW(by_command_line({"--set", "kamera=chase"}), CLI::ParseError);
}

/// What `phare drive` was given reaches phare-visual whole.
TEST(Desk, IsHandedOnAsItWasGiven) {
  const auto parse = [](std::vector<std::string> words, PictureOptions& options) {
    CLI::App app;
    options.add_to(app);
    std::ranges::reverse(words);
    app.parse(words);
    return options.arguments();
  };
  PictureOptions first, second;
  const auto handed =
      parse({"--set", "probes=car 1 2 3", "--camera", "chase", "--set", "lines=off", "--false-colour"}, first);
  parse(handed, second);
  EXPECT_EQ(first.desk.size(), 4u);
  EXPECT_EQ(first.desk, second.desk);

  // A camera may be named that another option makes, whatever their order.
  PictureOptions own, handed_on;
  parse(parse({"--camera", "roof", "--set", "cameras=roof car 0 0 2 0 -5"}, own), handed_on);
  for (const PictureOptions* each : {&own, &handed_on}) {
    Desk desk;
    for (const DeskCommand& command : each->desk) EXPECT_TRUE(apply(desk, command)) << command.setting;
    EXPECT_EQ(desk.own_camera, "roof");
  }
}

TEST(Desk, EveryKeyOfThePictureSetsSomethingThereIs) {
  for (const KeyBinding& binding : key_bindings()) {
    Desk desk;
    if (binding.desk.empty()) continue;
    EXPECT_EQ(binding.actor, KeyActor::kPicture) << binding.name;
    EXPECT_TRUE(apply(desk, desk_command(binding.desk), {.designs = 2})) << binding.name;
    EXPECT_NE(desk, Desk{}) << binding.name;
  }
}

}  // namespace
}  // namespace phare
