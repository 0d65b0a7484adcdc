// The program checks itself: pixels of a frame recomputed in float64.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "visual/process/frame_stats.h"
#include "visual/process/lamps.h"

namespace phare {

/// What a level of the picture states of itself. At a point lit with E lx an audited pixel is off by at most
///   relative · max(E, kDim_lx) + of_peak · Σ peak·cos(q)/r² + what E changes by within kDirection of there
/// where the sum goes over the lamps, and the last term is the room that float32 has: where light ends or changes
/// steeply, and where it grazes, a rounding of the direction is much light. Where the device has put the pixel's place
/// off the triangle that is seen there, the room is kOffPlane times as far as that, if that is farther: of triangles
/// that pass close by the eye it interpolates a place, and all that the light comes from, with less than float32 has.
/// The same for the normal, AuditSample::normal_room_rad, where surfaces turn by much from pixel to pixel.
struct AuditBound {
  /// Of a direction and of a place relative to its distance: eight roundings of float32, which the shader's angles and
  /// the way from the lamp take (docs/accuracy.md).
  static constexpr double kDirection = 8.0 * 5.9604644775390625e-08;

  static constexpr double kOffPlane = 4.0;  ///< other varyings are off as the place is, each by its own roundings

  std::string level;       ///< in words
  double relative = 0.0;   ///< of the light there
  double of_peak = 0.0;    ///< of the light that the lamps' peaks would be there
  bool by_level = true;    ///< what the level says; else what the user asks for
  bool resampled = false;  ///< holds where tables of different aims are summed too

  std::string text() const;
};

/// Nothing: by vertex it is the size of the triangles that bounds the error, and no number of the level.
std::optional<AuditBound> audit_bound(ImageLevel image, Method method);
/// The same, or what the user asks for in its place.
std::optional<AuditBound> audit_bound(ImageLevel image, Method method, std::optional<double> relative);

/// A pixel that is off by more than its level states.
struct AuditFailure {
  std::int64_t frame = 0;
  double time_s = 0.0;
  int x_px = 0, y_px = 0;  ///< in the picture, from its upper left corner
  MeasurePoint point{};
  std::string lamp{};  ///< whose light is off most
  double value_lx = 0.0, float64_lx = 0.0, bound_lx = 0.0;
  std::string level{};

  std::string text() const;
  nlohmann::json json() const;
};

/// Where and when a frame was audited, and what it is held to.
struct AuditMoment {
  std::int64_t frame = 0;
  double time_s = 0.0;
  int width_px = 0, height_px = 0;
  std::optional<AuditBound> bound{};
  glm::dvec3 eye_m{0.0};         ///< of the picture
  const Scene* scene = nullptr;  ///< that it shows; nothing: the places of samples are taken for exact
  /// Lux at a point lamp by lamp as the picture has them, in the order of lights_at(); asked for a failure only. None:
  /// another design shines by now, and which lamp is off is not told.
  std::function<std::vector<double>(const MeasurePoint&)> by_lamp{};
};

/// Residuals |GPU - float64| of audited pixels. The share is taken where float64 says more than 0.01 lx.
class AuditStats {
 public:
  static constexpr double kDim_lx = 0.01;

  void add(double gpu_lx, double reference_lx);
  /// Recomputes each sample from the native tables at this pose. The first that is off by more than its bound, ever.
  std::optional<AuditFailure> add(const Lamps& lamps, const VehicleState& pose, std::span<const AuditSample> samples,
                                  const AuditMoment& moment);

  std::uint64_t audits() const { return audits_; }
  const std::optional<AuditFailure>& failure() const { return first_; }
  /// For the overlay; empty before the first audit.
  std::string line() const;
  /// {"audits", "pixels", "residual_lx": {"max", "p99", "median"}, "residual_percent": {… where E > 0.01 lx},
  /// "bound", "over_bound", "worst_of_bound" (the largest residual as a share of its bound), "first_over"}
  nlohmann::json json() const;

 private:
  LogHistogram residual_lx_;
  LogHistogram residual_percent_;
  std::uint64_t audits_ = 0, judged_ = 0, over_ = 0;
  double worst_of_bound_ = 0.0;
  std::string bound_;
  std::optional<AuditFailure> first_;
};

}  // namespace phare
