#include "visual/gpu/pack_materials.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

// Coefficients are of luminance under illuminant A, as R_A is measured; the shader multiplies by rho/pi, which gives
// the tint, so what rho takes is given back. Product of colours in Rec. 709: not spectral.
shader::GpuMaterial pack_material(const SceneMaterial& material, std::vector<shader::GpuSheeting>& sheetings) {
  constexpr double kPi = std::numbers::pi;
  shader::GpuMaterial packed{glm::vec4(material.reflectance, 0.0f)};
  // Of a picture of a sign what is white sends back as its class does; of ground and markings it is the mean.
  const bool by_white = material.look.base_texture && material.retro.kind == RetroKind::kSheeting;
  constexpr double kBlack = 1e-6;  // sends nothing back, and divides by nothing
  const double rho =
      std::max(reflectance_under_a(by_white ? glm::vec3(material.look.base) : material.reflectance), kBlack);
  if (material.retro.kind == RetroKind::kMarking || material.retro.kind == RetroKind::kFacets) {
    packed.reflectance.w = static_cast<float>(sent_back_strength(material.retro, rho) * kPi / rho);
  } else if (material.retro.kind == RetroKind::kSheeting) {
    packed.reflectance.w = static_cast<float>(sheetings.size());
    shader::GpuSheeting& sheeting = sheetings.emplace_back();
    for (std::size_t i = 0; i < material.retro.ln_r_a.size(); ++i)
      sheeting.row[i] = material.retro.ln_r_a[i] + static_cast<float>(std::log(kPi / rho));
  } else if (material.retro.kind == RetroKind::kGrooves) {
    packed.reflectance.w = static_cast<float>(sheetings.size());
    std::ranges::copy(groove_terms(material.retro.roughness_rad, material.reflectance), sheetings.emplace_back().row);
  }
  return packed;
}

// Where GpuMaterial has it. Of a scene with more than half of the materials there may be some have no room for it:
// their markings keep what ordinary beads do.
void pack_wet_markings(const Scene& scene, std::size_t first, std::size_t count,
                       std::vector<shader::GpuMaterial>& packed) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const SceneMaterial& material = scene.materials[i];
    if (material.retro.kind != RetroKind::kMarking || material.retro.wet_mcd_per_lx_m2 <= 0.0) continue;
    const std::size_t place = shader::kMaxMaterials - 1 - (first + i);
    if (place < count) {
      spdlog::warn("'{}' has an R_L of its own when wet; among {} materials it keeps what ordinary beads do",
                   material.name, count);
      continue;
    }
    const double share = wet_share(material.retro, reflectance_under_a(material.reflectance));
    packed[place].reflectance = {static_cast<float>(share), 0.0f, 0.0f, -1.0f};
  }
}

}  // namespace

PackedMaterials pack_materials(const Scene& standing, const Scene& moving) {
  PackedMaterials all;
  auto& [packed, sheetings] = all;
  for (const Scene* scene : {&standing, &moving})
    for (const SceneMaterial& material : scene->materials) packed.push_back(pack_material(material, sheetings));
  if (packed.size() > shader::kMaxMaterials)
    throw std::runtime_error(std::to_string(packed.size()) + " materials, " + std::to_string(moving.materials.size()) +
                             " of them of people, animals and vehicles; at most " +
                             std::to_string(shader::kMaxMaterials) + " are drawn");
  if (sheetings.size() > shader::kMaxSheetings)
    throw std::runtime_error(std::to_string(sheetings.size()) +
                             " retroreflective sheetings and rough surfaces, at most " +
                             std::to_string(shader::kMaxSheetings) + " are drawn");
  sheetings.resize(shader::kMaxSheetings);
  const std::size_t count = packed.size();
  packed.resize(shader::kMaxMaterials, {glm::vec4(0.5f, 0.5f, 0.5f, 0.0f)});
  pack_wet_markings(standing, 0, count, packed);
  pack_wet_markings(moving, standing.materials.size(), count, packed);
  return all;
}

}  // namespace phare
