// Reference: the veil of glare in float64 against the tables of another program; unit: where the equation ends.
#include "visual/photometry/table/veil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "photometry_test_files.h"

namespace phare {
namespace {

using test::Csv;
using test::shared_data;

TEST(Veil, IsWhatTheEquationHas) {
  // Age 25, pigment 0.5, at 1°, 3°, 10°.
  const Viewer young{25.0, 0.5};
  EXPECT_NEAR(veil_general_per_sr(young, 1.0), 10.0 + 5.05 * 1.0256 + 0.00125, 1e-12);
  EXPECT_NEAR(veil_general_per_sr(young, 3.0), 0.95841, 1e-4);
  EXPECT_NEAR(veil_general_per_sr(young, 10.0), 0.06766, 1e-4);
  EXPECT_EQ(veil_general_per_sr(young, 0.0), veil_general_per_sr(young, 0.1)) << "no singularity";
  EXPECT_GT(veil_general_per_sr({70.0, 0.5}, 5.0), 1.5 * veil_general_per_sr(young, 5.0));
}

TEST(Veil, LeavesMostLightWhereItBelongs) {
  const double young = veil_beyond({25.0, 0.5}, 0.1), old = veil_beyond({80.0, 0.5}, 0.1);
  EXPECT_GT(young, 0.1);
  EXPECT_LT(old, 1.0);
  EXPECT_GT(old, young);
  EXPECT_GT(young, veil_beyond({25.0, 0.5}, 1.0));
}

TEST(Veil, FormulasAreThoseOfTheReference) {
  PHARE_NEEDS_SHARED_DATA("photometry-reference/i_veil_formula.csv");
  const Csv csv(shared_data("photometry-reference/i_veil_formula.csv"));
  double worst = 0.0;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const Viewer viewer{csv.number(i, "age"), csv.number(i, "pigment")};
    const double e = csv.number(i, "E_glare_lx"), theta = csv.number(i, "theta_deg");
    const auto compare = [&](double per_sr, const char* column) {
      worst = std::max(worst, std::abs(e * per_sr / csv.number(i, column) - 1.0));
    };
    compare(veil_general_per_sr(viewer, theta), "Lv_cie146_general");
    compare(veil_small_angle_per_sr(viewer, theta), "Lv_cie146_small_angle");
    compare(veil_age_adjusted_per_sr(viewer, theta), "Lv_age_adjusted_stiles_holladay");
  }
  std::printf("veil: %zu rows of three formulas, worst relative difference %.2g\n", csv.rows.size(), worst);
  EXPECT_GT(csv.rows.size(), 20u);
  EXPECT_LE(worst, 1e-10);
}

TEST(Veil, OfOncomingLampsIsThatOfTheReference) {
  PHARE_NEEDS_SHARED_DATA("photometry-reference/i_veil_oncoming.csv");
  const Csv csv(shared_data("photometry-reference/i_veil_oncoming.csv"));
  double worst = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const Viewer viewer{csv.number(i, "age"), csv.number(i, "pigment")};
    double veil = csv.number(i, "E_eye_lx") * veil_general_per_sr(viewer, csv.number(i, "theta_deg"));
    if (csv.text(i, "lamp") == "sum")
      veil = std::exchange(sum, 0.0);
    else
      sum += veil;
    worst = std::max(worst, std::abs(veil / csv.number(i, "Lv") - 1.0));
  }
  std::printf("veil of oncoming lamps: %zu rows, worst relative difference %.2g\n", csv.rows.size(), worst);
  EXPECT_LE(worst, 1e-9);
}

}  // namespace
}  // namespace phare
