// The grain of surfaces: a tile of noise with mip maps. Red: fine chippings; green: soft patches. Made here, seeded, no
// file.
#pragma once

#include "visual/gpu/device.h"

namespace phare {

/// 512×512, repeats, mean 0.5 in both channels. Ready for sampling.
gpu::Image make_grain(gpu::Device& device);

}  // namespace phare
