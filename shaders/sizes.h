// Sizes of the contracts that config/ has to keep to as well; alone here, so that it needs nothing else of the shaders.
#ifndef PHARE_SHADERS_SIZES_H
#define PHARE_SHADERS_SIZES_H
#ifdef __cplusplus
namespace phare::shader {
using uint = unsigned int;
#endif

const uint kMaxLamps = 8u;         // positions that a view sums per pixel; the shaders are compiled for 2, 4 and so many
const uint kMaxIsoluxLevels = 8u;  // of false colour; a multiple of 4

#ifdef __cplusplus
}  // namespace phare::shader
#endif
#endif
