#include "config/base/two.h"

#include <cmath>

#if defined(__x86_64__) && defined(__GLIBC__)

// libmvec, two lanes: every such processor has them.
using Lanes = double __attribute__((vector_size(16)));
using FourLanes = double __attribute__((vector_size(32)));
extern "C" Lanes _ZGVbN2v_sin(Lanes);
extern "C" Lanes _ZGVbN2v_cos(Lanes);
extern "C" Lanes _ZGVbN2v_atan(Lanes);
extern "C" Lanes _ZGVbN2v_exp(Lanes);
extern "C" FourLanes _ZGVdN4v_sin(FourLanes);
extern "C" FourLanes _ZGVdN4v_atan(FourLanes);
extern "C" FourLanes _ZGVdN4v_exp(FourLanes);

namespace phare {
namespace {

// Each clears the upper halves of the registers before it returns: while they hold something, every instruction of two
// lanes waits for the one before it, and single-track takes two and a half times as long. The compiler does so by
// itself at -O2, not below.

// A cosine is the sine of a quarter turn more: with four lanes one call gives both. The sum rounds by half a unit of an
// angle of several radians: 4e-16.
[[gnu::target("avx2")]] SineCosine sine_cosine_of_four(Two angle_rad) {
  constexpr double kQuarterTurn_rad = 1.5707963267948966;
  const FourLanes all = _ZGVdN4v_sin(
      FourLanes{angle_rad[0], angle_rad[1], angle_rad[0] + kQuarterTurn_rad, angle_rad[1] + kQuarterTurn_rad});
  const SineCosine result{Two{all[0], all[1]}, Two{all[2], all[3]}};
  __builtin_ia32_vzeroupper();
  return result;
}
// Four lanes, two of them for nothing, are still twice as fast: their code multiplies and adds at once.
[[gnu::target("avx2")]] Two arctangent_of_four(Two value) {
  const FourLanes all = _ZGVdN4v_atan(FourLanes{value[0], value[1], value[0], value[1]});
  const Two result{all[0], all[1]};
  __builtin_ia32_vzeroupper();
  return result;
}
[[gnu::target("avx2")]] Two exponential_of_four(Two value) {
  const FourLanes all = _ZGVdN4v_exp(FourLanes{value[0], value[1], value[0], value[1]});
  const Two result{all[0], all[1]};
  __builtin_ia32_vzeroupper();
  return result;
}
const bool kFourLanes = __builtin_cpu_supports("avx2");

}  // namespace

SineCosine sine_cosine(Two angle_rad) {
  if (kFourLanes) return sine_cosine_of_four(angle_rad);
  return {_ZGVbN2v_sin(angle_rad), _ZGVbN2v_cos(angle_rad)};
}
Two arctangent(Two value) {
  return kFourLanes ? arctangent_of_four(value) : _ZGVbN2v_atan(value);
}
Two exponential(Two value) {
  return kFourLanes ? exponential_of_four(value) : _ZGVbN2v_exp(value);
}

}  // namespace phare

#else

namespace phare {

SineCosine sine_cosine(Two angle_rad) {
  return {Two{std::sin(angle_rad[0]), std::sin(angle_rad[1])}, Two{std::cos(angle_rad[0]), std::cos(angle_rad[1])}};
}
Two arctangent(Two value) {
  return Two{std::atan(value[0]), std::atan(value[1])};
}
Two exponential(Two value) {
  return Two{std::exp(value[0]), std::exp(value[1])};
}

}  // namespace phare

#endif
