// Materials of a scene as the device holds them: reflectance and what is sent back (shaders/lamps.h).
#pragma once

#include <vector>

#include "shaders/lamps.h"
#include "visual/scene/scene.h"

namespace phare {

struct PackedMaterials {
  std::vector<shader::GpuMaterial> materials;  ///< kMaxMaterials: of what stands, of what moves, and none
  std::vector<shader::GpuSheeting> sheetings;  ///< kMaxSheetings
};

/// Throws where there are more than the device holds.
PackedMaterials pack_materials(const Scene& standing, const Scene& moving);

}  // namespace phare
