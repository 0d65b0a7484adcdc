// reference: the colours of spectra against CIE's own figures for illuminants and lines, and what is refused.
#include "config/spectrum.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "config/street_lamps.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

glm::dvec2 xy_of(const std::vector<SpectrumRow>& rows) {
  const glm::dvec3 xyz = xyz_of_spectrum(rows);
  return glm::dvec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
}

/// Illuminant A by its definition: Planck at 2855.5 K with c2 = 0.014388 m K.
double planck(double wavelength_nm) {
  const double m = 1e-9 * wavelength_nm;
  return std::pow(m, -5.0) / (std::exp(1.4388e-2 / (m * 2855.5)) - 1.0);
}

fs::path written(const std::string& name, const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / (std::to_string(::getpid()) + "_" + name);
  std::ofstream(file) << text;
  return file;
}

// CIE 015: x 0.44758, y 0.40745, five digits; the rest is the observer at 5 nm and, at 10 nm, straight lines between
// rows of a bent curve.
TEST(Spectrum, IlluminantAIsWhereCieHasIt) {
  for (const auto& [step_nm, off] : {std::pair{1.0, 1.5e-5}, {5.0, 3e-5}, {10.0, 1.2e-4}}) {
    std::vector<SpectrumRow> rows;
    for (double nm = 300.0; nm <= 840.0; nm += step_nm) rows.push_back({nm, planck(nm)});
    const glm::dvec2 xy = xy_of(rows);
    std::printf("illuminant A, every %g nm: %.6f %.6f\n", step_nm, xy.x, xy.y);
    EXPECT_NEAR(xy.x, 0.44758, off) << step_nm;
    EXPECT_NEAR(xy.y, 0.40745, off) << step_nm;
  }
  std::vector<SpectrumRow> uneven;
  int row = 0;
  for (double nm = 355.3; nm < 840.0; nm += (++row % 3 == 0 ? 6.7 : 1.9)) uneven.push_back({nm, 1e-7 * planck(nm)});
  EXPECT_NEAR(xy_of(uneven).x, 0.44758, 5e-5);
  EXPECT_NEAR(xy_of(uneven).y, 0.40745, 5e-5);
}

TEST(Spectrum, EqualEnergyIsAThirdOfEach) {
  std::vector<SpectrumRow> rows;
  for (double nm = 360.0; nm <= 830.0; nm += 5.0) rows.push_back({nm, 3.0});
  const glm::dvec2 xy = xy_of(rows);
  // CIE 015 itself has 0.33331 and 0.33329: the functions' sums differ in the fifth digit.
  EXPECT_NEAR(xy.x, 1.0 / 3.0, 5e-5);
  EXPECT_NEAR(xy.y, 1.0 / 3.0, 5e-5);
  // 683 lm/W at 555 nm times this is luminous flux: the integral of y is 106.857 nm.
  EXPECT_NEAR(xyz_of_spectrum(rows).y / 3.0, 106.857, 1e-3);
}

// CIE's D65 every 10 nm; it is rough, so straight lines between these rows cost 2e-4.
TEST(Spectrum, DaylightIsWhite) {
  const std::vector<double> power{49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812,
                                  114.861, 115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046,
                                  100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992,
                                  80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856,
                                  75.0870, 63.5927, 46.4182, 66.8054, 63.3828};
  std::vector<SpectrumRow> rows;
  for (std::size_t i = 0; i < power.size(); ++i) rows.push_back({380.0 + 10.0 * static_cast<double>(i), power[i]});
  const glm::dvec2 xy = xy_of(rows);
  std::printf("D65: %.5f %.5f\n", xy.x, xy.y);
  EXPECT_NEAR(xy.x, 0.3127, 2e-4);
  EXPECT_NEAR(xy.y, 0.3290, 2e-4);
}

// Lines lie on the spectral locus (CIE 1931, four digits), also between the rows of the table.
TEST(Spectrum, LinesLieOnTheLocus) {
  struct Line {
    double nm, x, y;
  };
  for (const Line& line : {Line{480.0, 0.0913, 0.1327},
                           {503.0, 0.0040, 0.6104},
                           {520.0, 0.0743, 0.8338},
                           {552.0, 0.3159, 0.6791},
                           {589.0, 0.5693, 0.4301},
                           {620.0, 0.6915, 0.3083},
                           {700.0, 0.7347, 0.2653}}) {
    const glm::dvec2 xy = xy_of({{line.nm - 0.5, 0.0}, {line.nm, 1.0}, {line.nm + 0.5, 0.0}});
    EXPECT_NEAR(xy.x, line.x, 3e-4) << line.nm;
    EXPECT_NEAR(xy.y, line.y, 3e-4) << line.nm;
  }
}

TEST(Spectrum, WrongFilesSayWhereAndWhy) {
  const auto reason = [](const std::string& text) {
    const auto xy = read_spectrum_xy(written("s.csv", text));
    return xy ? std::string("was read") : xy.error().text().substr(xy.error().text().find("_s.csv") + 1);
  };
  const std::string head = "# made up\nwavelength_nm,power\n";
  EXPECT_EQ(reason(head + "500,1\n505,2\n"), "was read");
  EXPECT_EQ(reason(head + "500,1\n505,-2\n"), "s.csv:4: power is negative");
  EXPECT_EQ(reason(head + "505,1\n500,2\n"), "s.csv:4: wavelength_nm does not rise");
  EXPECT_EQ(reason(head + "500,1\n500,2\n"), "s.csv:4: wavelength_nm does not rise");
  EXPECT_EQ(reason(head + "500,1\n510.1,2\n"), "s.csv:4: wavelength_nm is more than 10 nm beyond the row before");
  EXPECT_EQ(reason(head + "300,1\n305,2\n"), "s.csv: has no power within 360 to 830 nm");
  EXPECT_EQ(reason(head + "500,0\n505,0\n"), "s.csv: has no power within 360 to 830 nm");
  EXPECT_EQ(reason(head + "500,1\n"),
            "s.csv:2: expected two rows or more below this line, between which power is linear");
  EXPECT_EQ(reason(head + "380,1\n385,1\n"), "s.csv: is next to no light: its y is below 0.01");
  EXPECT_EQ(reason("wavelength_nm,watts\n500,1\n"),
            "s.csv:1: expected the columns wavelength_nm and power; there is no power");
  EXPECT_NE(reason(head + "500,much\n").find("s.csv:3"), std::string::npos) << reason(head + "500,much\n");
  EXPECT_FALSE(read_spectrum_xy("/nowhere/s.csv"));
}

TEST(Spectrum, AStreetLampHasOneOfSpectrumAndTemperature) {
  const fs::path spectrum = written("lamp.csv", "wavelength_nm,power\n585,0\n590,1\n595,0\n");
  const std::string text =
      "[[luminaire]]\nname = \"low pressure sodium\"\nfile = \"a.ies\"\nspectrum = \"" + spectrum.string() + "\"\n";
  const auto lamps = read_street_lamps(written("lamps.toml", text));
  ASSERT_TRUE(lamps) << lamps.error().text();
  ASSERT_TRUE(lamps->luminaires[0].chromaticity_xy);
  EXPECT_NEAR(lamps->luminaires[0].chromaticity_xy->x, 0.575, 2e-3);  // of 590 nm; three digits
  EXPECT_NEAR(lamps->luminaires[0].chromaticity_xy->y, 0.424, 2e-3);
  const auto both = read_street_lamps(written("both.toml", text + "colour_temperature_k = 4000\n"));
  ASSERT_FALSE(both);
  EXPECT_NE(both.error().text().find("both.toml:4"), std::string::npos) << both.error().text();
  EXPECT_NE(both.error().text().find("one of spectrum, colour_temperature_k"), std::string::npos)
      << both.error().text();
  const auto by_xy = read_street_lamps(
      written("xy.toml", "[[luminaire]]\nname = \"amber\"\nfile = \"a.ies\"\nchromaticity_xy = [0.56, 0.42]\n"));
  ASSERT_TRUE(by_xy) << by_xy.error().text();
  EXPECT_EQ(by_xy->luminaires[0].chromaticity_xy, glm::dvec2(0.56, 0.42));
}

}  // namespace
}  // namespace phare
