// unit: the local parabola gives back parabolas exactly, at uneven times and past the ends.
#include "tools/local_fit.h"

#include <gtest/gtest.h>

#include <vector>

namespace phare {
namespace {

TEST(LocalFit, ReproducesAParabola) {
  std::vector<double> t, v;
  for (int i = 0; i < 60; ++i) {
    const double at = 46408.0 + 0.012 * i + (i % 3) * 0.002;
    t.push_back(at);
    const double u = at - 46408.0;
    v.push_back(3.0 - 2.0 * u + 4.0 * u * u);
  }
  for (const double u : {-0.02, 0.0, 0.1, 0.35, 0.70, 0.75}) {
    const FittedValue fit = local_fit(t, v, 46408.0 + u, 0.2);
    EXPECT_NEAR(fit.value, 3.0 - 2.0 * u + 4.0 * u * u, 1e-8) << u;
    EXPECT_NEAR(fit.slope, -2.0 + 8.0 * u, 1e-6) << u;
  }
}

TEST(LocalFit, FewSamples) {
  EXPECT_EQ(local_fit({}, {}, 1.0, 0.1).value, 0.0);
  const std::vector<double> one_t{2.0}, one_v{5.0};
  EXPECT_EQ(local_fit(one_t, one_v, 1.0, 0.1).value, 5.0);
  EXPECT_EQ(local_fit(one_t, one_v, 1.0, 0.1).slope, 0.0);
  const std::vector<double> t{0, 10, 20, 30}, v{1, 1, 1, 1};  // window holds none: the nearest four
  EXPECT_NEAR(local_fit(t, v, 12.0, 0.1).value, 1.0, 1e-12);
}

}  // namespace
}  // namespace phare
