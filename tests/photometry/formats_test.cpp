// EULUMDAT, TM-33 and CSV on small files of our own with values worked out by hand, the front door that finds the
// format, and every file of the photometry data set.
#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "photometry_test_files.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

Result<IntensityTable> parse(const std::string& text, const std::string& name, const LampReadSettings& settings = {}) {
  return parse_lamp(text, name, settings);
}

std::string refusal(const std::string& text, const std::string& name) {
  const auto table = parse(text, name);
  return table.ok() ? "read" : table.error().text();
}

/// EULUMDAT with these numbers; `sets` lamp sets of 1000, 2000, … lm.
std::string ldt(int isym, const std::vector<double>& c, const std::vector<double>& gamma,
                const std::vector<std::string>& values, int sets = 1, const std::string& conversion = "1") {
  std::string text = "Maker\n1\n" + std::to_string(isym) + "\n" + std::to_string(c.size()) + "\n0\n" +
                     std::to_string(gamma.size()) + "\n0\nreport\nname\nnumber\nfile\n2024\n";
  for (int i = 13; i <= 21; ++i) text += "0\n";
  text += "100\n80\n" + conversion + "\n0\n" + std::to_string(sets) + "\n";
  for (int i = 1; i <= sets; ++i) text += "1\nLED\n" + std::to_string(1000 * i) + "\nwhite\n80\n10\n";
  for (int i = 0; i < 10; ++i) text += "0.5\n";
  for (const double a : c) text += std::to_string(a) + "\n";
  for (const double a : gamma) text += std::to_string(a) + "\n";
  for (const std::string& v : values) text += v + "\n";
  return text;
}

TEST(Eulumdat, TheFiveSymmetriesUnfold) {
  const std::vector<double> c{0, 90, 180, 270}, gamma{0, 90};
  const auto at90 = [](const Result<IntensityTable>& table, double c_deg) {
    return table->intensity_at_cd({c_deg, 90.0});
  };
  const auto none = parse(ldt(0, c, gamma, {"1", "10", "1", "20", "1", "30", "1", "40"}), "a.ldt");
  ASSERT_TRUE(none.ok()) << none.error().text();
  EXPECT_EQ(none->first_deg, (std::vector<double>{0, 90, 180, 270, 360}));
  EXPECT_DOUBLE_EQ(at90(none, 315), 25.0);
  const auto axis = parse(ldt(1, {0}, gamma, {"1", "10"}), "a.ldt");
  ASSERT_TRUE(axis.ok()) << axis.error().text();
  EXPECT_DOUBLE_EQ(at90(axis, 217), 10.0);
  const auto plane0 = parse(ldt(2, c, gamma, {"1", "10", "1", "20", "1", "30"}), "a.ldt");
  ASSERT_TRUE(plane0.ok()) << plane0.error().text();
  EXPECT_DOUBLE_EQ(at90(plane0, 270), 20.0);
  EXPECT_DOUBLE_EQ(at90(plane0, 180), 30.0);
  const auto plane90 = parse(ldt(3, c, gamma, {"1", "10", "1", "20", "1", "30"}), "a.ldt");  // C 270, 0, 90
  ASSERT_TRUE(plane90.ok()) << plane90.error().text();
  EXPECT_DOUBLE_EQ(at90(plane90, 270), 10.0);
  EXPECT_DOUBLE_EQ(at90(plane90, 0), 20.0);
  EXPECT_DOUBLE_EQ(at90(plane90, 180), 20.0);
  EXPECT_DOUBLE_EQ(at90(plane90, 90), 30.0);
  const auto quadrant = parse(ldt(4, c, gamma, {"1", "10", "1", "20"}), "a.ldt");
  ASSERT_TRUE(quadrant.ok()) << quadrant.error().text();
  for (const double angle : {0.0, 180.0, 360.0}) EXPECT_DOUBLE_EQ(at90(quadrant, angle), 10.0);
  for (const double angle : {90.0, 270.0}) EXPECT_DOUBLE_EQ(at90(quadrant, angle), 20.0);
}

TEST(Eulumdat, HalfATurnIsNoLamp) {
  const std::vector<double> gamma{0, 90};
  const std::string half = ldt(0, {0, 90, 180}, gamma, {"1", "10", "1", "20", "1", "30"});
  EXPECT_NE(refusal(half, "a.ldt").find("a.ldt:45: the C angles end at 180 although Isym is 0"), std::string::npos)
      << refusal(half, "a.ldt");
  const auto two = parse(ldt(0, {0, 180}, gamma, {"1", "10", "1", "20"}), "a.ldt");
  ASSERT_TRUE(two.ok()) << two.error().text();
  EXPECT_DOUBLE_EQ(two->intensity_at_cd({90.0, 90.0}), 15.0);
}

TEST(Eulumdat, HeadersThatContradictTheAnglesAreTold) {
  const auto notes = [](std::string text, std::size_t line, const std::string& value) {
    std::size_t at = 0;
    for (std::size_t i = 1; i < line; ++i) at = text.find('\n', at) + 1;
    text.replace(at, text.find('\n', at) - at, value);
    const auto table = parse(text, "a.ldt");
    return table.ok() ? table->notes : std::vector<std::string>{table.error().text()};
  };
  const std::string good =
      ldt(0, {0, 90, 180, 270}, {0, 45, 90}, {"1", "2", "3", "1", "2", "3", "1", "2", "3", "1", "2", "3"});
  for (const auto& [line, value] : {std::pair<std::size_t, const char*>{5, "90"}, {7, "45"}, {25, "0"}})
    EXPECT_TRUE(notes(good, line, value).empty()) << line;
  for (const auto& [line, value, says] :
       {std::tuple{std::size_t{5}, "10", "a.ldt:5: the distance Dc of C planes (5) is 10 deg, but 90 follows 0"},
        std::tuple{std::size_t{7}, "5", "a.ldt:7: the distance Dg of gamma angles (7) is 5 deg, but 45 follows 0"},
        std::tuple{std::size_t{25}, "15", "a.ldt:25: measured with the luminaire tilted by 15 deg"}}) {
    const auto told = notes(good, line, value);
    ASSERT_EQ(told.size(), 1u) << line;
    EXPECT_EQ(told[0].rfind(says, 0), 0u) << told[0];
  }
}

/// Lines 2 to 7 and 22 of what is written: Ityp, Isym, Mc, Dc, Ng, Dg and DFF.
TEST(Eulumdat, TheHeaderThatIsWrittenIsTrue) {
  const auto head = [](const IntensityTable& table) {
    const std::string text = eulumdat_text(table, GammaAxis::kGamma0);
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
      lines.push_back(text.substr(at, text.find('\r', at) - at));
    return std::vector<std::string>{lines[1], lines[2], lines[3], lines[4], lines[5], lines[6], lines[21]};
  };
  // The same in all directions: half of it goes down.
  const auto round = parse(ldt(1, {0}, {0, 45, 90, 135, 180}, {"5", "5", "5", "5", "5"}), "a.ldt");
  ASSERT_TRUE(round.ok()) << round.error().text();
  EXPECT_EQ(head(*round), (std::vector<std::string>{"1", "1", "1", "0", "5", "45", "50"}));
  const auto down = parse(ldt(0, {0, 90, 180, 270}, {0, 30, 90}, std::vector<std::string>(12, "5")), "a.ldt");
  ASSERT_TRUE(down.ok()) << down.error().text();
  EXPECT_EQ(head(*down), (std::vector<std::string>{"3", "0", "4", "90", "3", "0", "100"}));
}

TEST(Eulumdat, LampSetsAndFactorsScale) {
  const std::string text = ldt(1, {0}, {0, 90}, {"7", "10"}, 3, "0.5");
  LampReadSettings second;
  second.lamp_set = 2;
  EXPECT_DOUBLE_EQ(parse(text, "a.ldt")->peak_cd(), 10 * 1.0 * 0.5);
  EXPECT_DOUBLE_EQ(parse(text, "a.ldt", second)->peak_cd(), 10 * 2.0 * 0.5);
  second.lamp_set = 4;
  EXPECT_EQ(parse(text, "a.ldt", second).error().text(), "a.ldt:26: lamp set 4 was asked for, the file has 3");
  EXPECT_EQ(parse(text, "a.ldt")->header.stated_flux_lm, 1000.0);
  EXPECT_DOUBLE_EQ(parse(text, "a.ldt")->header.output_ratio, 0.8);
}

TEST(ReadLamp, WhatIsAskedAndNotThereIsRefusedAndWhatIsNotUsedIsTold) {
  const std::string grid = "# unit: cd\n# angles: A\nH\\V,0,1\n0,1,2\n5,3,4\n";
  LampReadSettings asked;
  asked.lamp_set = 3;
  EXPECT_EQ(parse(grid, "a.csv", asked).error().text(), "a.csv: has no lamp set 3: only EULUMDAT files have several");
  asked = {};
  asked.emitter = 2;
  EXPECT_EQ(parse(ldt(1, {0}, {0, 90}, {"7", "10"}), "a.ldt", asked).error().text(),
            "a.ldt: has no emitter 2: only TM-33 files have several");
  asked = {};
  asked.c0_turn_deg = 90.0;
  const auto turned = parse(grid, "a.csv", asked);
  ASSERT_TRUE(turned.ok()) << turned.error().text();
  EXPECT_EQ(turned->notes.back(), "a.csv: axis and C 0 are of type C and EULUMDAT; not used here");
  EXPECT_TRUE(parse(ldt(1, {0}, {0, 90}, {"7", "10"}), "a.ldt", asked)->notes.empty());
}

TEST(Eulumdat, DecimalCommasAreReadAndReported) {
  const auto table = parse(ldt(1, {0}, {0, 90}, {"7,25", "10,5"}), "a.ldt");
  ASSERT_TRUE(table.ok()) << table.error().text();
  EXPECT_DOUBLE_EQ(table->peak_cd(), 10.5);
  ASSERT_EQ(table->notes.size(), 1u);
  EXPECT_EQ(table->notes[0], "a.ldt:46: decimal comma read as a point, 2 time(s)");
}

TEST(Eulumdat, RefusalsSayWhereAndWhy) {
  const std::string good = ldt(1, {0}, {0, 90}, {"7", "10"});
  EXPECT_EQ(refusal("a\nb\n", "a.ldt"), "a.ldt:2: ends after 2 lines: not EULUMDAT, or cut off");
  EXPECT_EQ(refusal(ldt(5, {0}, {0, 90}, {"7", "10"}), "a.ldt"), "a.ldt:3: the symmetry Isym is 5, not 0 to 4");
  EXPECT_EQ(refusal(ldt(1, {0}, {90, 0}, {"7", "10"}), "a.ldt"),
            "a.ldt:45: gamma angles must increase, but 0 follows 90");
  EXPECT_EQ(refusal(ldt(1, {0}, {0, 90}, {"7", "x"}), "a.ldt"),
            "a.ldt:47: an intensity (value 2 of 2) is not a finite number: \"x\"");
  EXPECT_EQ(refusal(ldt(1, {0}, {0, 90}, {"7", "-1"}), "a.ldt"), "a.ldt:47: negative intensity -1");
  EXPECT_EQ(refusal(ldt(1, {0}, {0, 90}, {"7"}), "a.ldt"),
            "a.ldt:46: the file ends where an intensity (value 2 of 2) is expected");
  EXPECT_EQ(refusal(ldt(3, {0, 120, 240}, {0, 90}, {"7"}), "a.ldt"),
            "a.ldt:4: 3 C planes cannot have the symmetry Isym 3");
}

std::string tm33(const std::string& body, const std::string& extra = "") {
  return "<?xml version=\"1.0\"?>\n<t:IESTM33-22 xmlns:t=\"http://www.ies.org/tm-33\">\n<Version>1.1</Version>\n"
         "<Header><Manufacturer>none</Manufacturer></Header>\n<Emitter>\n<RatedLumens>800</RatedLumens>\n" +
         extra + "<LuminousData>\n" + body + "</LuminousData></Emitter></t:IESTM33-22>\n";
}

std::string datum(double h, double v, double cd) {
  return "<IntensityData horz=\"" + std::to_string(h) + "\" vert=\"" + std::to_string(v) + "\">" + std::to_string(cd) +
         "</IntensityData>\n";
}

TEST(Tm33, ReadsTypesSymmetryAndMultiplier) {
  std::string body =
      "<PhotometryType>CIE _ C</PhotometryType><SymmType>Symm _ Quad</SymmType><Multiplier>2</Multiplier>\n";
  for (const double c : {90.0, 0.0}) {  // in any order
    for (const double g : {0.0, 60.0}) body += datum(c, g, c + g);
  }
  const auto table = parse(tm33(body), "a.xml");
  ASSERT_TRUE(table.ok()) << table.error().text();
  EXPECT_EQ(table->type, PhotometricType::kC);
  EXPECT_EQ(table->version, "IESTM33-22 1.1");
  EXPECT_EQ(table->first_deg, (std::vector<double>{0, 90, 180, 270, 360}));
  EXPECT_DOUBLE_EQ(table->intensity_at_cd({270, 60}), 300.0);
  EXPECT_EQ(table->header.stated_flux_lm, 800.0);

  std::string type_a = "<PhotometryType>CIE-A</PhotometryType><SymmType>Symm _ None</SymmType>";
  for (const double h : {0.0, 10.0}) {
    for (const double v : {-5.0, 5.0}) type_a += datum(h, v, 10 * h + v + 5);
  }
  const auto a = parse(tm33(type_a), "a.xml");
  ASSERT_TRUE(a.ok()) << a.error().text();
  EXPECT_EQ(a->first_deg, (std::vector<double>{0, 10}));  // symmetry none: not mirrored
  EXPECT_DOUBLE_EQ(a->intensity_at_cd({5, 0}), 55.0);
}

TEST(Tm33, RefusalsSayWhereAndWhy) {
  const std::string c = "<PhotometryType>C</PhotometryType>\n";
  EXPECT_EQ(refusal("<a>", "a.xml").substr(0, 14), "a.xml:1: not X");
  EXPECT_EQ(refusal("<a/>", "a.xml"), "a.xml:1: the root element is \"a\", not IESTM33-22 or LuminaireOpticalData");
  EXPECT_EQ(refusal("<IESTM33-22/>", "a.xml"), "a.xml:1: no Emitter with LuminousData");
  EXPECT_EQ(refusal(tm33(c), "a.xml"), "a.xml:7: no IntensityData");
  EXPECT_EQ(refusal(tm33(c + datum(0, 0, 1) + datum(0, 0, 1)), "a.xml"), "a.xml:10: the direction 0, 0 is there twice");
  EXPECT_EQ(refusal(tm33(c + datum(0, 0, 1) + datum(0, 9, -1)), "a.xml"), "a.xml:10: negative intensity -1");
  EXPECT_EQ(refusal(tm33(c + datum(0, 0, 1) + datum(0, 9, 1) + datum(90, 0, 1)), "a.xml"),
            "a.xml:7: the directions are no grid: the last plane is short");
  EXPECT_EQ(refusal(tm33("<PhotometryType>D</PhotometryType>"), "a.xml"),
            "a.xml:8: PhotometryType is \"D\", not A, B or C");
}

TEST(LampCsv, GoniometerScreenAndList) {
  const auto gonio =
      parse("# unit: lx\n# distance_m: 10\n# angles: type B\nV\\H,10,0,-10\n5,1,2,3\n-5,4,5,6\n", "a.csv");
  ASSERT_TRUE(gonio.ok()) << gonio.error().text();
  EXPECT_EQ(gonio->type, PhotometricType::kB);
  EXPECT_EQ(gonio->first_deg, (std::vector<double>{-10, 0, 10}));  // descending axes come out ascending
  EXPECT_EQ(gonio->candela, (std::vector<double>{600, 500, 400, 300, 200, 100}));
  EXPECT_TRUE(gonio->notes.empty());

  // 1 lx all over a screen at 10 m: I = r³/D, and the flux is the area.
  const auto screen = parse("# unit: lx\n# distance_m: 10\nz\\y,-4,0,4\n-3,1,1,1\n3,1,1,1\n", "a.csv");
  ASSERT_TRUE(screen.ok()) << screen.error().text();
  EXPECT_NEAR(screen->intensity_cd({10, 3, 2}), std::pow(113.0, 1.5) / 10.0, 1e-10);
  EXPECT_NEAR(screen->flux_lm(), 48.0, 1e-12);
  EXPECT_EQ(screen->intensity_cd({10, 4.001, 0}), 0.0);
  EXPECT_EQ(screen->intensity_cd({-10, 0, 0}), 0.0);

  const auto list = parse("h_deg;v_deg;intensity_cd\n0;0;1,5\n0;1;2\n5;0;3\n5;1;4\n", "a.csv");
  ASSERT_TRUE(list.ok()) << list.error().text();
  EXPECT_EQ(list->candela, (std::vector<double>{1.5, 3, 2, 4}));

  const auto turned = parse("# unit: cd\n# angles: A\nH\\V,0,1\n0,1,2\n5,3,4\n", "a.csv");
  ASSERT_TRUE(turned.ok()) << turned.error().text();
  EXPECT_EQ(turned->first_deg, (std::vector<double>{0, 5}));
  EXPECT_EQ(turned->candela, (std::vector<double>{1, 3, 2, 4}));
}

TEST(LampCsv, RefusalsSayWhereAndWhy) {
  EXPECT_EQ(refusal("# unit: m\nV\\H,0,1\n", "a.csv"), "a.csv:1: unit \"m\" is neither cd nor lx");
  EXPECT_EQ(refusal("# unit: lx\nV\\H,0,1\n0,1,2\n1,3,4\n", "a.csv"),
            "a.csv:4: values in lx need \"# distance_m: …\" or --distance");
  EXPECT_EQ(refusal("V\\H,0,1\n0,1,2\n1,3,4\n", "a.csv"),
            "a.csv:3: neither \"# unit: cd\" nor \"# unit: lx\" says what the values are");
  EXPECT_EQ(refusal("# unit: cd\nV\\H,0,1\n0,1\n", "a.csv"), "a.csv:3: expected 2 values, got 1");
  EXPECT_EQ(refusal("# unit: cd\nV\\H,0,1\n0,1,2,3\n", "a.csv"), "a.csv:3: expected 2 values, got more");
  EXPECT_EQ(refusal("# unit: cd\nV\\H,0,1\n0,1,nan\n", "a.csv"), "a.csv:3: value 2 is not a finite number: \"nan\"");
  EXPECT_EQ(refusal("# unit: cd\nV\\H,0,2,1\n0,1,2,3\n1,1,2,3\n", "a.csv"),
            "a.csv:2: the column angles go neither up nor down all the way: 1 follows 2");
  EXPECT_EQ(refusal("# unit: cd\nV\\H,0,1\n0,1,2\n2,1,2\n1,1,2\n3,1,2\n", "a.csv"),
            "a.csv:5: the row angles go neither up nor down all the way: 1 follows 2");
  EXPECT_EQ(refusal("# unit: cd\nV\\H,-200,1\n0,1,2\n1,1,2\n", "a.csv"),
            "a.csv:2: the angle -200 is outside this type's range");
  EXPECT_EQ(refusal("# unit: cd\nV\\H,0,1\n-95,1,2\n1,1,2\n2,1,2\n", "a.csv"),
            "a.csv:3: the angle -95 is outside this type's range");
  EXPECT_EQ(refusal("# unit: cd\nV\\y,0,1\n0,1,2\n1,1,2\n", "a.csv"),
            "a.csv:4: rows and columns do not go together: H with V, C with gamma, y with z");
  EXPECT_EQ(refusal("h_deg,v_deg,intensity_cd\n0,0,1\n0,1,1\n1,0,1\n", "a.csv"),
            "a.csv:4: the list is no grid: the directions at 1 are not those at 0");
  EXPECT_EQ(refusal("# distance_m: -1\n", "a.csv"), "a.csv:1: distance_m is no number of metres above 0: \"-1\"");
}

TEST(ReadLamp, FindsTheFormat) {
  EXPECT_EQ(find_format("IESNA:LM-63-2002\n", "x"), LampFormat::kLm63);
  EXPECT_EQ(find_format("\xEF\xBB\xBF"
                        "IES:LM-63-2019\n",
                        "x.csv"),
            LampFormat::kLm63);
  EXPECT_EQ(find_format("words\nTILT=NONE\n", "x"), LampFormat::kLm63);
  EXPECT_EQ(find_format("  <?xml", "x.ies"), LampFormat::kTm33);
  EXPECT_EQ(find_format("maker\n", "x.LDT"), LampFormat::kEulumdat);
  EXPECT_EQ(find_format("# unit: cd\n", "x"), LampFormat::kCsv);
  EXPECT_EQ(find_format("hello", "x.txt"), LampFormat::kFind);
  EXPECT_EQ(refusal("hello", "x.txt"),
            "x.txt: looks like none of LM-63 (.ies), EULUMDAT (.ldt), TM-33 (.xml) and CSV; --format says which");
}

TEST(ReadLamp, MirrorTurnsLeftAndRightRoundInEveryConvention) {
  for (const PhotometricType type : {PhotometricType::kA, PhotometricType::kB, PhotometricType::kC}) {
    for (const GammaAxis axis : {GammaAxis::kGamma0, GammaAxis::kGamma90}) {
      IntensityTable table;
      table.type = type;
      table.axis = axis;
      const bool c = type == PhotometricType::kC;
      table.first_deg = c ? std::vector<double>{0, 50, 200, 360} : std::vector<double>{-80, -10, 30, 70};
      table.second_deg = c ? std::vector<double>{0, 80, 180} : std::vector<double>{-60, 0, 70};
      table.candela = {5, 5, 5, 5, 10, 70, 30, 10, 8, 8, 8, 8};
      IntensityTable mirrored = table;
      mirror_left_right(mirrored);
      for (double h = -65; h < 66; h += 7.3) {
        for (double v = -50; v < 51; v += 9.1) {
          const glm::dvec3 d = direction_hv(h, v);
          const double expected = table.intensity_cd({d.x, -d.y, d.z});
          EXPECT_NEAR(mirrored.intensity_cd(d), expected, 1e-11) << static_cast<int>(type) << " " << h << " " << v;
        }
      }
    }
  }
}

TEST(ReadLamp, DirectionsAndAnglesAreInverse) {
  for (const PhotometricType type : {PhotometricType::kA, PhotometricType::kB, PhotometricType::kC}) {
    for (const GammaAxis axis : {GammaAxis::kGamma0, GammaAxis::kGamma90}) {
      for (const TableAngles a : {TableAngles{10, 20}, {80, 60}, {33, 7}}) {
        const TableAngles back = table_angles(type, axis, table_direction(type, axis, a));
        EXPECT_NEAR(back.first_deg, a.first_deg, 1e-12);
        EXPECT_NEAR(back.second_deg, a.second_deg, 1e-12);
      }
    }
  }
}

// Every file of the set is read; where a file states its flux in absolute terms, the integral is compared with it.
TEST(ReadLamp, EveryFileOfTheDataSet) {
  PHARE_NEEDS_SHARED_DATA("photometry");
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::shared_data("photometry"))) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".ies" && ending != ".ldt") continue;
    const auto table = read_lamp(entry.path());
    ASSERT_TRUE(table.ok()) << table.error().text();
    EXPECT_GT(table->peak_cd(), 0.0) << entry.path();
    EXPECT_GT(table->header.smallest_step_cd, 0.0) << entry.path();
    std::printf("%-66s %8.1f lm, stated %7.0f lm of the %s%s\n", entry.path().filename().c_str(), table->flux_lm(),
                table->header.stated_flux_lm, table->header.luminaire_flux ? "luminaire" : "lamps",
                table->header.absolute ? ", absolute" : "");
    for (const std::string& note : table->notes) std::printf("    %s\n", note.substr(note.rfind('/') + 1).c_str());
    ++count;
  }
  EXPECT_EQ(count, 37u);
}

/// LM-63 type A with `columns` × `rows` values, of five or of eleven digits.
std::string large_lm63(std::size_t columns, std::size_t rows, bool all_digits) {
  std::string text = "IES:LM-63-2019\n[TEST] large\nTILT=NONE\n1 -1 1 " + std::to_string(rows) + " " +
                     std::to_string(columns) + " 3 2 0 0 0\n1 1.0001 0\n";
  for (std::size_t j = 0; j < rows; ++j) text += std::to_string(-15.0 + 0.05 * static_cast<double>(j)) + "\n";
  for (std::size_t i = 0; i < columns; ++i) text += std::to_string(-45.0 + 0.05 * static_cast<double>(i)) + "\n";
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      text += std::to_string((i * 7919 + j * 104729) % 99991);
      if (all_digits) text += "." + std::to_string(100003 + (i * 104729 + j * 7919) % 899989);
      text += j % 10 == 9 ? (all_digits ? "\n" : ".5\n") : (all_digits ? " " : ".25 ");
    }
    text += '\n';
  }
  return text;
}

double process_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);  // of all threads: hashing goes beside reading
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Least CPU time of several runs: what the work takes where nothing else disturbs it.
template <typename Work>
double least_cpu_ms(int runs, const Work& work) {
  double least = 1e9;
  for (int i = 0; i < runs; ++i) {
    const double begin = process_cpu_ms();
    work();
    least = std::min(least, process_cpu_ms() - begin);
  }
  return least;
}

// Time on a shared machine says nothing, so reading and hashing is held against the floor of the same run: the standard
// library's own conversion of the same numbers, without looking for lines, types, digits or errors. Where hashing took
// as long as the numbers the largest file had a ratio of 3.
TEST(ReadLamp, ReadingCostsLittleMoreThanItsNumbers) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
  GTEST_SKIP() << "a build that checks itself says nothing about time";
#endif
  for (const auto& [columns, rows, all_digits] :
       {std::tuple{std::size_t{361}, std::size_t{211}, false}, {1801, 601, false}, {1801, 601, true}}) {
    const std::string text = large_lm63(columns, rows, all_digits);
    const double read_ms = least_cpu_ms(7, [&] {
      const auto table = parse(text, "large.ies");
      ASSERT_TRUE(table.ok()) << table.error().text();
      ASSERT_EQ(table->candela.size(), columns * rows);
    });
    double sum = 0.0;
    const double floor_ms = least_cpu_ms(7, [&] {
      const char* const end = text.data() + text.size();
      for (const char* at = text.data() + text.find("1.0001"); at < end;) {
        double value = 0.0;
        const auto [stop, code] = std::from_chars(at, end, value);
        if (code == std::errc{}) sum += value;
        at = stop == at ? at + 1 : stop;
      }
    });
    EXPECT_GT(sum, 0.0);
    std::printf("%zu x %zu values, %.1f MB: %.1f ms of CPU, %.2f times std::from_chars alone (%.1f ms)\n", columns,
                rows, static_cast<double>(text.size()) * 1e-6, read_ms, read_ms / floor_ms, floor_ms);
    EXPECT_LT(read_ms, 2.2 * floor_ms) << text.size();
  }
}

}  // namespace
}  // namespace phare
