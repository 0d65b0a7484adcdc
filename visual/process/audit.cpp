#include "visual/process/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "visual/photometry/beam/image_levels.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

/// How far the place that the device gave a pixel is from the plane of the triangle that is seen there, m. Nothing
/// where that is another one: a far mesh has triangles of its own.
double off_plane_m(const MeasurePoint& point, const AuditMoment& moment) {
  if (moment.scene == nullptr) return 0.0;
  const glm::dvec3 way = point.position_m - moment.eye_m;
  const double far_m = glm::length(way);
  if (!(far_m > 0.0)) return 0.0;
  const auto hit = ray_hit(*moment.scene, moment.eye_m, way / far_m, 0.0, 2.0 * far_m);
  constexpr double kSame = 1e-4;  // of the distance: two triangles that are not one lie farther apart
  if (!hit || std::abs(hit->distance_m - far_m) > kSame * far_m) return 0.0;
  return std::abs(glm::dot(hit->normal, way) * (1.0 - hit->distance_m / far_m));
}

/// What the light at a point changes by within `room_m` of it.
double spread_lx(const Lamps& lamps, const VehicleState& pose, const MeasurePoint& point, double exact_lx,
                 double room_m) {
  double spread = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      MeasurePoint near = point;
      near.position_m[axis] += sign * room_m;
      spread = std::max(spread, std::abs(lamps.illuminance_lx(pose, near) - exact_lx));
    }
  return spread;
}

/// The lamp whose light differs most between the picture and float64.
std::string lamp_most_off(const std::vector<PointLight>& lights, const std::vector<double>& by_picture) {
  std::string name;
  double most = -1.0;
  for (std::size_t lamp = 0; lamp < lights.size() && lamp < by_picture.size(); ++lamp) {
    const double off = std::abs(by_picture[lamp] - lights[lamp].surface_lx);
    if (off > most) most = off, name = lights[lamp].lamp;
  }
  return name;
}

}  // namespace

std::string AuditBound::text() const {
  std::string text = level + ":";
  if (relative > 0.0) text += fmt::format(" {:.3g} % of the light there", 100.0 * relative);
  if (of_peak > 0.0)
    text += fmt::format("{} {:.3g} % of what the peak would be there", relative > 0.0 ? " and" : "", 100.0 * of_peak);
  return text;
}

std::optional<AuditBound> audit_bound(ImageLevel image, Method method) {
  // Float64 on the table's own nodes, whatever the level of the image: candela, lux and their sum as float32.
  if (method == Method::kReference) return AuditBound{.level = "reference", .relative = 1e-6};
  if (method != Method::kFragment) return std::nullopt;
  AuditBound bound{.level = level_name(image)};
  switch (image) {
    // A filter between even texels loses the cut-off between two of them: 4.7 % of the peak on the walls of the
    // reference set, 7.3 % of low_rht.ies (docs/accuracy.md, "The ladder of beam images").
    case ImageLevel::kNormalised8:
    case ImageLevel::kHalfEven:
      bound.of_peak = 0.1;
      bound.resampled = true;
      break;
    // Half a step of a 16-bit float, 2^-12 up to 2^-11 of the node, and what float32 adds.
    case ImageLevel::kHalfNodes:
      bound.relative = 6e-4;
      break;
    // 4.4e-6 at worst over the reference set, 1.1e-5 on a slope under a steep cut-off (docs/accuracy.md).
    case ImageLevel::kFloatNodes:
      bound.relative = 2e-5;
      break;
  }
  return bound;
}

std::optional<AuditBound> audit_bound(ImageLevel image, Method method, std::optional<double> relative) {
  if (!relative) return audit_bound(image, method);
  const std::string by =
      method == Method::kFragment ? "" : std::string(kMethodNames[static_cast<std::size_t>(method)]) + ", ";
  return AuditBound{
      .level = by + level_name(image) + " as asked for", .relative = *relative, .by_level = false, .resampled = true};
}

std::string AuditFailure::text() const {
  return fmt::format(
      "frame {} ({:.2f} s), pixel ({}, {}) at ({:.2f}, {:.2f}, {:.2f}) m: {:.6g} lx, float64 {:.6g} lx{}; "
      "off by {:.3g} lx, {} allows {:.3g} lx",
      frame, time_s, x_px, y_px, point.position_m.x, point.position_m.y, point.position_m.z, value_lx, float64_lx,
      lamp.empty() ? "" : ", most from " + lamp, std::abs(value_lx - float64_lx), level, bound_lx);
}

nlohmann::json AuditFailure::json() const {
  return {{"frame", frame},
          {"time_s", time_s},
          {"pixel", {x_px, y_px}},
          {"position_m", {point.position_m.x, point.position_m.y, point.position_m.z}},
          {"lamp", lamp},
          {"value_lx", value_lx},
          {"float64_lx", float64_lx},
          {"bound_lx", bound_lx},
          {"text", text()}};
}

void AuditStats::add(double gpu_lx, double reference_lx) {
  const double off_lx = std::abs(gpu_lx - reference_lx);
  const double residual_lx = std::isnan(off_lx) ? std::numeric_limits<double>::infinity() : off_lx;
  residual_lx_.add(residual_lx);
  if (reference_lx > kDim_lx) residual_percent_.add(100.0 * residual_lx / reference_lx);
}

std::optional<AuditFailure> AuditStats::add(const Lamps& lamps, const VehicleState& pose,
                                            std::span<const AuditSample> samples, const AuditMoment& moment) {
  ++audits_;
  bool found = false;
  bound_ = moment.bound ? moment.bound->text() : "";
  const std::vector<double> peaks_cd = moment.bound ? lamps.peaks_cd() : std::vector<double>{};
  for (const AuditSample& sample : samples) {
    const double exact_lx = lamps.illuminance_lx(pose, sample.point);
    add(sample.illuminance_lx, exact_lx);
    if (!moment.bound) continue;
    const std::vector<PointLight> lights = lamps.lights_at(pose, sample.point);
    double peaks_lx = 0.0, far_m = 0.0, facing_lx = 0.0;
    bool resampled = false;
    for (std::size_t lamp = 0; lamp < lights.size(); ++lamp) {
      const PointLight& light = lights[lamp];
      if (!light.lit) continue;
      const glm::dvec3 way = sample.point.position_m - light.lamp_m;
      const double r_m = glm::length(way);
      peaks_lx += peaks_cd[lamp] * std::max(0.0, -glm::dot(way, sample.point.normal)) / (r_m * r_m * r_m);
      facing_lx += light.candela / (r_m * r_m);
      far_m = std::max(far_m, r_m);
      resampled = resampled || light.resampled;
    }
    // Sums on another grid than the tables' state nothing yet.
    if (resampled && !moment.bound->resampled) continue;
    ++judged_;
    const double room_m =
        std::max(AuditBound::kDirection * far_m, AuditBound::kOffPlane * off_plane_m(sample.point, moment));
    const double bound_lx = moment.bound->relative * std::max(exact_lx, kDim_lx) + moment.bound->of_peak * peaks_lx +
                            spread_lx(lamps, pose, sample.point, exact_lx, room_m) + facing_lx * sample.normal_room_rad;
    const double off_lx = std::abs(sample.illuminance_lx - exact_lx);
    worst_of_bound_ = std::max(worst_of_bound_, off_lx / bound_lx);
    if (off_lx <= bound_lx) continue;  // what is no number is not within it
    if (++over_ > 1) continue;
    first_ = AuditFailure{.frame = moment.frame,
                          .time_s = moment.time_s,
                          .x_px = static_cast<int>(sample.x_01 * moment.width_px),
                          .y_px = static_cast<int>(sample.y_01 * moment.height_px),
                          .point = sample.point,
                          .value_lx = sample.illuminance_lx,
                          .float64_lx = exact_lx,
                          .bound_lx = bound_lx,
                          .level = moment.bound->level};
    if (moment.by_lamp) first_->lamp = lamp_most_off(lights, moment.by_lamp(sample.point));
    found = true;
  }
  return found ? first_ : std::nullopt;
}

std::string AuditStats::line() const {
  if (audits_ == 0) return {};
  std::string line = fmt::format("self-audit: {} pixels in float64, at most {:.2g} % off", residual_lx_.count(),
                                 residual_percent_.max());
  if (judged_ > 0) line += fmt::format(", {:.0f} % of what the level states", 100.0 * worst_of_bound_);
  return line;
}

nlohmann::json AuditStats::json() const {
  const auto brief = [](const LogHistogram& residual) -> nlohmann::json {
    return {{"pixels", residual.count()},
            {"max", residual.max()},
            {"p99", residual.percentile(0.99)},
            {"median", residual.percentile(0.5)}};
  };
  nlohmann::json json{{"audits", audits_},
                      {"pixels", residual_lx_.count()},
                      {"residual_lx", brief(residual_lx_)},
                      {"residual_percent", brief(residual_percent_)},
                      {"judged", judged_},
                      {"over_bound", over_}};
  if (!bound_.empty()) json["bound"] = bound_;
  if (judged_ > 0) json["worst_of_bound"] = worst_of_bound_;
  if (first_) json["first_over"] = first_->json();
  return json;
}

}  // namespace phare
