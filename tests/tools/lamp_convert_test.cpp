// process: `phare lamp convert`: what is exact, what is told where it is not, what the new file says of itself.
#include <nlohmann/json.hpp>

#include "lamp_program.h"
#include "tests/paths.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

class LampConvert : public test::LampProgram {
 protected:
  nlohmann::json convert(const std::string& arguments) const {
    const Said said = lamp("convert " + arguments + " --json");
    EXPECT_EQ(said.code, 0) << said.err;
    return nlohmann::json::parse(said.out, nullptr, false);
  }
  static std::string keywords(const IntensityTable& table) {
    std::string text;
    for (const auto& [key, value] : table.header.keywords) text += "[" + key + "] " + value + "\n";
    return text;
  }
};

// Type A is type C about the same axis: C = -H, gamma = 90 + V. What EULUMDAT stores is cd per 1000 lm, so a number
// comes back to the last bits; an angle near 360 is rounded to 6e-14°, and a beam changes by less than 20 peaks per
// degree.
constexpr double kRounding = 2e-12;
TEST_F(LampConvert, EulumdatWithItsAxisAtGamma90KeepsTypeA) {
  const auto json = convert(ours("low_rht.ies") + " --out-axis gamma90 --out " + in("low.ldt"));
  EXPECT_LT(json["worst_difference_of_peak"], kRounding);
  EXPECT_EQ(json["axis"], "gamma90");
  LampReadSettings settings;
  settings.axis = GammaAxis::kGamma90;
  const auto back = read_lamp(in("low.ldt"), settings), given = read_lamp(ours("low_rht.ies"));
  ASSERT_TRUE(back.ok() && given.ok());
  for (const double h : {-89.0, -3.43, 0.0, 0.013, 1.15, 60.0, 120.0}) {
    for (const double v : {-30.0, -0.57, 0.0, 1.0, 45.0}) {
      const double cd = given->intensity_cd(direction_hv(h, v));
      EXPECT_NEAR(back->intensity_cd(direction_hv(h, v)), cd, 1e-9 * given->peak_cd()) << h << " " << v;
    }
  }
  // And from there to LM-63 and back to the same.
  const auto again = convert(in("low.ldt") + " --axis gamma90 --out-axis gamma90 --out " + in("again.ldt"));
  EXPECT_LT(again["worst_difference_of_peak"], kRounding);
  // On the default axis it is resampled, which is told with the way out.
  const Said said = lamp("convert " + ours("low_rht.ies") + " --out " + in("polar.ldt"));
  EXPECT_NE(said.out.find("--out-axis gamma90 keeps the nodes"), std::string::npos) << said.out;
  EXPECT_EQ(lamp("convert " + ours("fog.ies") + " --out-axis gamma90 --out " + in("fog.csv")).code, 2);
}

// A table that ends in light keeps its dark outside: H -5 to 10 in EULUMDAT's whole circle.
TEST_F(LampConvert, EulumdatKeepsTheDarkBesideATableThatEndsInLight) {
  IntensityTable table;
  table.name = "lit.ies";
  table.first_deg = {-5, 2, 10};
  table.second_deg = {-3, 4};
  table.candela = {100, 200, 300, 400, 500, 600};
  LampReadSettings settings;
  settings.axis = GammaAxis::kGamma90;
  const auto back = parse_lamp(eulumdat_text(table, GammaAxis::kGamma90), "lit.ldt", settings);
  ASSERT_TRUE(back.ok()) << back.error().text();
  for (const double h : {-5.0, -1.0, 0.0, 2.0, 9.9}) {
    EXPECT_NEAR(back->intensity_cd(direction_hv(h, 1.0)), table.intensity_cd(direction_hv(h, 1.0)), 1e-9) << h;
  }
  for (const double h : {-5.02, 10.02, 90.0, 179.0, -120.0})
    EXPECT_EQ(back->intensity_cd(direction_hv(h, 1.0)), 0.0) << h;
}

// A screen goes out as lux over metres and comes back; 14 digits are written.
TEST_F(LampConvert, AScreenIsWrittenBackAsAScreen) {
  const std::string given =
      file("wall.csv", "# unit: lx\n# distance_m: 25\nz\\y,-3.3,-0.1,0,2\n-1.5,1.25,2,3,4.75\n0.4,5,6,7,8\n");
  const auto json = convert(given + " --out " + in("back.csv"));
  EXPECT_LT(json["worst_difference_of_peak"], 1e-12);
  EXPECT_EQ(json["photometric_type"], "screen");
  const std::string text = test::content_of(in("back.csv"));
  EXPECT_NE(text.find("z\\y,-3.3,-0.1,0,2\n-1.5,1.25,2,3,4.75\n0.4,5,6,7,8\n"), std::string::npos) << text;
}

TEST_F(LampConvert, TellsTheTrueWorstDifference) {
  // A goniometer file on type A keeps every number, up to its limits.
  const std::string given =
      file("gonio.csv", "# unit: lx\n# distance_m: 25\n# angles: type A\nV\\H,-33.3,0.1,17.7\n-7.1,1,2,3\n2.3,4,5,6\n");
  EXPECT_EQ(convert(given + " --out " + in("gonio_back.csv"))["worst_difference_cd"], 0.0);
  // A sum of two grids of one type is exact; one of different types is not, and says how much it is off its parts.
  EXPECT_LT(
      convert(ours("low_rht.ies") + " " + ours("fog.ies") + " --out " + in("sum.ies"))["worst_difference_of_peak"],
      1e-12);
  convert(ours("low_rht.ies") + " --out " + in("low.ldt"));
  const auto json = convert(ours("fog.ies") + " " + in("low.ldt") + " --out " + in("mixed.ies"));
  const auto a = read_lamp(ours("fog.ies")), b = read_lamp(in("low.ldt")), sum = read_lamp(in("mixed.ies"));
  ASSERT_TRUE(a.ok() && b.ok() && sum.ok());
  double worst = 0.0;  // looked for independently, on a grid of neither
  for (double h = -5.0; h <= 5.0; h += 0.037) {
    for (double v = -3.0; v <= 1.0; v += 0.013) {
      const glm::dvec3 d = direction_hv(h, v);
      worst = std::max(worst, std::abs(a->intensity_cd(d) + b->intensity_cd(d) - sum->intensity_cd(d)));
    }
  }
  EXPECT_GT(worst, 1.0);
  EXPECT_GT(json["worst_difference_cd"],
            0.5 * worst);  // nodes and middles of cells see at least half of a wedge's error
}

TEST_F(LampConvert, MirrorTurnsTheWordsWithTheBeam) {
  convert(ours("low_rht.ies") + " --mirror --out " + in("lht.ies"));
  const auto table = read_lamp(in("lht.ies"));
  ASSERT_TRUE(table.ok()) << table.error().text();
  EXPECT_NE(keywords(*table).find("left-hand traffic"), std::string::npos);
  EXPECT_EQ(keywords(*table).find("right-hand traffic"), std::string::npos) << keywords(*table);
  EXPECT_NE(keywords(*table).find("Mirrored left to right"), std::string::npos);
  EXPECT_EQ(lamp("info " + in("lht.ies")).out.find("keywords say"), std::string::npos);
  // Set right, not turned to the other side: a file stored mirrored whose words were right.
  IntensityTable clockwise = *read_lamp(ours("low_rht.ies"));
  mirror_left_right(clockwise);
  convert(file("clockwise.ies", lm63_text(clockwise)) + " --mirror --out " + in("right.ies"));
  EXPECT_NE(keywords(*read_lamp(in("right.ies"))).find("right-hand traffic"), std::string::npos);
}

TEST_F(LampConvert, ASumSaysWhatItsPartsAgreeOn) {
  convert(ours("low_rht.ies") + " " + ours("high.ies") + " --out " + in("sum.ies"));
  const auto table = read_lamp(in("sum.ies")), low = read_lamp(ours("low_rht.ies"));
  ASSERT_TRUE(table.ok() && low.ok());
  const std::string words = keywords(*table);
  EXPECT_NE(words.find("[MANUFAC] Phare"), std::string::npos) << words;
  EXPECT_EQ(words.find("low_rht\n"), std::string::npos) << words;
  EXPECT_NE(words.find("Sum of low_rht.ies, high.ies"), std::string::npos) << words;
  char flux[40];
  std::snprintf(flux, sizeof flux, "Flux %.1f lm", low->flux_lm());
  EXPECT_EQ(words.find(flux), std::string::npos) << words;
}

TEST(TrafficWords, WholeWordsInTheirCase) {
  EXPECT_EQ(with_traffic_side("for Right-hand traffic, RHT", true), "for Left-hand traffic, LHT");
  EXPECT_EQ(with_traffic_side("low_rht.ies, straight hand traffic", true), "low_lht.ies, straight hand traffic");
  EXPECT_EQ(with_traffic_side("LEFT HAND TRAFFIC", false), "RIGHT HAND TRAFFIC");
  EXPECT_EQ(with_traffic_side("left-hand traffic", true), "left-hand traffic");
}

// Lamps, rated lumens, housing and watts come through every format that has them.
TEST(WriteLamp, TheHeaderComesThrough) {
  const std::string given =
      "IESNA:LM-63-2002\n[MANUFAC] m\nTILT=NONE\n2 450 1 2 2 3 1 0.5 -0.25 0.125\n1 1 55\n-1 1\n-1 1\n10 20\n30 40\n";
  const auto table = parse_lamp(given, "a.ies");
  ASSERT_TRUE(table.ok()) << table.error().text();
  const auto back = parse_lamp(lm63_text(*table), "b.ies");
  ASSERT_TRUE(back.ok()) << back.error().text();
  const auto same = [&](const IntensityTable& other, double exactly) {
    EXPECT_EQ(other.header.lamp_count, 2.0);
    EXPECT_FALSE(other.header.absolute);
    EXPECT_EQ(other.header.stated_flux_lm, 900.0);
    EXPECT_EQ(other.header.input_w, 55.0);
    EXPECT_NEAR(other.header.length_m, table->header.length_m, exactly);
  };
  same(*back, 0.0);
  EXPECT_EQ(back->header.units, "feet");
  EXPECT_EQ(back->header.width_m, 0.5 * 0.3048);
  EXPECT_EQ(back->header.length_m, -0.25 * 0.3048);
  EXPECT_EQ(back->header.height_m, 0.125 * 0.3048);
  LampReadSettings settings;
  settings.axis = GammaAxis::kGamma90;
  IntensityTable square = *table;
  square.header.length_m = 0.25 * 0.3048;
  const auto ldt = parse_lamp(eulumdat_text(square, GammaAxis::kGamma90), "a.ldt", settings);
  ASSERT_TRUE(ldt.ok()) << ldt.error().text();
  EXPECT_EQ(ldt->header.lamp_count, 2.0);
  EXPECT_EQ(ldt->header.stated_flux_lm, 900.0);
  EXPECT_EQ(ldt->header.input_w, 55.0);
  EXPECT_NEAR(ldt->header.width_m, 0.5 * 0.3048, 1e-12);
  EXPECT_NEAR(ldt->header.length_m, 0.25 * 0.3048, 1e-12);
  EXPECT_NEAR(ldt->header.output_ratio * 900.0, ldt->flux_lm(), 1e-9);
  const auto lm63 = parse_lamp(lm63_text(*ldt), "c.ies");
  ASSERT_TRUE(lm63.ok()) << lm63.error().text();
  EXPECT_EQ(lm63->header.stated_flux_lm, 900.0);
  EXPECT_FALSE(lm63->header.absolute);
}

// Files of other people: what a format can hold comes back. Shortest digits that read as the same number, so only what
// is computed on the way (angles from 9 decimals, candela per 1000 lm) may cost last bits.
TEST(WriteLamp, EveryFileOfTheDataSetComesBack) {
  const std::filesystem::path folder = shared_data_dir() + "/photometry";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".ies" && ending != ".ldt") continue;
    const auto table = read_lamp(entry.path());
    ASSERT_TRUE(table.ok()) << table.error().text();
    const IntensityTable* one[] = {&*table};
    const auto off = [&](const std::string& text, const char* name) {
      const auto back = parse_lamp(text, name);
      EXPECT_TRUE(back.ok()) << entry.path() << " " << back.error().text();
      return back.ok() ? difference_from_sum(one, *back).worst_cd / table->peak_cd() : 1.0;
    };
    EXPECT_LT(off(lm63_text(*table), "back.ies"), 1e-12) << entry.path();
    EXPECT_LT(off(csv_text(*table), "back.csv"), 1e-12) << entry.path();
    if (table->type == PhotometricType::kC) {
      EXPECT_LT(off(eulumdat_text(*table), "back.ldt"), 1e-12) << entry.path();
    }
    ++count;
  }
  EXPECT_EQ(count, 37u);
}

}  // namespace
}  // namespace phare
