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

// A car at 20 m/s whose log has a hole: what lies in it is no extrapolated parabola.
TEST(LocalFit, AGapIsBridged) {
  for (const double hole_s : {0.9, 1.5, 2.0}) {
    std::vector<double> t, v;
    for (int i = 0; i < 1000; ++i) {
      if (0.01 * i > 4.0 && 0.01 * i < 4.0 + hole_s) continue;
      t.push_back(0.01 * i);
      v.push_back(20.0 + ((i * 7919) % 100 - 50) * 0.0012);
    }
    for (double at_s = 3.5; at_s < 6.5; at_s += 0.01) {
      const FittedValue fit = local_fit(t, v, at_s, 0.4);
      EXPECT_NEAR(fit.value, 20.0, 0.25) << hole_s << " " << at_s;
      EXPECT_NEAR(fit.slope, 0.0, 1.0) << hole_s << " " << at_s;
    }
  }
  // A cubic is bridged as it is, and joins what is fitted at both edges.
  std::vector<double> t, v;
  for (int i = 0; i <= 500; ++i) {
    if (i > 200 && i < 300) continue;
    t.push_back(0.01 * i);
    v.push_back(2.0 * t.back() * t.back());
  }
  for (const double at_s : {2.0, 2.01, 2.5, 2.99, 3.0}) {
    EXPECT_NEAR(local_fit(t, v, at_s, 0.2).value, 2.0 * at_s * at_s, 1e-8);
    EXPECT_NEAR(local_fit(t, v, at_s, 0.2).slope, 4.0 * at_s, 1e-6);
  }
}

TEST(LocalFit, FarBeyondTheEndsTheValueStays) {
  std::vector<double> t, v;
  for (int i = 0; i <= 100; ++i) t.push_back(10.0 + 0.01 * i), v.push_back(t.back() * t.back());
  EXPECT_NEAR(local_fit(t, v, 2.0, 0.2).value, 100.0, 1e-8);
  EXPECT_EQ(local_fit(t, v, 2.0, 0.2).slope, 0.0);
  EXPECT_NEAR(local_fit(t, v, 20.0, 0.2).value, 121.0, 1e-8);
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
