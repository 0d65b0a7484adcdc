#include "visual/kept_casters.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "config/base/on_all_cores.h"

namespace phare {
namespace {

/// So much a number may change and it is the same: rounding of places in the world, m, far below what is seen.
constexpr double kSame = 1e-6;

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return x == y || std::abs(x - y) < kSame; });
}

void add(std::vector<double>& numbers, const glm::dvec3& v) {
  numbers.insert(numbers.end(), {v.x, v.y, v.z});
}

void add(std::vector<double>& numbers, const glm::dmat3& m) {
  for (int axis = 0; axis < 3; ++axis) add(numbers, m[axis]);
}

std::vector<double> source_of(const KeptCasters::Lamp& lamp, const CastersFor& wanted) {
  std::vector<double> numbers{static_cast<double>(lamp.beam), static_cast<double>(lamp.version),
                              lamp.reach.cone.half_angle_rad, wanted.far_from_m, wanted.faint_lx};
  add(numbers, lamp.reach.tip_m);
  add(numbers, lamp.reach.cone.axis);
  add(numbers, lamp.world_from_image);
  if (wanted.view == nullptr) return numbers;
  const Camera& camera = wanted.view->camera();
  numbers.insert(numbers.end(), {wanted.view->aspect(), camera.fov_horizontal_rad, camera.orthographic_width_m,
                                 camera.seen_from_01, camera.seen_to_01, camera.near_m, camera.far_m});
  add(numbers, camera.eye_m);
  add(numbers, camera.world_from_eye);
  return numbers;
}

std::vector<double> placed_of(const KeptCasters::Lamp& lamp, std::span<const PlacedMesh> moving) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (i == lamp.carried_by) {
      numbers.push_back(-1.0);
      continue;
    }
    numbers.push_back(static_cast<double>(moving[i].mesh));
    add(numbers, moving[i].position_m);
    add(numbers, moving[i].world_from_mesh);
  }
  return numbers;
}

}  // namespace

void KeptCasters::begin_frame() {
  kept_.resize(std::min(kept_.size(), asked_));
  asked_ = 0;
}

KeptCasters::Casts KeptCasters::find(const ShadowCasters& casters, std::span<const Lamp> lamps,
                                     std::span<const PlacedMesh> moving, const CastersFor& wanted) {
  const std::size_t first = std::exchange(asked_, asked_ + lamps.size());
  kept_.resize(std::max(kept_.size(), asked_));
  std::vector<Counts> looked(lamps.size());
  on_all_cores(lamps.size(), [&](std::size_t i) {
    const Lamp& lamp = lamps[i];
    Kept& kept = kept_[first + i];
    CastersFor by_lamp = wanted;
    by_lamp.peaks = lamp.peaks;
    const auto by = [&](std::span<const PlacedMesh> meshes) {
      return std::make_shared<const CastBy>(
          casters.by(lamp.reach, lamp.world_from_image, meshes, lamp.carried_by, by_lamp));
    };
    std::vector<double> source = source_of(lamp, wanted), placed = placed_of(lamp, moving);
    if (!same(kept.source, source)) {
      // It moves, most likely, and will have moved by the next frame: both at once.
      looked[i] = {1, 1};
      kept = {std::move(source), std::move(placed), nullptr, by(moving)};
      return;
    }
    if (same(kept.placed, placed)) return;
    if (!kept.standing) {
      looked[i].standing = 1;
      kept.standing = by({});
    }
    looked[i].moving = 1;
    by_lamp.standing = kept.standing.get();
    kept.placed = std::move(placed);
    kept.all = by(moving);
  });
  Casts casts;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    casts.push_back(kept_[first + i].all);
    counts_.standing += looked[i].standing, counts_.moving += looked[i].moving;
  }
  return casts;
}

}  // namespace phare
