// The linter: our own lamps are clean, and every kind of oddity is found in a lamp made odd on purpose.
#include "visual/photometry/bench/lint.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "photometry_test_files.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

const IntensityTable& low() {
  static const std::vector<SampleLamp> lamps = sample_lamps();
  return lamps.front().table;
}

const Finding* find(const LampReport& report, const std::string& id) {
  const auto found =
      std::find_if(report.findings.begin(), report.findings.end(), [&](const Finding& f) { return f.id == id; });
  return found == report.findings.end() ? nullptr : &*found;
}

TEST(Lint, OurLampsAreClean) {
  std::vector<SampleLamp> lamps = sample_lamps();
  for (SampleLamp& segment : matrix_segments()) lamps.push_back(std::move(segment));
  for (const SampleLamp& lamp : lamps) {
    const auto read = parse_lamp(lm63_text(lamp.table, kSampleGeneration), lamp.file);
    ASSERT_TRUE(read.ok()) << read.error().text();
    const LampReport report = lint_lamp(*read);
    for (const Finding& f : report.findings) EXPECT_EQ(f.grade, Grade::kInfo) << lamp.file << ": " << f.text;
    const CutoffSide side = report.cutoff.side;
    if (lamp.kind == SampleKind::kLowRight) {
      EXPECT_EQ(side, CutoffSide::kRisesRight) << lamp.file;
    } else if (lamp.kind == SampleKind::kLowLeft) {
      EXPECT_EQ(side, CutoffSide::kRisesLeft) << lamp.file;
    } else {
      EXPECT_TRUE(side == CutoffSide::kNone || side == CutoffSide::kFlat) << lamp.file;
    }
  }
}

TEST(Lint, ClockwiseTypeBAndMirrorsAreSuspected) {
  IntensityTable b = low();
  std::vector<double> h = b.first_deg, v = b.second_deg;
  IntensityTable type_b = resample(b, PhotometricType::kB, GammaAxis::kGamma0, h, v);
  type_b.header.keywords.clear();
  EXPECT_EQ(find(lint_lamp(type_b), "left-hand-traffic"), nullptr);
  mirror_left_right(type_b);
  ASSERT_NE(find(lint_lamp(type_b), "left-hand-traffic"), nullptr);
  EXPECT_EQ(find(lint_lamp(type_b), "left-hand-traffic")->grade, Grade::kWarning);
  type_b.header.keywords = {{"OTHER", "low beam, RHT"}};
  ASSERT_NE(find(lint_lamp(type_b), "mirrored"), nullptr);
  IntensityTable type_a = low();
  type_a.header.keywords = {{"OTHER", "for left-hand traffic"}};
  ASSERT_NE(find(lint_lamp(type_a), "mirrored"), nullptr);
}

TEST(Lint, FluxAgainstTheHeader) {
  IntensityTable table = low();
  table.header.stated_flux_lm = table.flux_lm();
  table.header.luminaire_flux = true;
  ASSERT_NE(find(lint_lamp(table), "flux"), nullptr);
  table.header.stated_flux_lm *= 1.1;
  ASSERT_NE(find(lint_lamp(table), "flux-mismatch"), nullptr);
  table.header.luminaire_flux = false;  // of the lamps: less light than its lamps is usual
  ASSERT_NE(find(lint_lamp(table), "flux"), nullptr);
  table.header.stated_flux_lm *= 0.5;  // more is not
  ASSERT_NE(find(lint_lamp(table), "flux-mismatch"), nullptr);
  table.header.output_ratio = table.flux_lm() / table.header.stated_flux_lm;
  ASSERT_NE(find(lint_lamp(table), "flux"), nullptr);
}

TEST(Lint, MissingDataSpikesAndEdges) {
  IntensityTable hole = low();
  hole.candela[80 * hole.first_deg.size() + 100] = 0.0;
  ASSERT_NE(find(lint_lamp(hole), "missing-data"), nullptr);
  IntensityTable row = low();
  std::fill_n(row.candela.begin() + static_cast<std::ptrdiff_t>(80 * row.first_deg.size()), row.first_deg.size(), 0.0);
  ASSERT_NE(find(lint_lamp(row), "missing-data"), nullptr);
  IntensityTable spike = low();
  spike.candela[150 * spike.first_deg.size() + 100] = 30000.0;
  ASSERT_NE(find(lint_lamp(spike), "spike"), nullptr);
  IntensityTable cut =
      resample(low(), PhotometricType::kA, GammaAxis::kGamma0, {-10, -5, 0, 5, 10}, {-5, -3, -1, 1, 3});
  ASSERT_NE(find(lint_lamp(cut), "cut-table"), nullptr);
  ASSERT_NE(find(lint_lamp(cut), "coarse"), nullptr);
  IntensityTable dark = low();
  std::fill(dark.candela.begin(), dark.candela.end(), 0.0);
  EXPECT_EQ(lint_lamp(dark).findings.front().grade, Grade::kError);
}

// A table of type C has some directions more than once.
TEST(Lint, OneDirectionOfTypeCHasOneIntensity) {
  IntensityTable good;
  good.type = PhotometricType::kC;
  good.axis = GammaAxis::kGamma0;
  good.first_deg = {0, 90, 180, 270, 360};
  good.second_deg = {0, 10, 20};
  good.candela = {1000, 1000, 1000, 1000, 1000, 500, 400, 500, 400, 500, 0, 0, 0, 0, 0};
  for (const char* id : {"pole", "seam", "cut-table"}) EXPECT_EQ(find(lint_lamp(good), id), nullptr) << id;
  IntensityTable pole = good;
  pole.candela[1] = 970;
  EXPECT_NE(find(lint_lamp(pole), "pole"), nullptr);
  IntensityTable seam = good;
  seam.candela[9] = 900;
  EXPECT_NE(find(lint_lamp(seam), "seam"), nullptr);
  IntensityTable hole = good;  // begins at 20°, lit there: the axis is dark
  hole.second_deg = {20, 30, 40};
  EXPECT_NE(find(lint_lamp(hole), "cut-table"), nullptr);
}

// A block of zeros, and columns of zeros side by side, are as missing as single ones.
TEST(Lint, MissingDataOfAnyWidth) {
  const auto with_zeros = [](double h_low, double h_high, double v_low, double v_high) {
    IntensityTable table = low();
    std::size_t zeros = 0;
    for (std::size_t j = 0; j < table.second_deg.size(); ++j) {
      for (std::size_t i = 0; i < table.first_deg.size(); ++i) {
        const double h = table.first_deg[i], v = table.second_deg[j];
        if (h < h_low || h > h_high || v < v_low || v > v_high) continue;
        table.candela[j * table.first_deg.size() + i] = 0.0;
        ++zeros;
      }
    }
    return std::pair{table, zeros};
  };
  const auto [block, zeros] = with_zeros(-1.0, 1.0, -1.5, -1.0);
  ASSERT_NE(find(lint_lamp(block), "missing-data"), nullptr);
  EXPECT_TRUE(find(lint_lamp(block), "missing-data")->text.starts_with(std::to_string(zeros) + " value(s)"));
  for (const double high : {2.0, 2.2, 2.6})  // 1, 2, 6 columns of 0.1°, from below to above
    EXPECT_NE(find(lint_lamp(with_zeros(2.0, high, -90.0, 90.0).first), "missing-data"), nullptr) << high;
  EXPECT_NE(find(lint_lamp(with_zeros(-90.0, 90.0, -1.0, -0.8).first), "missing-data"), nullptr);
  // Dark outside is no missing data.
  EXPECT_EQ(find(lint_lamp(with_zeros(-90.0, 90.0, 2.0, 90.0).first), "missing-data"), nullptr);
  EXPECT_EQ(find(lint_lamp(with_zeros(12.0, 90.0, -90.0, 90.0).first), "missing-data"), nullptr);
}

TEST(Lint, ABeamTurnedAboutItsAxisIsSuspected) {
  IntensityTable upside = low();
  const std::size_t columns = upside.first_deg.size(), rows = upside.second_deg.size();
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i)
      upside.candela[j * columns + i] = low().candela[(rows - 1 - j) * columns + i];
  }
  for (double& v : upside.second_deg) v = -v;
  std::reverse(upside.second_deg.begin(), upside.second_deg.end());
  ASSERT_NE(find(lint_lamp(upside), "turned"), nullptr);
  EXPECT_NE(find(lint_lamp(upside), "turned")->text.find("upside down"), std::string::npos);
  PHARE_NEEDS_SHARED_DATA("photometry-reference/photometry/low.ldt");
  for (const char* name : {"low.ldt", "fog.ldt"}) {
    const auto file = test::shared_data(std::string("photometry-reference/photometry/") + name);
    LampReadSettings settings;
    // The set's fog lamps have C 0 up, its low beams to the right: a quarter beside it the beam lies on its side.
    settings.c0_turn_deg = std::string(name) == "fog.ldt" ? 90.0 : 0.0;
    EXPECT_EQ(find(lint_lamp(*read_lamp(file, settings)), "turned"), nullptr) << name;
    for (const double beside : {90.0, 180.0, 270.0}) {
      LampReadSettings turned = settings;
      turned.c0_turn_deg += beside;
      const LampReport report = lint_lamp(*read_lamp(file, turned));
      ASSERT_NE(find(report, "turned"), nullptr) << name << " " << beside;
      if (std::string(name) == "low.ldt") {  // the setting itself, not how far to turn from the one in use
        EXPECT_NE(find(report, "turned")->text.find("(read with --c0 0)"), std::string::npos) << beside;
      }
    }
  }
}

TEST(Lint, TrafficSideIsReadWithoutHyphen) {
  IntensityTable left = low();
  mirror_left_right(left);
  for (const char* words : {"passing beam for right hand traffic", "Right-hand-traffic", "RIGHT-HAND TRAFFIC", "RHT"}) {
    left.header.keywords = {{"OTHER", words}};
    EXPECT_NE(find(lint_lamp(left), "mirrored"), nullptr) << words;
  }
}

TEST(Lint, WrongAxisOfATypeCFile) {
  PHARE_NEEDS_SHARED_DATA("photometry-reference/photometry/low_C_horiz.ies");
  LampReadSettings settings;
  const auto file = test::shared_data("photometry-reference/photometry/low_C_horiz.ies");
  ASSERT_NE(find(lint_lamp(*read_lamp(file, settings)), "axis"), nullptr);
  settings.axis = GammaAxis::kGamma90;
  const LampReport right = lint_lamp(*read_lamp(file, settings));
  EXPECT_EQ(find(right, "axis"), nullptr);
  EXPECT_EQ(right.cutoff.side, CutoffSide::kRisesRight);
  EXPECT_NEAR(right.peak.first_deg, 0.8, 1e-9);
  EXPECT_NEAR(right.peak.second_deg, -0.7, 1e-9);
}

// The flux stated in the reference set's EULUMDAT files is that of the table, rounded to a lumen.
TEST(Lint, FluxOfTheReferenceSetAgreesWithItsHeaders) {
  PHARE_NEEDS_SHARED_DATA("photometry-reference/photometry/low.ldt");
  for (const char* name : {"low.ldt", "high.ldt", "fog.ldt"}) {
    const auto table = read_lamp(test::shared_data(std::string("photometry-reference/photometry/") + name));
    ASSERT_TRUE(table.ok()) << table.error().text();
    const LampReport report = lint_lamp(*table);
    EXPECT_NEAR(report.flux_lm, report.expected_flux_lm, 0.003 * report.flux_lm) << name;
    EXPECT_NE(find(report, "flux"), nullptr) << name;
  }
}

// What is written reads back as the same table in every format.
TEST(WriteLamp, RoundTripsAreExact) {
  const IntensityTable& table = low();
  for (const bool csv : {false, true}) {
    const auto back = parse_lamp(csv ? csv_text(table) : lm63_text(table), csv ? "a.csv" : "a.ies");
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back->candela, table.candela);
    EXPECT_EQ(back->first_deg, table.first_deg);
    EXPECT_EQ(back->second_deg, table.second_deg);
    EXPECT_TRUE(back->notes.empty());
  }
  // Type C keeps its grid in EULUMDAT; candela per 1000 lm cost a rounding each way.
  IntensityTable c =
      resample(table, PhotometricType::kC, GammaAxis::kGamma0, {0, 45, 90, 180, 270, 300, 360}, {0, 0.5, 2, 30, 90});
  const auto ldt = parse_lamp(eulumdat_text(c), "a.ldt");
  ASSERT_TRUE(ldt.ok()) << ldt.error().text();
  EXPECT_EQ(ldt->first_deg, c.first_deg);
  for (std::size_t i = 0; i < c.candela.size(); ++i) {
    if (i % c.first_deg.size() + 1 == c.first_deg.size()) continue;  // C 360 is not stored: it is C 0
    EXPECT_NEAR(ldt->candela[i], c.candela[i], 4.5e-16 * c.candela[i]);
  }
  const auto ies = parse_lamp(lm63_text(c), "a.ies");
  ASSERT_TRUE(ies.ok()) << ies.error().text();
  EXPECT_EQ(ies->candela, c.candela);
}

// A sum on the union of nodes is the sum of intensities everywhere (but 0.01° beside a lit limit).
TEST(Combine, SumIsTheSumOfIntensities) {
  IntensityTable square;
  square.first_deg = {-7.7, 1.1, 9.3};
  square.second_deg = {-5.5, 0.3, 2.2};
  square.candela = {0, 0, 0, 0, 900, 0, 0, 0, 0};
  const IntensityTable* parts[] = {&low(), &square};
  const IntensityTable sum = sum_tables(parts);
  for (double h = -20; h < 20; h += 0.37) {
    for (double v = -8; v < 4; v += 0.23) {
      const double expected = low().intensity_at_cd({h, v}) + square.intensity_at_cd({h, v});
      ASSERT_NEAR(sum.intensity_at_cd({h, v}), expected, 1e-11 * expected + 1e-9) << h << " " << v;
    }
  }
  EXPECT_NEAR(sum.flux_lm(), low().flux_lm() + square.flux_lm(), 1e-9 * sum.flux_lm());
}

}  // namespace
}  // namespace phare
