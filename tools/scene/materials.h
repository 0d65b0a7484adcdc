// The materials of the generated scene. Diffuse reflectances are linear Rec. 709, retroreflection by class
// (visual/scene/retro.h).
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
  kLeavesWithin,
  kBushWithin,
  kLeavesAutumnWithin,
  // Of town, motorway and tunnel only: the country road's file ends before them.
  kPavement,
  kKerb,
  kFacadeWhite,
  kFacadeOchre,
  kFacadeGrey,
  kFacadeRed,
  kWindowDark,
  kWindowWarm,
  kWindowDim,
  kWindowCool,
  kShopFront,
  kLampGlass,
  kLampHousing,
  kConcrete,
  kSheetBlue,
  kTunnelRoad,
  kTunnelPaint,
  kTunnelWalk,
  kTunnelPanel,
  kTunnelVault,
  kTunnelGlass,
  kEscapeSign,
  kEscapeSignWhite,
  kCarPaintSilver,
  kCarPaintBlack,
  kCarPaintRed,
  kCarPaintWhite,
  // Of road users only.
  kDeerCoat,
  kDeerEye,
  kPupil,
  kCount
};

struct MaterialData {
  const char* name;
  std::array<double, 3> reflectance;
  const char* surface;  ///< asphalt, grass, paint, plain, foliage
  const char* retro;    ///< class, or none
  bool double_sided;
  double retroreflection_cd_per_lx_m2 = 0.0;  ///< R_A at 0.33°, 5° in place of the class's; 0: the class's
  std::array<double, 3> emission_cdm2{};      ///< what it sends out by itself
  double sky_share = 1.0;                     ///< 0: under a roof
  bool r_table = true;                        ///< false: asphalt that is none, only as rough as it
};

/// Reflectances by eye within published ranges: asphalt 0.07–0.10, grass 0.08–0.15, plaster 0.6–0.7, dark cloth
/// 0.03–0.05 (CIE 66, road photometry handbooks). Ground is rough: stones and tufts send light back (docs/light.md).
/// Markings as a road in use has them, signs and delineators as RA2: of delineators (EN 12899-3) no figures were found.
/// The red reflectors of cycle and car: 0.3 cd/lx over their 80 cm².
inline constexpr std::array<MaterialData, static_cast<std::size_t>(Material::kCount)> kMaterials{{
    {"asphalt", {0.085, 0.083, 0.080}, "asphalt", "upright facets", false},
    {"road paint", {0.50, 0.50, 0.48}, "paint", "EN 1436 R4", false},
    {"verge", {0.135, 0.125, 0.075}, "grass", "upright facets", false},
    {"meadow", {0.075, 0.115, 0.035}, "grass", "upright facets", false},
    {"bark", {0.085, 0.070, 0.055}, "plain", "", false},
    {"leaves", {0.050, 0.090, 0.025}, "foliage", "", true},
    {"spruce", {0.030, 0.055, 0.025}, "foliage", "", true},
    {"bush", {0.065, 0.100, 0.035}, "foliage", "", true},
    {"leaves light", {0.085, 0.105, 0.030}, "foliage", "", true},
    {"post white", {0.70, 0.70, 0.68}, "plain", "", false},
    {"post black", {0.035, 0.035, 0.035}, "plain", "", false},
    {"reflector white", {0.30, 0.30, 0.30}, "plain", "EN 12899-1 RA2 white", false},
    {"reflector amber", {0.30, 0.16, 0.02}, "plain", "EN 12899-1 RA2 yellow", false},
    {"reflector red", {0.22, 0.015, 0.012}, "plain", "UN R3 IA red", false, 37.5},
    {"galvanised steel", {0.38, 0.39, 0.40}, "plain", "", true},
    {"wood", {0.155, 0.100, 0.060}, "plain", "", true},
    {"wood weathered", {0.180, 0.165, 0.145}, "plain", "", true},
    {"plaster", {0.66, 0.645, 0.60}, "plain", "", false},
    {"roof tiles", {0.145, 0.060, 0.042}, "plain", "", false},
    {"stone", {0.22, 0.21, 0.19}, "plain", "", false},
    {"door", {0.050, 0.095, 0.060}, "plain", "", false},
    {"hay", {0.32, 0.25, 0.12}, "grass", "upright facets", false},
    {"car paint", {0.070, 0.095, 0.150}, "plain", "", false},
    {"glass", {0.020, 0.022, 0.024}, "plain", "", false},
    {"rubber", {0.028, 0.028, 0.028}, "plain", "", false},
    {"dark plastic", {0.040, 0.040, 0.042}, "plain", "", false},
    {"bright metal", {0.50, 0.50, 0.50}, "plain", "", false},
    {"number plate", {0.55, 0.55, 0.53}, "plain", "number plate white", false},
    {"skin", {0.36, 0.24, 0.18}, "plain", "", false},
    {"hair", {0.035, 0.026, 0.020}, "plain", "", false},
    {"cloth dark", {0.035, 0.035, 0.042}, "plain", "", false},
    {"cloth blue", {0.055, 0.075, 0.130}, "plain", "", false},
    {"cloth light", {0.42, 0.40, 0.35}, "plain", "", false},
    {"cloth red", {0.26, 0.045, 0.035}, "plain", "", false},
    {"sheeting white", {0.40, 0.40, 0.39}, "plain", "EN 12899-1 RA2 white", false},
    {"sheeting red", {0.16, 0.012, 0.014}, "plain", "EN 12899-1 RA2 red", false},
    {"sheeting yellow", {0.38, 0.26, 0.02}, "plain", "EN 12899-1 RA2 yellow", false},
    {"sign black", {0.030, 0.030, 0.030}, "plain", "", false},
    {"sign back", {0.22, 0.22, 0.23}, "plain", "", false},
    // Of closed lumps within crowns, which hide what is in them: seen from outside alone, and two thirds in the leaves'
    // shade.
    {"leaves within", {0.017, 0.030, 0.008}, "foliage", "", false},
    {"bush within", {0.022, 0.033, 0.012}, "foliage", "", false},
    {"leaves light within", {0.028, 0.035, 0.010}, "foliage", "", false},
    // Luminances by eye: lit windows at night lie between a few and a hundred cd/m² (unconfirmed); the glass of a
    // luminaire of 3500 lm over 0.14 m² has some 8000.
    {"pavement", {0.19, 0.185, 0.175}, "asphalt", "upright facets", false, 0.0, {}, 1.0, false},
    {"kerb stone", {0.26, 0.255, 0.245}, "plain", "", false},
    {"facade white", {0.58, 0.57, 0.53}, "plain", "", false},
    {"facade ochre", {0.48, 0.38, 0.24}, "plain", "", false},
    {"facade grey", {0.30, 0.30, 0.29}, "plain", "", false},
    {"facade brick", {0.22, 0.10, 0.07}, "plain", "", false},
    {"window dark", {0.03, 0.032, 0.035}, "plain", "", false},
    {"window warm", {0.30, 0.29, 0.27}, "plain", "", false, 0.0, {26.0, 16.0, 6.5}},
    {"window dim", {0.20, 0.19, 0.17}, "plain", "", false, 0.0, {5.6, 3.1, 1.0}},
    {"window cool", {0.30, 0.30, 0.30}, "plain", "", false, 0.0, {13.0, 15.0, 14.0}},
    {"shop front", {0.35, 0.35, 0.34}, "plain", "", false, 0.0, {36.0, 31.0, 22.5}},
    {"lamp glass", {0.50, 0.50, 0.50}, "plain", "", false, 0.0, {9200.0, 7900.0, 6000.0}},
    {"lamp housing", {0.10, 0.10, 0.105}, "plain", "", false},
    {"concrete", {0.31, 0.30, 0.285}, "plain", "", false},
    {"sheeting blue", {0.02, 0.06, 0.26}, "plain", "EN 12899-1 RA2 blue", false},
    {"asphalt in tunnel", {0.095, 0.093, 0.090}, "asphalt", "upright facets", false, 0.0, {}, 0.0},
    {"road paint in tunnel", {0.50, 0.50, 0.48}, "paint", "EN 1436 R4", false, 0.0, {}, 0.0},
    {"walkway in tunnel", {0.24, 0.235, 0.22}, "plain", "", false, 0.0, {}, 0.0},
    {"wall panel", {0.62, 0.62, 0.59}, "plain", "", false, 0.0, {}, 0.0},
    {"vault", {0.24, 0.235, 0.225}, "plain", "", false, 0.0, {}, 0.0},
    {"tunnel lamp glass", {0.50, 0.50, 0.50}, "plain", "", false, 0.0, {7900.0, 7950.0, 7400.0}, 0.0},
    {"escape sign", {0.05, 0.30, 0.12}, "plain", "", false, 0.0, {0.35, 5.0, 1.4}, 0.0},
    {"escape sign white", {0.55, 0.55, 0.55}, "plain", "", false, 0.0, {30.0, 30.0, 28.5}, 0.0},
    {"car paint silver", {0.30, 0.30, 0.31}, "plain", "", false},
    {"car paint black", {0.022, 0.022, 0.024}, "plain", "", false},
    {"car paint red", {0.160, 0.022, 0.018}, "plain", "", false},
    {"car paint white", {0.58, 0.58, 0.56}, "plain", "", false},
    // A winter coat, grey brown, and the tint of eyeshine: by eye.
    {"deer coat", {0.15, 0.12, 0.09}, "plain", "", false},
    {"deer eye", {0.02, 0.02, 0.02}, "plain", "", false},
    {"animal eye", {0.30, 0.33, 0.20}, "plain", "tapetum lucidum", false},
}};

}  // namespace phare::scene
