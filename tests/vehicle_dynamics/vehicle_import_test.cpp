// unit, reference: vehicles and tyres of others as ours; what the load of a car does to it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "config/base/conventions.h"
#include "config/commonroad.h"
#include "full_car.h"
#include "vehicle_dynamics/batch.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

fs::path put_file(const std::string& name, const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / name;
  std::ofstream(file) << text;
  return file;
}

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("no " + from);
  return text.replace(at, from.size(), to);
}

const fs::path kShared = fs::path(shared_data_dir()) / "vehicle";

// A car and tyres in the words of CommonRoad, numbers of ours.
const std::string kVehicleYaml = R"(# a car
l: 4.4
w: 1.7
steering: {max: 0.9, v_max: 0.4}
longitudinal:
  a_max: 10.0
  v_switch: 6.0
m: 1200.0
m_s: 1060.0
m_uf: 70.0
m_ur: 70.0
a: 1.1
b: 1.5
I_Phi_s: 250.0
I_y_s: 1500.0
I_z: 1800.0
K_sf: 22000.0
K_sdf: 1600.0
K_sr: 21000.0
K_sdr: 1500.0
T_f: 1.45
T_r: 1.41
K_ras: 175000.0
K_tsf: -9000.0
K_tsr: 0.0
K_zt: 180000.0
h_s: 0.6
I_y_w: 1.2
R_w: 0.31
T_sb: 0.7
T_se: 1
)";
const std::string kTyreYaml =
    "tire:\n  p_cx1: 1.6\n  p_dx1: 1.1\n  p_ex1: 0.4\n  p_kx1: 21\n  p_hx1: 0.001\n  r_bx1: 12\n  r_bx2: -13\n"
    "  r_cx1: 1.2\n  r_ex1: 0.6\n  p_cy1: 1.3\n  p_dy1: 1.0\n  p_ey1: -0.01\n  p_ky1: -20\n  r_by1: 7\n  r_by2: 9\n"
    "  r_cy1: 1.07\n  r_ey1: -0.3\n";

// Magic Formula 6.1, with a pressure other than the nominal one; numbers of ours.
const std::string kTir61 = R"([MDI_HEADER]
FILE_TYPE = 'tir'   ! a comment
[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
[MODEL]
FITTYP = 61  $ Magic Formula version
[DIMENSION]
UNLOADED_RADIUS = 0.32
[VERTICAL]
FNOMIN = 4000
VERTICAL_STIFFNESS = 2.0D+5
VERTICAL_DAMPING = 50
PFZ1 = 0.7
[OPERATING_CONDITIONS]
INFLPRES = 220000
NOMPRES = 200000
[STRUCTURAL]
LONGITUDINAL_STIFFNESS = 350000
LATERAL_STIFFNESS = 150000
PCFX1 = 0.2
PCFY1 = 0.1
PCFY3 = 0.3
[LONGITUDINAL_COEFFICIENTS]
PCX1 = 1.6
PDX1 = 1.2
PDX2 = -0.1
PDX3 = 5
PEX1 = 0.1
PEX4 = 0.2
PKX1 = 24
PKX2 = 1.5
PKX3 = -0.3
PPX1 = -0.35
PPX2 = 0.2
PPX3 = -0.1
PPX4 = 0.05
RBX1 = 13
RBX2 = 9
RCX1 = 1.1
[LATERAL_COEFFICIENTS]
PCY1 = 1.4
PDY1 = 1.05
PDY2 = -0.12
PEY1 = -0.5
PKY1 = -18
PKY2 = 2.1
PKY4 = 1.8
PPY1 = -0.6
PPY2 = -0.05
PPY3 = 0.02
PHY1 = 0.002
RBY1 = 10
RBY2 = 8
RCY1 = 1.05
RVY1 = 0.05
QBZ1 = 10
)";

TEST(VehicleImport, CommonRoadWords) {
  const auto made = vehicle_of_commonroad(put_file("car.yaml", kVehicleYaml), put_file("tyre.yaml", kTyreYaml), {});
  ASSERT_TRUE(made.ok()) << made.error().text();
  const auto car = parse_vehicle(made->toml, "made");
  ASSERT_TRUE(car.ok()) << car.error().text();
  EXPECT_EQ(car->mass_kg, 1200.0);
  EXPECT_NEAR(car->wheelbase_m, 2.6, 1e-12);
  EXPECT_NEAR(car->track_m, 1.43, 1e-12);
  EXPECT_EQ(car->chassis->front_anti_roll_nmprad, 9000.0);
  EXPECT_EQ(car->chassis->tyre.lat_stiffness, 20.0);
  EXPECT_EQ(car->chassis->drive_front_01, 1.0);
  EXPECT_NEAR(car->max_power_w, 1200.0 * 10.0 * 6.0, 1e-3);
  ASSERT_EQ(made->notes.size(), 2u);
  EXPECT_NE(made->notes[0].find("not used: K_ras, l, steering.v_max, w"), std::string::npos) << made->notes[0];
  EXPECT_NE(made->notes[1].find("tire.p_hx1"), std::string::npos) << made->notes[1];
}

// The 320i and the Escort were typed off the tables by hand: the same numbers, to the digits that were typed.
TEST(VehicleImport, CommonRoadCarsAreTheShippedOnes) {
  if (!fs::exists(kShared / "commonroad")) GTEST_SKIP() << "no " << kShared << ": CommonRoad's own files are not tried";
  for (const auto& [yaml, toml] :
       {std::pair{"parameters_vehicle1.yaml", "ford_escort.toml"}, {"parameters_vehicle2.yaml", "bmw_320i.toml"}}) {
    const auto made =
        vehicle_of_commonroad(kShared / "commonroad" / yaml, kShared / "commonroad/parameters_tire.yaml", {});
    ASSERT_TRUE(made.ok()) << made.error().text();
    const auto car = parse_vehicle(made->toml, yaml);
    ASSERT_TRUE(car.ok()) << car.error().text();
    const VehicleParams ours = test::car(toml);
    const auto near = [&](double a, double b, const char* what) {
      EXPECT_NEAR(a, b, 1e-4 * std::abs(b) + 1e-9) << toml << " " << what;
    };
    near(car->mass_kg, ours.mass_kg, "mass");
    near(car->wheelbase_m, ours.wheelbase_m, "wheelbase");
    near(car->cg_to_front_m, ours.cg_to_front_m, "cg");
    near(car->cg_height_m, ours.cg_height_m, "height");
    near(car->front_rate_npm, ours.front_rate_npm, "spring");
    near(car->tyre_rate_npm, ours.tyre_rate_npm, "tyre");
    EXPECT_NEAR(car->roll_stiffness_nmprad / ours.roll_stiffness_nmprad, 1.0, 2e-3) << toml;
    // The pitching mode of the body over springs and tyres in series, as the closed forms have it (docs/dynamics.md).
    EXPECT_NEAR(car->ride_frequency_hz, ours.name.starts_with("BMW") ? 1.4373 : 1.6128, 5e-4) << toml;
    EXPECT_GT(car->ride_damping, 0.25) << toml;
    EXPECT_LT(car->ride_damping, 0.4) << toml;
    near(car->chassis->yaw_inertia_kgm2, ours.chassis->yaw_inertia_kgm2, "yaw inertia");
    near(car->chassis->brake_front_01, ours.chassis->brake_front_01, "brakes");
    near(car->chassis->tyre.lat_weight_fall, ours.chassis->tyre.lat_weight_fall, "tyre");
  }
}

// Against the equations worked out by hand (Python) at 2680 N, of which every digit is asked for.
TEST(VehicleImport, Pac2002AtALoad) {
  const fs::path file = kShared / "chrono-sedan/tire/Sedan_Pac02Tire.tir";
  if (!fs::exists(file)) GTEST_SKIP() << "no " << file << ": no PAC2002 tyre is tried";
  const auto tyre = TyreFile::read(file);
  ASSERT_TRUE(tyre.ok()) << tyre.error().text();
  EXPECT_STREQ(tyre->kind_name(), "PAC2002");
  EXPECT_DOUBLE_EQ(tyre->nominal_load_n(), 3928.5);
  const auto at = tyre->at_load(2680.0);
  ASSERT_TRUE(at.ok()) << at.error().text();
  EXPECT_NEAR(at->tyre.lat_peak, 1.1062099159984726, 1e-12);
  EXPECT_NEAR(at->tyre.long_peak, 1.2260042573501335, 1e-12);
  EXPECT_NEAR(at->tyre.long_stiffness, 20.701085389627522, 1e-11);
  EXPECT_NEAR(at->tyre.lat_stiffness, 19.626145695221624, 1e-11);
  EXPECT_NEAR(at->tyre.long_curvature, 0.39136071494050073, 1e-12);
  EXPECT_NEAR(at->tyre.long_relaxation_m, 0.3758207793114201, 1e-12);
  EXPECT_NEAR(at->tyre.lat_relaxation_m, 0.3675382771826515, 1e-12);
  EXPECT_NEAR(at->loaded_radius_m, 0.33445703992231934, 1e-12);
  EXPECT_EQ(at->rate_npm, 280835.2941);
  EXPECT_EQ(at->damping_nspm, 2000.0);
  const std::string first = tyre->unused().front();
  EXPECT_NE(first.find("camber: PDY3, PEY3, PEY4, PKY3"), std::string::npos) << first;
}

TEST(VehicleImport, MagicFormula61AtALoadAndPressure) {
  const auto tyre = TyreFile::parse(kTir61, "t.tir");
  ASSERT_TRUE(tyre.ok()) << tyre.error().text();
  const auto at = tyre->at_load(3000.0);
  ASSERT_TRUE(at.ok()) << at.error().text();
  EXPECT_NEAR(at->tyre.long_stiffness, 24.624667633515987, 1e-11);
  EXPECT_NEAR(at->tyre.long_peak, 1.2133625, 1e-12);
  EXPECT_NEAR(at->tyre.lat_stiffness, 13.1137796656387, 1e-11);
  EXPECT_NEAR(at->tyre.lat_peak, 1.08216, 1e-12);
  EXPECT_NEAR(at->tyre.lat_relaxation_m, 0.26116563934555537, 1e-12);
  EXPECT_NEAR(at->tyre.long_relaxation_m, 0.22217745233247507, 1e-12);
  EXPECT_NEAR(at->rate_npm, 214000.0, 1e-6);
  std::string all;
  for (const std::string& line : tyre->unused()) all += line + "; ";
  for (const char* part : {"camber: PDX3;", "shifts (conicity, ply steer): PHY1;", "PEX4", "RVY1", "QBZ1", "PDX2"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in " << all;
}

// Units of the file, and 5.2 where PTX3 has the other sign.
TEST(VehicleImport, UnitsAndKinds) {
  const std::string in_mm =
      with_replaced(with_replaced(with_replaced(with_replaced(with_replaced(kTir61, "'meter'", "'mm'"),
                                                              "UNLOADED_RADIUS = 0.32", "UNLOADED_RADIUS = 320"),
                                                "VERTICAL_STIFFNESS = 2.0D+5", "VERTICAL_STIFFNESS = 200"),
                                  "LATERAL_STIFFNESS = 150000", "LATERAL_STIFFNESS = 150"),
                    "LONGITUDINAL_STIFFNESS = 350000", "LONGITUDINAL_STIFFNESS = 350");
  const auto a = TyreFile::parse(kTir61, "a")->at_load(3000.0), b = TyreFile::parse(in_mm, "b")->at_load(3000.0);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_NEAR(a->loaded_radius_m, b->loaded_radius_m, 1e-12);
  EXPECT_NEAR(a->tyre.lat_relaxation_m, b->tyre.lat_relaxation_m, 1e-12);
  const std::string lengths = "[LONG2]\nPTX1 = 2\nPTX3 = 0.5\nPTY1 = 2\nPTY2 = 2\n";
  const auto mf52 = TyreFile::parse(with_replaced(kTir61, "FITTYP = 61", "FITTYP = 6") + lengths, "c");
  const auto pac =
      TyreFile::parse(with_replaced(kTir61, "FITTYP = 61", "PROPERTY_FILE_FORMAT = 'PAC2002'") + lengths, "d");
  ASSERT_TRUE(mf52.ok() && pac.ok());
  EXPECT_NEAR(mf52->at_load(3000.0)->tyre.long_relaxation_m, 0.75 * 2.0 * 0.32 * std::exp(0.125), 1e-12);
  EXPECT_NEAR(pac->at_load(3000.0)->tyre.long_relaxation_m, 0.75 * 2.0 * 0.32 * std::exp(-0.125), 1e-12);
}

TEST(VehicleImport, BadFilesAreRefusedWithPlaceAndReason) {
  for (const auto& [from, to, says] : {std::tuple{"PCX1 = 1.6", "PCX1 = one", "t.tir:26: PCX1 is no number: one"},
                                       {"PCX1 = 1.6", "PCX1 1.6", "t.tir:26: expected KEY = value"},
                                       {"PDX1 = 1.2", "PCX1 = 1.2", "t.tir:27: PCX1 was there already, in line 26"},
                                       {"'meter'", "'cubit'", "t.tir:4: LENGTH 'CUBIT' is not known"},
                                       {"'radians'", "'degree'", "t.tir:6: ANGLE 'DEGREE'"},
                                       {"FITTYP = 61", "FITTYP = 62", "no Magic Formula that is read here"},
                                       {"[UNITS]", "[UNITS", "t.tir:3: a section"}}) {
    const auto read = TyreFile::parse(with_replaced(kTir61, from, to), "t.tir");
    ASSERT_FALSE(read.ok()) << to;
    EXPECT_NE(read.error().text().find(says), std::string::npos) << read.error().text();
  }
  const auto without = TyreFile::parse(with_replaced(kTir61, "PKY2 = 2.1", "PKY9 = 2.1"), "t.tir")->at_load(3000.0);
  ASSERT_FALSE(without.ok());
  EXPECT_EQ(without.error().text(), "t.tir: has no PKY2");
  const fs::path tyre = put_file("tyre.yaml", kTyreYaml);
  for (const auto& [from, to, says] : {std::tuple{"m: 1200.0", "m: heavy", "car.yaml:8: \"m\" is no finite number"},
                                       {"m: 1200.0", "m: .nan", "car.yaml:8: \"m\" is no finite number"},
                                       {"a: 1.1", "b: 1.1", "was there already"},
                                       {"h_s: 0.6", "h_x: 0.6", "has no \"h_s\""},
                                       {"h_s: 0.6", "h_s: 6.0", "cg_height_m"},
                                       {"l: 4.4", "l: [4.4", "car.yaml"}}) {
    const auto made = vehicle_of_commonroad(put_file("car.yaml", with_replaced(kVehicleYaml, from, to)), tyre, {});
    ASSERT_FALSE(made.ok()) << to;
    EXPECT_NE(made.error().text().find(says), std::string::npos) << made.error().text();
  }
  EXPECT_FALSE(vehicle_of_commonroad("/nowhere.yaml", tyre, {}).ok());
  EXPECT_FALSE(TyreFile::read("/dev/null").ok());
}

// fuzz: whatever is cut off or turned over, an error or numbers, never a crash.
TEST(VehicleImport, DamagedFiles) {
  std::mt19937 random(15);
  for (int i = 0; i < 400; ++i) {
    std::string tir = kTir61, yaml = kVehicleYaml;
    for (std::string* text : {&tir, &yaml}) {
      for (int k = 0; k < 4; ++k) (*text)[random() % text->size()] = static_cast<char>(random());
      if (i % 3 == 0) text->resize(random() % text->size());
    }
    if (const auto read = TyreFile::parse(tir, "t.tir"); read.ok()) {
      (void)read->unused();
      if (const auto at = read->at_load(3000.0); at.ok()) {
        EXPECT_EQ(at->load_n, 3000.0);
      }
    }
    (void)vehicle_of_commonroad(put_file("damaged.yaml", yaml), put_file("tyre.yaml", kTyreYaml), {});
  }
}

// ---- load

VehicleParams with_boot(double kg) {
  const auto car = loaded(test::car("hatchback.toml"), {{kg, -0.35, 0.7}});
  if (!car) throw std::runtime_error(car.error().text());
  return *car;
}

// Forces and moments of what the springs take on, about the rear axle.
TEST(Load, SpringsCarryIt) {
  const VehicleParams empty = test::car("hatchback.toml"), car = with_boot(100.0);
  EXPECT_DOUBLE_EQ(car.mass_kg, empty.mass_kg + 100.0);
  const double front_m = -(car.rest.heave_m - car.wheelbase_m * car.rest.pitch_rad), rear_m = -car.rest.heave_m;
  const auto series = [&](double spring) { return 2.0 * spring * car.tyre_rate_npm / (spring + car.tyre_rate_npm); };
  const double front_n = series(car.front_rate_npm) * front_m, rear_n = series(car.rear_rate_npm) * rear_m;
  EXPECT_NEAR(front_n + rear_n, 100.0 * kGravity_mps2, 1e-9);
  EXPECT_NEAR(front_n * car.wheelbase_m, 100.0 * kGravity_mps2 * -0.35, 1e-9);
  EXPECT_LT(car.rest.pitch_rad, -0.008);  // the nose is up by half a degree and more
  EXPECT_GT(car.chassis->rear_sunk_m, 0.01);
  EXPECT_LT(car.chassis->front_sunk_m, 0.0);
  EXPECT_GT(car.chassis->yaw_inertia_kgm2, empty.chassis->yaw_inertia_kgm2);
}

TEST(Load, KeysOfTheVehicleFile) {
  std::stringstream text;
  text << std::ifstream(vehicles_dir() + "/hatchback.toml").rdbuf();
  const auto car = parse_vehicle(with_replaced(text.str(), "boot_kg = 0", "boot_kg = 100"), "hatchback");
  ASSERT_TRUE(car.ok()) << car.error().text();
  EXPECT_DOUBLE_EQ(car->rest.pitch_rad, with_boot(100.0).rest.pitch_rad);
  EXPECT_EQ(test::car("hatchback.toml").rest.pitch_rad, 0.0);
  for (const auto& [from, to, says] :
       {std::tuple{"boot_kg = 0", "boot_kg = 2000", "rests on the stops"},
        {"boot_kg = 0", "boot_kg = -3", "boot_kg"},
        {"rear_passengers_kg = 0\nrear_seats_x_m = 0.45", "rear_passengers_kg = 150", "rear_seats_x_m"},
        {"boot_kg = 0", "boot_gk = 0", "boot_kg"}}) {
    const auto bad = parse_vehicle(with_replaced(text.str(), from, to), "hatchback");
    ASSERT_FALSE(bad.ok()) << to;
    EXPECT_NE(bad.error().text().find(says), std::string::npos) << bad.error().text();
  }
}

// It stands at every level as its springs hold it, live and in batch, and levelling brings the beam back.
TEST(Load, StandsStillAtEveryLevelAndIsLevelled) {
  const VehicleParams car = with_boot(100.0);
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kAuto}) {
    RunSetup setup;
    setup.level = level;
    setup.vehicle = car;
    setup.levelling = levelling::Kind::kStatic;
    setup.sprung = *SprungParams::of(car, "loaded");
    StepLoop loop(setup, CarState{});
    Controls held;
    held.brake_01 = 1.0;
    loop.set_controls(held);
    for (const double time : {0.0, 0.5, 2.0}) {
      loop.run_to(test::seconds(time));
      const VehicleState shown = loop.at(loop.time());
      EXPECT_NEAR(shown.pitch_rad, car.rest.pitch_rad, 1e-9) << name(level) << " at " << time;
      EXPECT_NEAR(shown.suspension_heave_m, car.rest.heave_m, 1e-9) << name(level) << " at " << time;
      EXPECT_NEAR(shown.lamp_tilt_rad, car.rest.pitch_rad, 1e-9) << name(level) << " at " << time;
    }
  }
  batch::Inputs inputs;
  inputs.time_s = {0.0, 1.0}, inputs.steer_rad = {0.0, 0.0};
  inputs.accelerator_01 = {0.0, 0.0}, inputs.brake_01 = {1.0, 1.0};
  double cutoff_m[3] = {};
  for (const int run : {0, 1, 2}) {  // empty, loaded, loaded and levelled
    batch::Options options;
    options.vehicle = run == 0 ? test::car("hatchback.toml") : car;
    if (run == 2) options.levelling = levelling::Kind::kStatic;
    ASSERT_TRUE(batch::run(options, inputs, [&](const batch::Row& row) { cutoff_m[run] = row.cutoff_25m_m; }).ok());
  }
  const double sunk_m = car.levelling.lamp_x_m * -car.rest.pitch_rad + car.rest.heave_m;  // of the lamps: they rise
  // Second order in angles of a hundredth: 25 m times 1e-4.
  EXPECT_NEAR(cutoff_m[1] - cutoff_m[0], sunk_m - 25.0 * car.rest.pitch_rad, 2.5e-3);
  EXPECT_NEAR(cutoff_m[2] - cutoff_m[0], sunk_m, 2.5e-3);
}

// A message is counted from the car without its load, whoever reads it: a process that goes on from a picture starts
// where the car was.
TEST(Load, MessagesCountFromTheEmptyCar) {
  const VehicleParams car = with_boot(100.0);
  CarState state;
  state.x_m = 3.0, state.speed_mps = 10.0, state.pitch_rad = 0.003, state.heave_m = -0.002;
  const CarState back = from_message(to_message(state, car.rest), car.wheelbase_m, car.track_m, car.rest);
  EXPECT_NEAR(back.pitch_rad, state.pitch_rad, 1e-15);
  EXPECT_NEAR(back.heave_m, state.heave_m, 1e-15);
  EXPECT_NEAR(back.road_pitch_rad, 0.0, 1e-15);
  EXPECT_NEAR(back.z_m, 0.0, 1e-15);
}

}  // namespace
}  // namespace phare
