// unit: the form, side and place of cut-offs of every kind, made as goniometers file them; and beams that have none.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "made_beams.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/bench/cutoff_line.h"
#include "visual/photometry/bench/sample_lamps.h"

namespace phare {
namespace {

using test::made_beam, test::MadeBeam, test::step_line;

CutoffShape shape_of_table(const IntensityTable& table) {
  return cutoff_shape(mounted_intensity(table, glm::dmat3{1.0}));
}

double slope(double degrees) {
  return std::tan(degrees * 3.14159265358979 / 180.0);
}

struct Case {
  const char* name;
  std::function<double(double)> line;
  CutoffForm form;
  double kink_h_deg, flat_v_deg, upper_v_deg;  ///< upper: 2.5° beyond the kink
};

/// The forms of print, for right-hand traffic.
std::vector<Case> rising_forms() {
  const auto projector = [](double rise_deg) {
    return [rise_deg](double h) { return h < 0.0 ? -0.42 : 0.3 + slope(rise_deg) * std::min(h, 8.0); };
  };
  return {{"step, on at 4 deg", projector(4.0), CutoffForm::kStep, 0.0, -0.42, 0.3 + 2.5 * slope(4.0)},
          {"step, on at 5 deg", projector(5.0), CutoffForm::kStep, 0.0, -0.42, 0.3 + 2.5 * slope(5.0)},
          {"step, on at 6 deg", projector(6.0), CutoffForm::kStep, 0.0, -0.42, 0.3 + 2.5 * slope(6.0)},
          {"step, then level", step_line(-0.42, 0.3, 0.0), CutoffForm::kStep, 0.0, -0.42, 0.3},
          {"SAE, low step", step_line(-0.4, 0.0, 0.5), CutoffForm::kStep, 0.5, -0.4, 0.0},
          {"ramp over 4 deg", [](double h) { return -0.42 + 0.72 * std::clamp(h / 4.0, 0.0, 1.0); }, CutoffForm::kElbow,
           0.0, -0.42, -0.42 + 0.72 * 0.625},
          {"15 deg elbow", [](double h) { return -0.57 + slope(15.0) * std::clamp(h, 0.0, 6.0); }, CutoffForm::kElbow,
           0.0, -0.57, -0.57 + 2.5 * slope(15.0)},
          {"Z to 0", [](double h) { return -0.57 + std::clamp(h, 0.0, 0.57); }, CutoffForm::kZ, 0.0, -0.57, 0.0},
          {"Z to 0.43 up", [](double h) { return -0.57 + std::clamp(h, 0.0, 1.0); }, CutoffForm::kZ, 0.0, -0.57, 0.43},
          {"double step", [](double h) { return h < -1.0  ? -0.57
                                                : h < 1.0 ? 0.0
                                                          : 0.57; }, CutoffForm::kDoubleStep,
           -1.0, -0.57, 0.57}};
}

/// What a table of this grid may shift a kink by: an upright line lies between two columns, a step's foot is found
/// between scans 0.125° apart; rows tell an inflection to 0.01° and 0.35 of them (docs/photometry.md), which on a slope
/// goes sideways.
double kink_open_deg(const Case& c, double grid_deg) {
  const double up_deg = 0.01 + 0.35 * grid_deg;
  return grid_deg +
         (c.form == CutoffForm::kElbow ? up_deg / slope(c.upper_v_deg < 0.05 ? 10.0 : 15.0) : up_deg + 0.125);
}

// The fault that was: a projector's step that goes on at 4 to 6 degrees was called flat.
TEST(CutoffShape, EveryFormOnEveryGrid) {
  for (const Case& c : rising_forms()) {
    for (const double soft : {0.1, 0.3}) {  // G 0.5, 0.2
      for (const double grid : {0.1, 0.25, 0.5}) {
        for (const double noise : {0.0, 0.005}) {
          const CutoffShape shape = shape_of_table(made_beam({c.line, soft, grid, grid, noise, 0.0, 0.0, 12.0}));
          const std::string what = std::string(c.name) + ", s " + std::to_string(soft) + ", grid " +
                                   std::to_string(grid) + ", noise " + std::to_string(noise);
          EXPECT_EQ(shape.side, CutoffSide::kRisesRight) << what;
          EXPECT_NEAR(shape.flat_v_deg, c.flat_v_deg, 0.02 + 0.35 * grid) << what;
          if (noise > 0.0 || grid > 0.3) continue;  // a kink on rows of 0.5° is told to a degree or two
          EXPECT_NEAR(shape.kink_h_deg, c.kink_h_deg, kink_open_deg(c, grid)) << what;
          // A form is told where its steps are wider and higher than the grid.
          if (grid <= 0.1) {
            EXPECT_EQ(shape.form, c.form) << what << ": " << form_name(shape.form);
          }
          if (grid <= 0.1) {
            EXPECT_NEAR(shape.upper_v_deg, c.upper_v_deg, 0.06) << what;
          }
        }
      }
    }
  }
}

// Aimed off by a degree to any side, fine rows, noise: the shape goes along.
TEST(CutoffShape, GoesWithABeamAimedOff) {
  for (const Case& c : rising_forms()) {
    for (const double right : {-1.0, 1.0}) {
      for (const double up : {-1.0, 1.0}) {
        const CutoffShape shape = shape_of_table(made_beam({c.line, 0.15, 0.1, 0.05, 0.005, right, up, 12.0}));
        const std::string what = std::string(c.name) + ", off " + std::to_string(right) + ", " + std::to_string(up);
        EXPECT_EQ(shape.side, CutoffSide::kRisesRight) << what;
        EXPECT_NEAR(shape.kink_h_deg, c.kink_h_deg + right, kink_open_deg(c, 0.1) + 0.1) << what;
        EXPECT_NEAR(shape.flat_v_deg, c.flat_v_deg + up, 0.05) << what;
      }
    }
  }
}

TEST(CutoffShape, StepsAreMeasured) {
  const CutoffShape one = shape_of_table(made_beam({step_line(-0.42, 0.3, 0.4, slope(5.0)), 0.1, 0.1, 0.05}));
  ASSERT_EQ(one.steps.size(), 1u);
  EXPECT_NEAR(one.steps[0].foot_h_deg, 0.35, 0.15);  // between the columns at 0.3 and 0.4
  EXPECT_NEAR(one.steps[0].height_deg, 0.72, 0.06);  // the slope adds 0.03 over where the level is taken
  const CutoffShape two =
      shape_of_table(made_beam({[](double h) { return h < -1.0  ? -0.57
                                                      : h < 1.0 ? 0.0
                                                                : 0.57; }, 0.1, 0.1, 0.05}));
  ASSERT_EQ(two.steps.size(), 2u);
  EXPECT_NEAR(two.steps[0].foot_h_deg, -1.05, 0.15);
  EXPECT_NEAR(two.steps[1].foot_h_deg, 0.95, 0.15);
  EXPECT_NEAR(two.steps[1].height_deg, 0.57, 0.03);
  EXPECT_TRUE(
      shape_of_table(made_beam({[](double h) { return slope(15.0) * std::clamp(h, 0.0, 6.0); }})).steps.empty());
}

// Fog lamps: level, or with ends that fall; never a side of traffic, wherever the beam is aimed.
TEST(CutoffShape, FogLampsTellNoSide) {
  const struct {
    const char* name;
    std::function<double(double)> line;
    CutoffForm form;
  } cases[] = {
      {"level", [](double) { return -1.0; }, CutoffForm::kFlat},
      {"tilted by 1 deg", [](double h) { return -1.0 + slope(1.0) * h; }, CutoffForm::kFlat},
      {"ends fall", [](double h) { return -1.0 - 0.15 * std::max(0.0, std::abs(h) - 3.0); }, CutoffForm::kSymmetric},
      {"bowed", [](double h) { return -1.0 - 0.02 * h * h; }, CutoffForm::kSymmetric},
      {"ends fall and end", [](double h) { return -1.0 - 0.25 * std::clamp(std::abs(h) - 2.5, 0.0, 3.0); },
       CutoffForm::kSymmetric}};
  for (const auto& c : cases) {
    for (const double soft : {0.1, 0.3}) {
      for (const double off : {-1.0, 0.0, 1.0}) {
        const CutoffShape shape = shape_of_table(made_beam({c.line, soft, 0.1, 0.1, 0.005, off, off, 12.0}));
        EXPECT_EQ(shape.side, CutoffSide::kFlat) << c.name << " " << soft << " " << off;
        EXPECT_EQ(shape.form, c.form) << c.name << " " << soft << " " << off << ": " << form_name(shape.form);
        EXPECT_FALSE(shape.tells_side());
        EXPECT_TRUE(side_source(shape).starts_with("assumed: ")) << side_source(shape);
      }
    }
  }
}

// Spots of three profiles, narrow and wide: log E has its steepest place where the light is faint or where stray light
// takes over, and that is no cut-off.
TEST(CutoffShape, DrivingBeamsAndLuminairesHaveNone) {
  for (const double tall : {0.5, 0.8, 1.0, 1.5, 2.0, 3.0}) {
    for (const double wide : {1.0, 3.0, 6.0}) {
      for (const int profile : {0, 1, 2}) {
        IntensityTable table;
        for (int i = -120; i <= 120; ++i) table.first_deg.push_back(0.1 * i);
        for (int j = -80; j <= 80; ++j) table.second_deg.push_back(0.1 * j);
        for (const double v : table.second_deg) {
          for (const double h : table.first_deg) {
            const double q = h * h / (wide * wide) + v * v / (tall * tall);
            const double x = profile == 0   ? std::exp(-0.5 * q)
                             : profile == 1 ? 1.0 / ((1.0 + 0.5 * q) * (1.0 + 0.5 * q))
                                            : 1.0 / std::cosh(std::sqrt(q));
            table.candela.push_back(60000.0 * x + 20.0);
          }
        }
        const CutoffShape shape = shape_of_table(table);
        EXPECT_EQ(shape.side, CutoffSide::kNone) << "profile " << profile << ", " << wide << " by " << tall
                                                 << " deg: V " << shape.flat_v_deg << ", G " << shape.sharpness_g;
        EXPECT_EQ(shape.form, CutoffForm::kNone);
      }
    }
  }
}

TEST(CutoffShape, OfOurLamps) {
  for (const SampleLamp& lamp : sample_lamps()) {
    const CutoffShape shape = shape_of_table(lamp.table);
    const bool low = lamp.file.find("low") != std::string::npos;
    EXPECT_EQ(shape.tells_side(), low) << lamp.file;
    if (low) {
      EXPECT_EQ(shape.form, CutoffForm::kElbow) << lamp.file << " " << form_name(shape.form);
    }
    if (low) {
      EXPECT_EQ(side_source(shape), "by the cut-off");
    }
    if (lamp.file.find("high") != std::string::npos) {
      EXPECT_EQ(shape.side, CutoffSide::kNone) << lamp.file;
    }
    if (lamp.file == "fog.ies") {
      EXPECT_EQ(shape.side, CutoffSide::kFlat);
    }
  }
}

/// On planes C 2.5° apart, as laboratories of luminaires file a lamp: 0.1° in gamma to 10°, then wider.
IntensityTable on_planes(const IntensityTable& lamp) {
  IntensityTable planes;
  planes.type = PhotometricType::kC;
  for (int i = 0; i <= 144; ++i) planes.first_deg.push_back(2.5 * i);
  for (int i = 0; i <= 100; ++i) planes.second_deg.push_back(0.1 * i);
  for (int i = 11; i <= 90; ++i) planes.second_deg.push_back(1.0 * i);
  for (const double gamma : planes.second_deg) {
    for (const double c : planes.first_deg)
      planes.candela.push_back(lamp.intensity_cd(table_direction(PhotometricType::kC, GammaAxis::kGamma0, {c, gamma})));
  }
  return planes;
}

// A slant across the planes is a stair of theirs, and no step of the beam: aimed or not, it is the elbow that it is.
TEST(CutoffShape, AnElbowOnPlanesIsAnElbow) {
  for (const SampleLamp& lamp : sample_lamps()) {
    if (lamp.file.find("low") == std::string::npos) continue;
    const IntensityTable planes = on_planes(lamp.table);
    for (const double up_deg : {0.0, -0.4, -0.82}) {
      const glm::dmat3 turned = aim_rotation(0.0, glm::radians(up_deg), 0.0);
      const CutoffShape shape = cutoff_shape(mounted_intensity(planes, turned)),
                        known = cutoff_shape(mounted_intensity(lamp.table, turned));
      EXPECT_EQ(form_name(shape.form), form_name(known.form))
          << lamp.file << " " << up_deg << ", rise " << shape.rise_deg << ", "
          << (shape.steps.empty() ? std::string("no step")
                                  : "a step of " + std::to_string(shape.steps.front().height_deg) + " at H " +
                                        std::to_string(shape.steps.front().foot_h_deg) + " to " +
                                        std::to_string(shape.steps.front().head_h_deg));
      EXPECT_EQ(shape.side, known.side) << lamp.file << " " << up_deg;
      EXPECT_NEAR(shape.kink_h_deg, known.kink_h_deg, 0.3) << lamp.file << " " << up_deg;
    }
  }
}

}  // namespace
}  // namespace phare
