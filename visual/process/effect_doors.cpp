#include "visual/process/effect_doors.h"

namespace phare {
namespace {

constexpr std::array<EffectDoor, kEffectCount> kDoors{
    {{Effect::kShadows, "shadows", &Desk::shadows},
     {Effect::kDepthFirst, "depth_first", &Desk::depth_first},
     {Effect::kHdrImage, "hdr_image", &Desk::hdr_image},
     {Effect::kOverlay, "overlay", &Desk::overlay},
     {Effect::kFog, "fog", &Desk::fog},
     {Effect::kPrecipitation, "precipitation", &Desk::precipitation},
     {Effect::kWetGround, "ground", &Desk::ground},
     {Effect::kGlare, "glare", &Desk::glare},
     {Effect::kGui, "panel", nullptr},
     {Effect::kFixedLight, "fixed_light", &Desk::fixed_light},
     {Effect::kEyeshine, "eyeshine", &Desk::eyeshine},
     {Effect::kSnowCover, "snow_cover_drawn", &Desk::snow_cover_drawn},
     {Effect::kWindscreen, "windscreen_drawn", &Desk::windscreen_drawn},
     {Effect::kSpray, "spray", &Desk::spray},
     {Effect::kAsphalt, "asphalt", &Desk::asphalt}}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kDoors.size(); ++i)
    if (static_cast<std::size_t>(kDoors[i].effect) != i) return false;
  return true;
}
static_assert(in_order());

}  // namespace

const std::array<EffectDoor, kEffectCount>& effect_doors() {
  return kDoors;
}

EffectChoices choices_of(const Desk& desk) {
  EffectChoices choices{};
  for (const EffectDoor& door : kDoors)
    if (door.level != nullptr) choices[static_cast<std::size_t>(door.effect)] = desk.*door.level;
  return choices;
}

}  // namespace phare
