#include "config/two.h"

#include <cmath>

#if defined(__x86_64__) && defined(__GLIBC__)

// libmvec, two lanes: every such processor has them.
using Lanes = double __attribute__((vector_size(16)));
extern "C" Lanes _ZGVbN2v_sin(Lanes);
extern "C" Lanes _ZGVbN2v_cos(Lanes);
extern "C" Lanes _ZGVbN2v_atan(Lanes);
extern "C" Lanes _ZGVbN2v_exp(Lanes);

namespace phare {

Two sine(Two angle_rad) {
  return _ZGVbN2v_sin(angle_rad);
}
Two cosine(Two angle_rad) {
  return _ZGVbN2v_cos(angle_rad);
}
Two arctangent(Two value) {
  return _ZGVbN2v_atan(value);
}
Two exponential(Two value) {
  return _ZGVbN2v_exp(value);
}

}  // namespace phare

#else

namespace phare {

Two sine(Two angle_rad) {
  return Two{std::sin(angle_rad[0]), std::sin(angle_rad[1])};
}
Two cosine(Two angle_rad) {
  return Two{std::cos(angle_rad[0]), std::cos(angle_rad[1])};
}
Two arctangent(Two value) {
  return Two{std::atan(value[0]), std::atan(value[1])};
}
Two exponential(Two value) {
  return Two{std::exp(value[0]), std::exp(value[1])};
}

}  // namespace phare

#endif
