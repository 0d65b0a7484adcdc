#include "visual/process/picture_kind.h"

#include <tuple>

#include "visual/process/weather_ahead.h"

namespace phare {
namespace {

template <typename OfDesk>
auto levels(OfDesk& desk) {
  return std::tie(desk.compare, desk.view, desk.method, desk.shadows, desk.depth_first, desk.fog, desk.precipitation,
                  desk.ground, desk.glare, desk.fixed_light, desk.eyeshine, desk.spray, desk.asphalt, desk.windscreen,
                  desk.hdr_image, desk.snow_cover_drawn, desk.windscreen_drawn);
}

template <typename OfDesk>
auto amounts(OfDesk& desk) {
  return std::tie(desk.visibility_m, desk.rain_mmph, desk.snow_mmph, desk.snow_cover_01);
}

}  // namespace

bool same_kind(const Desk& a, const Desk& b) {
  return levels(a) == levels(b) && weather_of(a).same_kind(weather_of(b));
}

Desk with_kind_of(Desk asked, const Desk& shown) {
  levels(asked) = levels(shown);
  amounts(asked) = amounts(shown);
  return asked;
}

}  // namespace phare
