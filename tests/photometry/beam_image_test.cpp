// Beam images: exact on a union of nodes, and how far off where sources have to be resampled.
#include "visual/photometry/beam/beam_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "visual/photometry/bench/sample_lamps.h"

namespace phare {
namespace {

/// The image read the way the shaders do, in double.
class ImageReader {
 public:
  explicit ImageReader(const BeamImage& image) : car_from_image_(image.car_from_image) {
    table_.type = image.type;
    table_.axis = image.axis;
    table_.screen_distance_m = image.screen_distance_m;
    table_.first_deg = image.first_deg;
    table_.second_deg = image.second_deg;
    table_.candela.assign(image.candela.begin(), image.candela.end());
  }
  double candela(const glm::dvec3& in_car) const { return table_.intensity_cd(in_car * car_from_image_); }

 private:
  IntensityTable table_;
  glm::dmat3 car_from_image_;
};

double sum_cd(std::span<const AimedSource> sources, const glm::dvec3& in_car) {
  double sum = 0.0;
  for (const AimedSource& source : sources)
    sum += source.scale * source.table->intensity_cd(in_car * source.car_from_lamp);
  return sum;
}

/// Directions dense around the axis, thin outward.
std::vector<glm::dvec3> directions(std::size_t count) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<glm::dvec3> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double spread = i % 3 == 0 ? 80.0 : i % 3 == 1 ? 12.0 : 2.5;
    const double h = glm::radians(spread * unit(random)), v = glm::radians(0.5 * spread * unit(random));
    result.push_back({std::cos(v) * std::cos(h), -std::cos(v) * std::sin(h), std::sin(v)});
  }
  return result;
}

const IntensityTable& sample(const char* file) {
  static const std::vector<SampleLamp> lamps = sample_lamps();
  return std::find_if(lamps.begin(), lamps.end(), [&](const SampleLamp& lamp) { return lamp.file == file; })->table;
}

TEST(BeamImage, SumOnTheUnionOfNodesIsExact) {
  IntensityTable square;  // coarse nodes that are none of the lamps', lit to its limits
  square.first_deg = {-33.3, -1.23, 7.77};
  square.second_deg = {-11.1, 0.321, 4.4};
  square.candela = {100, 200, 300, 400, 500, 600, 700, 800, 900};
  const glm::dmat3 aim = aim_rotation(0.01, -0.01, 0.02);
  const std::vector<AimedSource> sources{
      {&sample("low_rht.ies"), aim, 1.0, 3200.0}, {&sample("high.ies"), aim, 0.5, 6000.0}, {&square, aim, 2.0, 5000.0}};
  const BeamImage image = compose_beam_image(sources);
  EXPECT_FALSE(image.resampled);
  EXPECT_FALSE(image.dark);
  ASSERT_TRUE(std::is_sorted(image.first_deg.begin(), image.first_deg.end(), std::less_equal<>()));
  const ImageReader reader(image);
  double worst = 0.0;
  for (const glm::dvec3& d : directions(60000)) {
    const double expected = sum_cd(sources, d);
    // Beside a lit limit of a table the image falls over 0.01°.
    const TableAngles own = table_angles(PhotometricType::kA, GammaAxis::kGamma0, d * aim);
    if (std::abs(own.first_deg + 33.3) < 0.011 || std::abs(own.first_deg - 7.77) < 0.011) continue;
    if (std::abs(own.second_deg + 11.1) < 0.011 || std::abs(own.second_deg - 4.4) < 0.011) continue;
    worst = std::max(worst, std::abs(reader.candela(d) - expected) / std::max(expected, 1.0));
  }
  std::printf("union of nodes: worst difference %.2g of the intensity (or of 1 cd)\n", worst);
  EXPECT_LT(worst, 1.3e-7);  // float32 candela
}

TEST(BeamImage, OfOneTableIsTheTable) {
  const std::vector<AimedSource> sources{{&sample("low_rht.ies"), glm::dmat3{1.0}, 1.0, 5000.0}};
  const BeamImage image = compose_beam_image(sources);
  EXPECT_EQ(image.first_deg, sources[0].table->first_deg);
  EXPECT_EQ(image.second_deg, sources[0].table->second_deg);
  EXPECT_EQ(image.candela.front(), static_cast<float>(sources[0].table->candela.front()));
}

// Different aims: resampled by direction. The measured error is the statement of how good that is.
TEST(BeamImage, ResampledErrorIsSmall) {
  const std::vector<AimedSource> sources{
      {&sample("low_rht.ies"), aim_rotation(glm::radians(0.2), sample_pitch_rad(), 0.0), 1.0, 5000.0},
      {&sample("high.ies"), aim_rotation(0.0, sample_pitch_rad(), glm::radians(1.0)), 1.0, 5000.0}};
  for (const std::size_t count :
       {std::size_t{2}, std::size_t{1}}) {  // both; the low beam in the aim of a nearly dark high one
    std::vector<AimedSource> lit = sources;
    if (count == 1) lit = {{sources[1].table, sources[1].car_from_lamp, 1e-3, 5000.0}, sources[0]};
    const BeamImage image = compose_beam_image(lit);
    EXPECT_TRUE(image.resampled);
    const ImageReader reader(image);
    double worst_of_local = 0.0, worst_of_peak = 0.0, peak = 0.0;
    for (const glm::dvec3& d : directions(120000)) peak = std::max(peak, sum_cd(lit, d));
    for (const glm::dvec3& d : directions(120000)) {
      const double expected = sum_cd(lit, d);
      const double difference = std::abs(reader.candela(d) - expected);
      worst_of_peak = std::max(worst_of_peak, difference / peak);
      if (expected > 100.0) worst_of_local = std::max(worst_of_local, difference / expected);
    }
    std::printf(
        "resampled %zu × %zu nodes: worst difference %.2g of the peak, %.2g of the local intensity above 100 cd\n",
        image.first_deg.size(), image.second_deg.size(), worst_of_peak, worst_of_local);
    EXPECT_LT(worst_of_peak, 2e-3);
    EXPECT_LT(worst_of_local, 2e-2);
    EXPECT_LT(image.candela.size(), 1000000u);
  }
}

// Lux on a flat screen is bilinear on the screen, not in degrees: its image keeps the screen's nodes, and is exact.
// Beside a table in degrees it has to be resampled, and the error is stated.
TEST(BeamImage, AFlatScreenKeepsItsNodes) {
  IntensityTable screen;
  screen.screen_distance_m = 25.0;
  for (double y = -8.0; y <= 8.0; y += 0.5) screen.first_deg.push_back(glm::degrees(std::atan(y / 25.0)));
  for (double z = -3.0; z <= 2.0; z += 0.25) screen.second_deg.push_back(glm::degrees(std::atan(z / 25.0)));
  for (const double v : screen.second_deg) {
    for (const double h : screen.first_deg) screen.candela.push_back(20000.0 * std::exp(-h * h / 60.0 - v * v / 8.0));
  }
  const std::vector<AimedSource> source{{&screen, glm::dmat3{1.0}, 1.0, 5000.0}};
  const BeamImage native = compose_beam_image(source);
  EXPECT_FALSE(native.resampled);
  EXPECT_EQ(native.first_deg, screen.first_deg);
  const ImageReader native_reader(native);
  IntensityTable dim;  // in degrees, and next to nothing
  dim.first_deg = {-20.0, 20.0};
  dim.second_deg = {-8.0, 8.0};
  dim.candela = {1e-3, 1e-3, 1e-3, 1e-3};
  const std::vector<AimedSource> mixed{source[0], {&dim, glm::dmat3{1.0}, 1.0, 5000.0}};
  const BeamImage image = compose_beam_image(mixed);
  EXPECT_TRUE(image.resampled);
  EXPECT_EQ(image.screen_distance_m, 0.0);
  const ImageReader reader(image);
  double worst_of_local = 0.0, worst_of_peak = 0.0, worst_native = 0.0;
  for (double h = -15.0; h <= 15.0; h += 0.37) {
    for (double v = -5.5; v <= 4.0; v += 0.19) {
      const double expected = screen.intensity_cd(direction_hv(h, v));
      const double difference = std::abs(reader.candela(direction_hv(h, v)) - expected);
      worst_of_peak = std::max(worst_of_peak, difference / screen.peak_cd());
      worst_of_local = std::max(worst_of_local, difference / expected);
      worst_native = std::max(worst_native, std::abs(native_reader.candela(direction_hv(h, v)) - expected) / expected);
    }
  }
  EXPECT_LT(worst_native, 1.3e-7);  // float32 candela
  std::printf("flat screen resampled: worst difference %.2g of the peak, %.2g of the local intensity\n", worst_of_peak,
              worst_of_local);
  EXPECT_LT(worst_of_peak, 2e-3);  // as two aims that differ, above
  EXPECT_LT(worst_of_local, 2e-2);
}

TEST(BeamImage, NothingLitIsDark) {
  EXPECT_TRUE(compose_beam_image({}).dark);
  const std::vector<AimedSource> off{{&sample("high.ies"), glm::dmat3{1.0}, 0.0, 5000.0},
                                     {nullptr, glm::dmat3{1.0}, 1.0, 5000.0}};
  const BeamImage image = compose_beam_image(off);
  EXPECT_TRUE(image.dark);
  EXPECT_EQ(image.first_deg.size(), 2u);
  EXPECT_EQ(ImageReader(image).candela({1, 0, 0}), 0.0);
}

TEST(BlackBody, ColoursHaveLuminanceOne) {
  for (const double t : {500.0, 1667.0, 2222.0, 3200.0, 4000.0, 4001.0, 5500.0, 6504.0, 25000.0, 1e9}) {
    const glm::dvec3 c = black_body_colour(t);
    EXPECT_NEAR(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z, 1.0, 1e-6) << t;
    EXPECT_GE(std::min({c.x, c.y, c.z}), 0.0) << t;
  }
  EXPECT_GT(black_body_colour(3200).x, 1.3);  // a bulb is warm
  EXPECT_GT(black_body_colour(10000).z, black_body_colour(10000).x);
  const glm::dvec3 white =
      black_body_colour(6504);  // near D65, which is (1, 1, 1); the Planckian locus is slightly off
  EXPECT_NEAR(white.x, 1.0, 0.06);
  EXPECT_NEAR(white.z, 1.0, 0.06);
}

}  // namespace
}  // namespace phare
