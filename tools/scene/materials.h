// The materials of the generated scene. Diffuse reflectances are linear Rec. 709, retroreflection is R_A in cd/(lx·m²).
#pragma once

#include <array>
#include <cstddef>

namespace phare::scene {

enum class Material {
  kAsphalt,
  kPaint,
  kVerge,
  kGrass,
  kBark,
  kLeaves,
  kSpruce,
  kBush,
  kLeavesAutumn,
  kPostWhite,
  kPostBlack,
  kReflectorWhite,
  kReflectorAmber,
  kReflectorRed,
  kSteel,
  kWood,
  kWoodOld,
  kPlaster,
  kRoofTiles,
  kStone,
  kDoor,
  kHay,
  kCarPaint,
  kGlass,
  kRubber,
  kDarkPlastic,
  kChrome,
  kPlate,
  kSkin,
  kHair,
  kClothDark,
  kClothBlue,
  kClothLight,
  kClothRed,
  kSheetWhite,
  kSheetRed,
  kSheetYellow,
  kSheetBlack,
  kSignBack,
  kCount
};

struct MaterialData {
  const char* name;
  std::array<double, 3> reflectance;
  const char* surface;  ///< asphalt, grass, paint, plain, foliage
  double retroreflection_cd_per_lx_m2;
  bool double_sided;
};

/// Reflectances by eye within published ranges: asphalt 0.07–0.10, grass 0.08–0.15, plaster 0.6–0.7, dark cloth
/// 0.03–0.05 (CIE 66, road photometry handbooks). R_A of sheeting: EN 12899-1 class RA2 at 0.33°/5°: white 180, yellow
/// 120, red 25.
inline constexpr std::array<MaterialData, static_cast<std::size_t>(Material::kCount)> kMaterials{{
    {"asphalt", {0.085, 0.083, 0.080}, "asphalt", 0.0, false},
    {"road paint", {0.50, 0.50, 0.48}, "paint", 0.2, false},
    {"verge", {0.135, 0.125, 0.075}, "grass", 0.0, false},
    {"meadow", {0.075, 0.115, 0.035}, "grass", 0.0, false},
    {"bark", {0.085, 0.070, 0.055}, "plain", 0.0, false},
    {"leaves", {0.050, 0.090, 0.025}, "foliage", 0.0, true},
    {"spruce", {0.030, 0.055, 0.025}, "foliage", 0.0, true},
    {"bush", {0.065, 0.100, 0.035}, "foliage", 0.0, true},
    {"leaves light", {0.085, 0.105, 0.030}, "foliage", 0.0, true},
    {"post white", {0.70, 0.70, 0.68}, "plain", 0.0, false},
    {"post black", {0.035, 0.035, 0.035}, "plain", 0.0, false},
    {"reflector white", {0.30, 0.30, 0.30}, "plain", 50.0, false},
    {"reflector amber", {0.30, 0.16, 0.02}, "plain", 30.0, false},
    {"reflector red", {0.22, 0.015, 0.012}, "plain", 15.0, false},
    {"galvanised steel", {0.38, 0.39, 0.40}, "plain", 0.0, true},
    {"wood", {0.155, 0.100, 0.060}, "plain", 0.0, true},
    {"wood weathered", {0.180, 0.165, 0.145}, "plain", 0.0, true},
    {"plaster", {0.66, 0.645, 0.60}, "plain", 0.0, false},
    {"roof tiles", {0.145, 0.060, 0.042}, "plain", 0.0, false},
    {"stone", {0.22, 0.21, 0.19}, "plain", 0.0, false},
    {"door", {0.050, 0.095, 0.060}, "plain", 0.0, false},
    {"hay", {0.32, 0.25, 0.12}, "grass", 0.0, false},
    {"car paint", {0.070, 0.095, 0.150}, "plain", 0.0, false},
    {"glass", {0.020, 0.022, 0.024}, "plain", 0.0, false},
    {"rubber", {0.028, 0.028, 0.028}, "plain", 0.0, false},
    {"dark plastic", {0.040, 0.040, 0.042}, "plain", 0.0, false},
    {"bright metal", {0.50, 0.50, 0.50}, "plain", 0.0, false},
    {"number plate", {0.55, 0.55, 0.53}, "plain", 40.0, false},
    {"skin", {0.36, 0.24, 0.18}, "plain", 0.0, false},
    {"hair", {0.035, 0.026, 0.020}, "plain", 0.0, false},
    {"cloth dark", {0.035, 0.035, 0.042}, "plain", 0.0, false},
    {"cloth blue", {0.055, 0.075, 0.130}, "plain", 0.0, false},
    {"cloth light", {0.42, 0.40, 0.35}, "plain", 0.0, false},
    {"cloth red", {0.26, 0.045, 0.035}, "plain", 0.0, false},
    {"sheeting white", {0.40, 0.40, 0.39}, "plain", 180.0, false},
    {"sheeting red", {0.16, 0.012, 0.014}, "plain", 25.0, false},
    {"sheeting yellow", {0.38, 0.26, 0.02}, "plain", 120.0, false},
    {"sign black", {0.030, 0.030, 0.030}, "plain", 0.0, false},
    {"sign back", {0.22, 0.22, 0.23}, "plain", 0.0, false},
}};

}  // namespace phare::scene
