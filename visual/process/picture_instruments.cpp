#include "visual/process/picture_instruments.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "visual/process/pick.h"
#include "visual/process/versus.h"

namespace phare {

PictureInstruments::PictureInstruments(const Desk& desk, const Lamps& lamps, const World& world, RoadLine road,
                                       ProbeLog log)
    : desk_(desk), lamps_(lamps), world_(world), road_(std::move(road)), log_(std::move(log)) {}

Result<MeasurePoint> PictureInstruments::point() const {
  if (!desk_.point) return Error{"point", "none is chosen"};
  if (desk_.point->frame != Probe::Frame::kPicture) {
    const auto at = placed(*desk_.point, moment_.car, road_);
    return at ? Result<MeasurePoint>(*at) : Error{"point", "the scene has no lane"};
  }
  // The picture's shares as pixels of a fine picture of its shape.
  constexpr int kWide_px = 1'000'000;
  const int high_px = static_cast<int>(kWide_px / moment_.aspect);
  const ViewGeometry view(moment_.camera, moment_.aspect);
  const auto hit = pick(world_, view.ray_through(desk_.point->position_m.x * kWide_px - 0.5,
                                                 desk_.point->position_m.y * high_px - 0.5, kWide_px, high_px));
  return hit ? Result<MeasurePoint>(*hit) : Error{"point", "the picture shows nothing of the scene there"};
}

Result<PointReading> PictureInstruments::read() const {
  const auto at = point();
  if (!at) return at.error();
  ++work_;
  return read_point(lamps_, moment_.car, *at, moment_.camera.eye_m, world_, road_, desk_.shadows != 0);
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

OverlayMarks PictureInstruments::marks(bool anew) {
  OverlayMarks picture;
  const bool photo = desk_.view != View::kFalseColour;
  const ViewGeometry view(moment_.camera, moment_.aspect);
  const auto seen = [&](RoadMarks marks) {
    const bool from_above = moment_.camera.orthographic_width_m > 0.0;
    return from_above ? marks : seen_marks(std::move(marks), moment_.camera.eye_m, road_);
  };
  if (desk_.grid_m > 0.0) {
    ++work_;
    draw_marks(picture, seen(grid_marks(moment_.car, road_, desk_.grid_m)), view);
  }
  if (desk_.isolux && photo) {
    ++work_;
    if (anew || isolux_.lines.empty()) isolux_ = seen(isolux_marks(lamps_, moment_.car, road_, desk_.isolux_lx));
    OverlayMarks lines;
    draw_marks(lines, isolux_, view);
    keep_to_a(lines, desk_, lamps_, moment_.time);
    picture.lines.insert(picture.lines.end(), lines.lines.begin(), lines.lines.end());
    picture.labels.insert(picture.labels.end(), lines.labels.begin(), lines.labels.end());
  } else {
    isolux_ = {};
  }
  if (desk_.scale && !photo) {
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
  return picture;
}

bool PictureInstruments::log() {
  if ((desk_.probes.empty() && !desk_.reach) || !log_.due(moment_.time)) return true;
  ++work_;
  ProbeRow row{moment_.time, moment_.car, {}, {}};
  for (const Probe& probe : desk_.probes) {
    const auto at = placed(probe, moment_.car, road_);
    std::optional<double>& lx = row.probes_lx.emplace_back();
    if (at)
      lx = desk_.shadows != 0 ? lamps_.light_at(moment_.car, *at, world_).lx : lamps_.illuminance_lx(moment_.car, *at);
  }
  row.reach = reach_of(lamps_, moment_.car, road_);
  return log_.write(row);
}

}  // namespace phare
