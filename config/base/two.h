// Two numbers in one register, for arithmetic that is the same twice: left and right wheel, front and rear axle.
#pragma once

namespace phare {

/// Operators work lane by lane, comparisons choose lane by lane: `a > b ? a : b`. Two{x, y} sets, v[0] and v[1] read.
using Two = double __attribute__((vector_size(16)));

inline Two both(double value) {
  return Two{value, value};
}
#if defined(__SSE2__)  // one instruction, which does just this: the second where the first is not the larger
inline Two largest(Two a, Two b) {
  return __builtin_ia32_maxpd(a, b);
}
inline Two least(Two a, Two b) {
  return __builtin_ia32_minpd(a, b);
}
#else
inline Two largest(Two a, Two b) {
  return a > b ? a : b;
}
inline Two least(Two a, Two b) {
  return a < b ? a : b;
}
#endif
inline Two magnitude(Two a) {
  return largest(a, -a);
}

/// Of both at once, by the C library's vector mathematics where it has them: within 4 ulp, the same on every run.
struct SineCosine {
  Two sine, cosine;
};
SineCosine sine_cosine(Two angle_rad);
Two arctangent(Two value);
Two exponential(Two value);

}  // namespace phare
