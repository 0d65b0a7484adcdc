#include "visual/photometry/bench/table_end.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <set>
#include <tuple>

#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/bench/lamp_aim.h"

namespace phare {
namespace {

constexpr double kVisible_lx = 0.1;
constexpr double kWidest_deg = 70.0, kStep_deg = 2.0, kFine_deg = 0.01, kAbove_deg = 0.5;
constexpr double kHighest_deg = -0.3, kLowest_deg = -85.0;  // where the road is looked for

class Rim {
 public:
  Rim(const IntensityTable& table, const glm::dmat3& car_from_lamp, double scale, const glm::dvec3& position_m,
      std::span<const ChannelConfig> channels)
      : table_(table), car_from_lamp_(car_from_lamp), scale_(scale), position_m_(position_m), channels_(channels) {}

  bool known(double h_deg, double v_deg) const {
    return evidence_of(table_, direction_hv(h_deg, v_deg) * car_from_lamp_) != Evidence::kNone;
  }
  /// E on the road where the ray meets it, lx; 0 where no channel sees that place.
  double seen_lx(double h_deg, double v_deg) const {
    const glm::dvec3 d = direction_hv(h_deg, v_deg);
    if (!(d.z < 0.0) || !(position_m_.z > 0.0)) return 0.0;
    const double r_m = position_m_.z / -d.z;
    if (!in_picture(position_m_ + d * r_m)) return 0.0;
    return scale_ * table_.intensity_cd(d * car_from_lamp_) * -d.z / (r_m * r_m);
  }
  /// Down to where the road straight ahead is in a picture; all the way down where none looks ahead.
  double lowest_seen_deg() const {
    double lowest = kLowest_deg;
    for (double v = kLowest_deg; v < kHighest_deg; v += 0.5) {
      const glm::dvec3 d = direction_hv(0.0, v);
      if (!in_picture(position_m_ + d * (position_m_.z / -d.z))) continue;
      lowest = v - 0.5;
      break;
    }
    return std::max(lowest, kLowest_deg);
  }
  /// The direction in the lamp's own H and V.
  TableAngles own(double h_deg, double v_deg) const {
    return table_angles(PhotometricType::kA, GammaAxis::kGamma0, direction_hv(h_deg, v_deg) * car_from_lamp_);
  }
  /// Just outside the rim at (h, v): is the side's end there, and not the lower one's? Above a lower end the table goes
  /// on. The upright edges of every kind of table keep their H in the lamp's frame, or lean outwards below.
  bool ends_aside(double h_deg, double v_deg) const {
    const TableAngles rim = own(h_deg, v_deg);
    const double outside_deg = rim.first_deg + std::copysign(3.0 * kFine_deg, rim.first_deg);
    return evidence_of(table_, direction_hv(outside_deg, rim.second_deg + kAbove_deg)) == Evidence::kNone;
  }
  /// Between a known and an unknown place, the last known one.
  double last_known(double inside, double outside, const auto& is_known) const {
    while (std::abs(outside - inside) > kFine_deg) {
      const double middle = 0.5 * (inside + outside);
      (is_known(middle) ? inside : outside) = middle;
    }
    return inside;
  }

 private:
  bool in_picture(const glm::dvec3& point_m) const {
    return std::ranges::any_of(channels_, [&](const ChannelConfig& channel) {
      const glm::dvec3 p =
          (point_m - channel.eye_m) * aim_rotation(channel.yaw_rad, channel.pitch_rad, 0.0);  // forward, left, up
      const double half = std::tan(0.5 * channel.fov_horizontal_rad);
      return p.x > 0.0 && std::abs(p.y) <= half * p.x &&
             std::abs(p.z) <= half * p.x * channel.height_px / std::max(channel.width_px, 1);
    });
  }

  const IntensityTable& table_;
  glm::dmat3 car_from_lamp_;
  double scale_;
  glm::dvec3 position_m_;
  std::span<const ChannelConfig> channels_;
};

}  // namespace

std::string TableEnd::text() const {
  char text[240] = "";
  std::string all;
  if (below) {
    std::snprintf(text, sizeof text, "table ends at V %.1f°: the road nearer than %.1f m ahead is outside it", v_deg,
                  nearest_road_m);
    all = text;
  }
  if (sideways) {
    const bool left = left_deg > -180.0, right = right_deg < 180.0;  // one side may end in the dark
    const char* const begin = !below          ? "table ends at"
                              : left && right ? "; to the sides it ends at"
                                              : "; to one side it ends at";
    if (left && right)
      std::snprintf(text, sizeof text, "%s H %+.0f° and %+.0f°: the road beside that is outside it", begin, left_deg,
                    right_deg);
    else
      std::snprintf(text, sizeof text, "%s H %+.0f°: the road beside that is outside it", begin,
                    left ? left_deg : right_deg);
    all += text;
  }
  return all;
}

std::optional<TableEnd> table_end(const IntensityTable& table, const glm::dmat3& car_from_lamp, double scale,
                                  const glm::dvec3& position_m, std::span<const ChannelConfig> channels) {
  const Rim rim(table, car_from_lamp, scale, position_m, channels);
  TableEnd end;
  // Downwards, at every azimuth that the table knows; told for the one nearest to straight ahead.
  double nearest_h = kWidest_deg + 1.0;
  const double lowest_deg = rim.lowest_seen_deg();
  for (double h = -kWidest_deg; h <= kWidest_deg; h += kStep_deg) {
    const auto is_known = [&](double v) { return rim.known(h, v); };
    if (!is_known(kHighest_deg)) continue;
    double v = kHighest_deg;
    while (v > lowest_deg && is_known(v - 0.5)) v -= 0.5;
    if (v <= lowest_deg) continue;
    v = rim.last_known(v, v - 0.5, is_known);
    const double lx = rim.seen_lx(h, v);
    if (lx < kVisible_lx) continue;
    end.below = true;
    end.brightest_lx = std::max(end.brightest_lx, lx);
    if (std::abs(h) >= nearest_h) continue;
    nearest_h = std::abs(h);
    end.v_deg = rim.own(h, v).second_deg;
    end.nearest_road_m = position_m.z / std::tan(glm::radians(-v));
  }
  // Sideways, at every elevation that meets the road.
  end.left_deg = -180.0;
  end.right_deg = 180.0;
  for (double v = kHighest_deg; v > lowest_deg; v -= 1.0) {
    for (const double side : {-1.0, 1.0}) {
      const auto is_known = [&](double h) { return rim.known(h, v); };
      if (!is_known(0.0)) continue;
      double h = 0.0;
      while (std::abs(h) < kWidest_deg && is_known(h + side)) h += side;
      if (std::abs(h) >= kWidest_deg) continue;
      h = rim.last_known(h, h + side, is_known);
      const double lx = rim.seen_lx(h, v);
      if (lx < kVisible_lx || !rim.ends_aside(h, v)) continue;
      end.sideways = true;
      end.brightest_lx = std::max(end.brightest_lx, lx);
      const double own_deg = rim.own(h, v).first_deg;
      if (side < 0.0) end.left_deg = std::max(end.left_deg, own_deg);
      if (side > 0.0) end.right_deg = std::min(end.right_deg, own_deg);
    }
  }
  if (!end.below && !end.sideways) return std::nullopt;
  return end;
}

std::string SourceEnd::text() const {
  return beam_name(function) + " " + file + ": " + end.text();
}

std::vector<SourceEnd> table_ends(const std::vector<DesignConfig>& designs, const LampTables& tables,
                                  std::span<const ChannelConfig> channels) {
  std::vector<SourceEnd> ends;
  // The lamp across the car ends at the same angles: looked at once.
  std::map<std::tuple<const IntensityTable*, double, double, double, double, double, double, double>,
           std::optional<TableEnd>>
      known;
  for (const DesignConfig& design : designs) {
    std::set<std::string> told;
    for (const LampConfig& lamp : design.lamps) {
      for (const SourceConfig& source : lamp.sources) {
        const AimedSource light = tables.aimed(source);
        const glm::dvec3& at = lamp.position_m;
        auto [found, fresh] = known.try_emplace({light.table, light.scale, std::abs(source.yaw_rad), source.pitch_rad,
                                                 std::abs(source.roll_rad), at.x, std::abs(at.y), at.z});
        if (fresh) found->second = table_end(*light.table, light.car_from_lamp, light.scale, at, channels);
        const std::optional<TableEnd>& end = found->second;
        if (!end) continue;
        SourceEnd of_source{design.name, lamp.name, source.file.filename().string(), source.function, *end};
        if (told.insert(of_source.text()).second) ends.push_back(std::move(of_source));
      }
    }
  }
  return ends;
}

}  // namespace phare
