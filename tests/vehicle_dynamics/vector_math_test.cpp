// unit: mathematics of two lanes leaves the processor as it found it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "config/base/two.h"
#include "test_car.h"
#include "vehicle_dynamics/models/tyre.h"

namespace phare {
namespace {

TEST(VectorMath, AgreesWithTheScalarOne) {
  for (const double x : {-3.1, -1.0, -1e-9, 0.0, 1e-3, 0.7, 2.9, 300.0}) {
    const SineCosine turned = sine_cosine(Two{x, -x});
    const double eps = 4.0 * 2.3e-16 * std::max(1.0, std::abs(x));  // 4 ulp, and the quarter turn's rounding
    EXPECT_NEAR(turned.sine[0], std::sin(x), eps);
    EXPECT_NEAR(turned.sine[1], -std::sin(x), eps);
    EXPECT_NEAR(turned.cosine[0], std::cos(x), eps);
    EXPECT_NEAR(arctangent(both(x))[1], std::atan(x), eps);
    EXPECT_NEAR(exponential(both(-std::abs(x)))[0], std::exp(-std::abs(x)), eps);
  }
}

#ifdef __x86_64__

// While the upper halves of the vector registers hold something, every instruction of two lanes waits for the one
// before it (Intel 64 and IA-32 Architectures Optimization Reference Manual, 15.3): a step of single-track took two and
// a half times as long.
void fill_upper_halves() {
  asm volatile("vcmptrueps %%ymm15, %%ymm15, %%ymm15" ::: "xmm15");
}
[[gnu::noinline]] bool upper_halves_clear() {
  std::array<std::uint64_t, 32> upper{};
  asm volatile(
      "vextractf128 $1, %%ymm0, 0(%0)\n"
      "vextractf128 $1, %%ymm1, 16(%0)\n"
      "vextractf128 $1, %%ymm2, 32(%0)\n"
      "vextractf128 $1, %%ymm3, 48(%0)\n"
      "vextractf128 $1, %%ymm4, 64(%0)\n"
      "vextractf128 $1, %%ymm5, 80(%0)\n"
      "vextractf128 $1, %%ymm6, 96(%0)\n"
      "vextractf128 $1, %%ymm7, 112(%0)\n"
      "vextractf128 $1, %%ymm8, 128(%0)\n"
      "vextractf128 $1, %%ymm9, 144(%0)\n"
      "vextractf128 $1, %%ymm10, 160(%0)\n"
      "vextractf128 $1, %%ymm11, 176(%0)\n"
      "vextractf128 $1, %%ymm12, 192(%0)\n"
      "vextractf128 $1, %%ymm13, 208(%0)\n"
      "vextractf128 $1, %%ymm14, 224(%0)\n"
      "vextractf128 $1, %%ymm15, 240(%0)\n" ::"r"(upper.data())
      : "memory");
  return std::ranges::all_of(upper, [](std::uint64_t half) { return half == 0; });
}

TEST(VectorMath, LeavesNoUpperHalvesInUse) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no upper halves";
  fill_upper_halves();
  ASSERT_FALSE(upper_halves_clear());
  sine_cosine(Two{0.3, 1.1});
  EXPECT_TRUE(upper_halves_clear()) << "sine_cosine";
  fill_upper_halves();
  arctangent(Two{0.3, 1.1});
  EXPECT_TRUE(upper_halves_clear()) << "arctangent";
  fill_upper_halves();
  exponential(Two{0.3, 1.1});
  EXPECT_TRUE(upper_halves_clear()) << "exponential";
  const tyre::Constants tyre = tyre::constants(test::car("bmw_320i.toml").chassis->tyre);
  const double slip[4] = {0.01, 0.02, -0.01, 0.0}, load_n[4] = {4e3, 4e3, 3e3, 3e3}, mu[4] = {1.0, 1.0, 1.0, 1.0};
  double x_n[4], y_n[4];
  fill_upper_halves();
  tyre::steady_forces(tyre, slip, slip, load_n, mu, x_n, y_n);
  EXPECT_TRUE(upper_halves_clear()) << "steady_forces";
}

#endif

}  // namespace
}  // namespace phare
