#include "tools/cost/measure_settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <thread>

#include "config/base/commit.h"
#include "config/base/content_hash.h"
#include "config/road/lane.h"
#include "tools/cost/fog.h"
#include "tools/cost/ladder.h"
#include "tools/utc_now.h"
#include "visual/photometry/beam/image_levels.h"
#include "visual/process/cameras.h"
#include "visual/process/lamps.h"
#include "visual/renderer.h"
#include "visual/scene/refine.h"
#include "visual/scene/scene.h"

namespace phare::cost {
namespace {

int rounds_of(const SettingsPlan& plan) {
  return plan.quick ? 8 : 60;
}

constexpr double kDim_lx = 0.01;  // below, no share is taken

/// Where the car stands in turn: places of the lane, but its ends.
std::vector<VehicleState> places_of(const Rig& rig, std::size_t count) {
  std::vector<VehicleState> places;
  const Result<std::vector<LanePoint>> lane = read_lane(lane_file_of(rig.scene_file));
  for (std::size_t i = 0; i < count; ++i) {
    VehicleState& car = places.emplace_back();
    const double share_01 = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    if (!lane) {
      car.x_m = 20.0 + 100.0 * share_01;
      continue;
    }
    const LanePoint& at = (*lane)[static_cast<std::size_t>(share_01 * 0.9 * static_cast<double>(lane->size()))];
    car.x_m = at.x_m, car.y_m = at.y_m, car.z_m = at.z_m, car.yaw_rad = at.heading_rad;
  }
  return places;
}

/// A level as it is drawn, and what came of it.
struct Case {
  Renderer* renderer = nullptr;
  Method method = Method::kFragment;
  std::size_t shadows = 0;
  std::optional<std::size_t> fog{};
  SettingFigures* figures = nullptr;
  std::vector<double> times_ms{};
};

class Measuring {
 public:
  Measuring(const SettingsPlan& plan, const Scene& scene, Lamps& lamps) : plan_(plan), scene_(scene), lamps_(lamps) {
    CockpitState controls;
    controls.light_switch = LightSwitch::kLow;
    controls.design_index = static_cast<std::uint32_t>(plan.design);
    changes_ = lamps_.set_controls(controls);
    places_ = places_of(*plan.rig, plan.quick ? 8 : 30);
  }

  Result<SettingsTable> measure(const Validity& validity) {
    SettingsTable table{.validity = validity, .measured_at = utc_now(), .rounds = rounds_of(plan_)};
    for (const ImageLevel level : kImageLevels) table.light.push_back({Method::kFragment, level, {}});
    for (const Method method : {Method::kVertex, Method::kVertex1998})
      table.light.push_back({method, ImageLevel::kFloatNodes, {}});
    table.shadows.resize(kRayShadows);
    if (!plan_.air.clear()) table.fog.resize(kFogNames.size());
    if (const Status made = make_renderers(); !made) return made.error();
    if (!exact()->no_reference()) table.light.push_back({Method::kReference, ImageLevel::kFloatNodes, {}});

    std::vector<Case> cases;
    for (LightSetting& one : table.light)
      cases.push_back({.renderer = renderer_of(one.image), .method = one.method, .figures = &one.figures});
    for (std::size_t level = 0; level < table.shadows.size(); ++level)
      cases.push_back({.renderer = exact(), .shadows = level, .figures = &table.shadows[level]});
    for (std::size_t level = 0; level < table.fog.size(); ++level)
      cases.push_back({.renderer = exact(), .fog = level, .figures = &table.fog[level]});
    for (LightSetting& one : table.light) find_light_errors(one);
    find_shadow_errors(table.shadows);
    take_times(cases);
    if (!plan_.air.clear())
      if (const Status found = find_fog_errors(table.fog); !found) return found.error();
    return table;
  }

 private:
  Status make_renderers() {
    for (const ImageLevel level : kImageLevels) {
      plan_.progress("making " + level_name(level), 0.05 * static_cast<double>(renderers_.size()));
      Result<Renderer> made = Renderer::create({.width_px = plan_.width_px,
                                                .height_px = plan_.height_px,
                                                .samples = plan_.samples,
                                                .beam_level = level,
                                                .device_name = plan_.device_name});
      if (!made) return made.error();
      renderers_.push_back(std::make_unique<Renderer>(std::move(*made)));
      if (const Status loaded = renderers_.back()->load_scene(scene_); !loaded) return loaded.error();
      for (const Lamps::Change& change : changes_) renderers_.back()->set_beam(change.position, *change.image);
    }
    return Done{};
  }
  Renderer* renderer_of(ImageLevel level) {
    const auto at = std::ranges::find(kImageLevels, level) - std::begin(kImageLevels);
    return renderers_[static_cast<std::size_t>(at)].get();
  }
  Renderer* exact() { return renderer_of(ImageLevel::kFloatNodes); }

  FrameInput view(const VehicleState& car, const Case& one) const {
    FrameInput input;
    input.camera = driver_camera(plan_.rig->channels.front(), car);
    input.lamps = lamps_.placed(car);
    input.method = one.method;
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = one.shadows;
    if (one.fog) {
      input.effects[static_cast<std::size_t>(Effect::kFog)] = one.fog;
      input.air = plan_.air;
    }
    return input;
  }

  void find_light_errors(LightSetting& one) {
    plan_.progress("errors of light", 0.25);
    double off_lx = 0.0, all_lx = 0.0;
    std::vector<double> shares;
    for (const VehicleState& car : places_) {
      const FrameInput input = view(car, {.method = one.method});
      for (const AuditSample& sample : renderer_of(one.image)->audit(input, 400, 1)) {
        const double exact_lx = lamps_.illuminance_lx(car, sample.point);
        const double off = std::abs(sample.illuminance_lx - exact_lx);
        off_lx += off;
        all_lx += exact_lx;
        if (exact_lx >= kDim_lx) shares.push_back(off / exact_lx);
      }
    }
    one.figures.misplaced = all_lx > 0.0 ? off_lx / all_lx : 0.0;
    one.figures.p99 = errors_of(std::move(shares)).p99.value_or(0.0);
  }

  void find_shadow_errors(std::vector<SettingFigures>& levels) {
    std::vector<double> off_lx(levels.size());
    double all_lx = 0.0;
    for (const VehicleState& car : places_) {
      plan_.progress("rays for shadows", 0.35);
      const FrameInput input = view(car, {});
      std::vector<MeasurePoint> points;
      std::vector<double> exact_lx;
      for (const AuditSample& sample : exact()->audit(input, plan_.quick ? 60 : 200, 2)) {
        points.push_back(sample.point);
        exact_lx.push_back(lamps_.light_at(car, sample.point, scene_).lx);
        all_lx += exact_lx.back();
      }
      for (std::size_t level = 0; level < levels.size(); ++level) {
        const auto found = exact()->measure(input.lamps, points, level);
        for (std::size_t i = 0; i < points.size(); ++i) {
          double sum_lx = 0.0;
          for (const std::vector<float>& lamp : found) sum_lx += static_cast<double>(lamp[i]);
          off_lx[level] += std::abs(sum_lx - exact_lx[i]);
        }
      }
    }
    for (std::size_t level = 0; level < levels.size(); ++level)
      levels[level].misplaced = all_lx > 0.0 ? off_lx[level] / all_lx : 0.0;
  }

  /// The air's light on a wall of its own, under a lamp of its own: what the grid of a level is off by hangs little on
  /// which beam it is.
  Status find_fog_errors(std::vector<SettingFigures>& levels) {
    plan_.progress("fog against float64", 0.95);
    const SourceConfig* low = nullptr;
    for (const LampConfig& lamp : plan_.rig->designs[plan_.design].lamps)
      for (const SourceConfig& source : lamp.sources)
        if (source.function == LampFunction::kLow && low == nullptr) low = &source;
    if (low == nullptr) return Done{};
    LampTables tables;
    if (const Status read = tables.add(*low); !read) return read.error();
    const std::vector<FogErrors> errors =
        fog_errors(*exact(), tables.of(*low), plan_.air, {plan_.width_px, plan_.height_px}, plan_.width_px / 16);
    for (std::size_t level = 0; level < std::min(errors.size(), levels.size()); ++level)
      levels[level].misplaced = errors[level].misplaced;
    return Done{};
  }

  void take_times(std::vector<Case>& cases) {
    const int rounds = rounds_of(plan_);
    for (int round = 0; round < rounds; ++round) {
      plan_.progress("frames, round " + std::to_string(round + 1) + " of " + std::to_string(rounds),
                     0.4 + 0.55 * round / rounds);
      const VehicleState& car = places_[static_cast<std::size_t>(round) % places_.size()];
      for (Case& one : cases) {
        const FrameInput input = view(car, one);
        one.renderer->draw(input);
        one.times_ms.push_back(one.renderer->draw(input).wall_ms);
      }
    }
    for (Case& one : cases) {
      const Times times = times_of(std::move(one.times_ms));
      one.figures->median_ms = times.median;
      one.figures->p95_ms = *times.p95;
      one.figures->within_ms = times.within.value_or(0.0);
    }
  }

  const SettingsPlan& plan_;
  const Scene& scene_;
  Lamps& lamps_;
  std::vector<Lamps::Change> changes_;
  std::vector<VehicleState> places_;
  std::vector<std::unique_ptr<Renderer>> renderers_;
};

}  // namespace

Result<Validity> validity_of(const SettingsPlan& plan) {
  const Result<Renderer> device = Renderer::create({.width_px = 64, .height_px = 64, .device_name = plan.device_name});
  if (!device) return device.error();
  Validity validity{
      .device = device->device() + ", " + std::to_string(std::thread::hardware_concurrency()) + " processors",
      .version = std::string(PHARE_VERSION) + ", commit " + build_commit()};
  const Result<std::string> scene = scene_hash(plan.rig->scene_file);
  if (!scene) return scene.error();
  std::string of = *scene;
  LampTables tables;
  of += " design " + std::to_string(plan.design);
  for (const DesignConfig& design : plan.rig->designs) {
    of += " design";
    for (const LampConfig& lamp : design.lamps) {
      of += " lamp";
      for (int axis = 0; axis < 3; ++axis) of += " " + std::to_string(lamp.position_m[axis]);
      for (const SourceConfig& source : lamp.sources) {
        if (const Status read = tables.add(source); !read) return read.error();
        const AimedSource aimed = tables.aimed(source);
        of += " " + std::to_string(static_cast<int>(source.function)) + " " + aimed.table->content_hash + " " +
              std::to_string(aimed.scale);
        for (int column = 0; column < 3; ++column)
          for (int row = 0; row < 3; ++row) of += " " + std::to_string(aimed.car_from_lamp[column][row]);
      }
    }
  }
  const ChannelConfig& eye = plan.rig->channels.front();
  for (const double value : {eye.eye_m.x, eye.eye_m.y, eye.eye_m.z, eye.yaw_rad, eye.pitch_rad, eye.fov_horizontal_rad})
    of += " " + std::to_string(value);
  validity.rig = content_hash(std::as_bytes(std::span(of)));
  validity.picture = std::to_string(plan.width_px) + "x" + std::to_string(plan.height_px) + ", " +
                     std::to_string(plan.samples) + (plan.samples == 1 ? " sample a pixel, " : " samples a pixel, ") +
                     words_of(plan.air);
  if (plan.road_cuts > 0) validity.picture += ", road cut " + std::to_string(plan.road_cuts) + " times";
  return validity;
}

Result<SettingsTable> measure_settings(const SettingsPlan& plan) {
  const Result<Validity> validity = validity_of(plan);
  if (!validity) return validity.error();
  Result<Scene> scene = read_scene(plan.rig->scene_file);
  if (!scene) return scene.error();
  if (plan.road_cuts > 0) scene = refined(*scene, plan.road_cuts, is_ground);
  Result<Lamps> lamps = Lamps::load(*plan.rig);
  if (!lamps) return lamps.error();
  return Measuring(plan, *scene, *lamps).measure(*validity);
}

}  // namespace phare::cost
