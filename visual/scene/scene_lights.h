// Lamps of a glTF file: KHR_lights_punctual and EXT_lights_ies. They stand in the scene as street lamps do
// (visual/fixed_light.h); here they are read, their photometry files are not looked into. docs/street-lamps.md says what
// of them counts. Checked by
// tests/visual_process/scene_lights_test.cpp.
#pragma once

#include <filesystem>

#include "config/formats/gltf_file.h"
#include "visual/scene/scene.h"

namespace phare {

/// More are taken for an error.
inline constexpr std::size_t kMostSceneLights = 20000;

/// Into `scene`. Error: which light or node, and what is wrong with it.
Status read_scene_lights(const tinygltf::Model& model, const std::filesystem::path& folder, Scene& scene);

}  // namespace phare
