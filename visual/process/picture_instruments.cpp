#include "visual/process/picture_instruments.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "visual/process/versus.h"
#include "visual/scene/ray_hit.h"

namespace phare {

PictureInstruments::PictureInstruments(const Desk& desk, const Lamps& lamps, const World& world, RoadLine road,
                                       ProbeLog log, const FixedLight* fixed)
    : desk_(desk), lamps_(lamps), world_(world), fixed_(fixed), road_(std::move(road)), log_(std::move(log)) {}

Result<MeasurePoint> PictureInstruments::point() const {
  if (!desk_.point) return Error{"point", "none is chosen"};
  if (desk_.point->frame != Probe::Frame::kPicture) {
    const auto at = placed(*desk_.point, moment_.car, road_);
    return at ? Result<MeasurePoint>(*at) : Error{"point", "the scene has no lane"};
  }
  const auto hit = seen_at(desk_.point->position_m.x, desk_.point->position_m.y);
  return hit ? Result<MeasurePoint>(*hit) : Error{"point", "the picture shows nothing of the scene there"};
}

Result<PointReading> PictureInstruments::read() const {
  const auto at = point();
  if (!at) return at.error();
  ++work_;
  return read_point(lamps_, moment_.car, *at, moment_.picture->camera.eye_m, world_, road_, desk_.shadows != 0,
                    desk_.fixed_light == std::size_t{0} ? nullptr : fixed_,
                    desk_.snow_cover_drawn == std::size_t{0} ? 0.0 : desk_.snow_cover_01);
}

std::vector<std::string> PictureInstruments::lines() const {
  std::vector<std::string> lines;
  if (desk_.point) {
    const auto reading = read();
    lines = reading ? lines_of(*reading) : std::vector{reading.error().text()};
  }
  if (desk_.reach) {
    ++work_;
    lines.push_back(reach_line(reach_of(lamps_, moment_.car, road_)));
  }
  return lines;
}

std::string PictureInstruments::answer() const {
  if (!desk_.point) return {};
  const auto reading = read();
  std::string text;
  for (const std::string& line : reading ? lines_of(*reading) : std::vector{reading.error().text()})
    text += "\n" + line;
  return text;
}

OverlayMarks PictureInstruments::marks(bool anew, const Desk& shown) {
  OverlayMarks picture;
  const bool photo = shown.view != View::kFalseColour;
  const Camera& camera = moment_.picture->camera;
  const PicturePart& part = moment_.picture->part;
  const ViewGeometry view(camera, moment_.aspect * part.width_01 / part.height_01);
  const auto seen = [&](RoadMarks marks) {
    const bool from_above = camera.orthographic_width_m > 0.0;
    return from_above ? marks : seen_marks(std::move(marks), camera.eye_m, road_);
  };
  // Lines of the road do not lie on a wall that stands on it.
  if (desk_.grid_m > 0.0 && !moment_.wall) {
    ++work_;
    draw_marks(picture, beside_own_car(seen(grid_marks(moment_.car, road_, desk_.grid_m))), view);
  }
  if (desk_.isolux && photo && !moment_.wall) {
    ++work_;
    if (anew || isolux_.lines.empty()) isolux_ = seen(isolux_marks(lamps_, moment_.car, road_, desk_.isolux_lx));
    OverlayMarks lines;
    draw_marks(lines, beside_own_car(isolux_), view, picture.labels);
    keep_to_a(lines, shown, lamps_, moment_.time);
    picture.lines.insert(picture.lines.end(), lines.lines.begin(), lines.lines.end());
    picture.labels.insert(picture.labels.end(), lines.labels.begin(), lines.labels.end());
  } else {
    isolux_ = {};
  }
  const bool by_difference = shown.compare == Compare::kDifference, by_ratio = shown.compare == Compare::kRatio;
  const bool compared = (by_difference || by_ratio) && versus_design(shown, lamps_);
  if (desk_.scale && compared) {
    ++work_;
    draw_versus_scale(picture, by_ratio ? VersusScale::kRatio : VersusScale::kDifference);
  } else if (desk_.scale && !photo) {
    ++work_;
    draw_scale(picture, desk_.isolux_lx);
  }
  if (desk_.point) {
    // A cross where it is.
    if (const auto at = point()) {
      RoadMarks cross;
      constexpr OverlayColour kInk{255, 110, 90};
      constexpr double kArm_m = 0.25;
      const glm::dvec3 p = at->position_m + 0.01 * at->normal;
      const glm::dvec3 side = std::abs(at->normal.z) > 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
      const glm::dvec3 a = glm::normalize(glm::cross(at->normal, side)), b = glm::cross(at->normal, a);
      cross.lines = {{{p - kArm_m * a, p + kArm_m * a}, kInk}, {{p - kArm_m * b, p + kArm_m * b}, kInk}};
      draw_marks(picture, cross, view);
    }
  }
  if (moment_.wall && desk_.lines) {
    ++work_;
    draw_marks(picture, wall_marks(*moment_.wall), view);
  }
  put_into(picture, part);
  plot(picture);
  return picture;
}

/// Without what the body of one's own car hides, seen from outside.
RoadMarks PictureInstruments::beside_own_car(RoadMarks marks) const {
  if (!moment_.own_car) return marks;
  static const Scene kNothing;
  World body(kNothing, *world_.meshes());
  body.move({*moment_.own_car});
  const Camera& camera = moment_.picture->camera;
  constexpr double kAbove_m = 50.0;  // parallel rays come from beyond the car
  return seen_marks(std::move(marks), [&](const glm::dvec3& point_m) {
    const bool parallel = camera.orthographic_width_m > 0.0;
    const glm::dvec3 from_m = parallel ? point_m - kAbove_m * camera.world_from_eye[0] : camera.eye_m;
    return occluder(body, from_m, point_m) != nullptr;
  });
}

double PictureInstruments::lux_at(const MeasurePoint& at) const {
  return desk_.shadows != 0 ? lamps_.light_at(moment_.car, at, world_).lx : lamps_.illuminance_lx(moment_.car, at);
}

std::vector<std::optional<double>> PictureInstruments::probes_lx() const {
  std::vector<std::optional<double>> lx;
  for (const Probe& probe : desk_.probes) {
    const auto at = placed(probe, moment_.car, road_);
    lx.push_back(at ? std::optional(lux_at(*at)) : std::nullopt);
  }
  return lx;
}

void PictureInstruments::plot(OverlayMarks& picture) {
  if (!desk_.plot) {
    plot_.clear();
    return;
  }
  if (plot_.due(moment_.time)) {
    ++work_;
    std::vector<std::optional<double>> lx = probes_lx();
    if (desk_.point) {
      const auto at = point();
      lx.push_back(at ? std::optional(lux_at(*at)) : std::nullopt);
    }
    plot_.add(moment_.time, std::move(lx));
  }
  plot_.draw(picture, desk_.probes.size());
}

bool PictureInstruments::log() {
  if ((desk_.probes.empty() && !desk_.reach) || !log_.due(moment_.time)) return true;
  ++work_;
  return log_.write({moment_.time, moment_.car, probes_lx(), reach_of(lamps_, moment_.car, road_)});
}

}  // namespace phare
