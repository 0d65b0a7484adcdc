// The ladders of light, shadows, fog and exposure.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>

#include "tools/cost/fog.h"
#include "tools/cost/frame_clock.h"
#include "tools/cost/measure_ladders.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/image_levels.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/renderer.h"
#include "visual/scene/ray_hit.h"
#include "visual/scene/ray_tree.h"
#include "visual/scene/refine.h"
#include "visual/scene/scene.h"

namespace phare::cost {
namespace {

/// A driver's view on a straight along x, its lamps at `x_m`: lateral places of the shipped country road's right lane.
FrameInput view_at(double x_m, const LampOpening& opening) {
  FrameInput input;
  input.camera.eye_m = {x_m - 1.9, -1.2, 1.22};
  const glm::dmat3 aim = aim_rotation(0.0, -0.01, 0.0);
  for (const double y_m : {-1.0, -2.2})
    input.lamps.push_back({.position_m = {x_m, y_m, 0.65}, .world_from_image = aim, .opening = opening});
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  return input;
}

constexpr double kVisibility_m = 100.0;  // fog in which the beams are seen, and something of the road
constexpr std::array kPlaces_m{26.9, 60.0, 100.0};
// Behind trees, posts and a person on the verge.
constexpr std::array kShadowPlaces_m{26.9, 60.0, 168.0};
constexpr int kOpeningRings = 16;  // a straight edge is placed to half a ring: 3 % of the opening

double exact_lx(const IntensityTable& table, const PlacedLamp& lamp, const MeasurePoint& point) {
  return illuminance_lx(lamp.position_m, lamp.world_from_image, table, 1.0, point.position_m, point.normal);
}

/// A level as it is drawn.
struct Case {
  Level level;
  Renderer* renderer = nullptr;
  Method method = Method::kFragment;
  std::size_t shadows = 0;
  std::optional<std::size_t> fog{};  ///< with it the air is foggy
  bool hdr = false;                  ///< by way of the image in cd/m²
  LampOpening opening{};
  std::vector<double> times_ms{};

  FrameInput view(double x_m) const {
    FrameInput input = view_at(x_m, opening);
    input.method = method;
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = shadows;
    input.effects[static_cast<std::size_t>(Effect::kFog)] = fog;
    if (fog) input.air.visibility_m = kVisibility_m;
    input.effects[static_cast<std::size_t>(Effect::kHdrImage)] = hdr ? 1 : 0;
    return input;
  }
};

class Pictures {
 public:
  Pictures(const Plan& plan, const Scene& scene, const IntensityTable& table)
      : plan_(plan), scene_(scene), table_(table), opening_(stated_opening(table).value_or(LampOpening{})) {}

  Result<PictureLadders> measure() {
    std::vector<Case> light, shadows, lens, fog, exposure;
    if (const Status made = make_cases(light, shadows, lens, fog, exposure); !made) return made.error();
    PictureLadders ladders{
        .device = renderers_.front()->device(),
        .light = {.name = "light",
                  .what = "illuminance of a picture by two low beams, method, beam image and cuts of the ground",
                  .reference = "float64 at the pixels' own points",
                  .error_unit = "lx",
                  .time_unit = clock_.unit()},
        .shadows = {.name = "shadows",
                    .what = "what stands in the beams: levels of the shadow maps, and rays at every pixel",
                    .reference = "float64 with a ray to each lamp's middle, at points of the scene",
                    .error_unit = "lx",
                    .time_unit = clock_.unit()},
        .lens = {.name = "lens",
                 .what = "the same with the lamps as large as they are (" + opening_text(table_) +
                         "): light is hidden by as much as of the opening is",
                 .reference = "float64 with " + std::to_string(kOpeningRings * kOpeningRings) +
                              " rays over each lamp's opening, at points of the scene",
                 .error_unit = "lx",
                 .time_unit = clock_.unit()},
        .fog = {.name = "fog",
                .what = "light that fog of 100 m visibility scatters toward the eye: levels of its grid",
                .reference = "float64 quadrature along each line of sight, where there is 1 % of the brightest",
                .error_unit = "%",
                .time_unit = clock_.unit()},
        .exposure = {.name = "exposure",
                     .what = "from luminance to the picture: where exposure and tone curve are applied, and what image "
                             "holds cd/m² until then; there is one of 16-bit floats, and none of 32",
                     .reference = "the tone curve in the lit pass, float32 throughout",
                     .error_unit = "of 255",
                     .time_unit = clock_.unit()}};
    for (Case& one : light) find_light_errors(one);
    find_shadow_errors(shadows, lens);
    if (const Status found = find_fog_errors(fog); !found) return found.error();
    find_exposure_errors(exposure);
    const std::array all{&light, &shadows, &lens, &fog, &exposure};
    const std::array into{&ladders.light, &ladders.shadows, &ladders.lens, &ladders.fog, &ladders.exposure};
    time_turn_by_turn(all, lens, shadows);
    for (std::size_t k = 0; k < all.size(); ++k)
      for (Case& one : *all[k]) into[k]->levels.push_back(std::move(one.level));
    return ladders;
  }

 private:
  Result<Renderer*> renderer(const Scene& scene, ImageLevel level) {
    plan_.progress("making " + level_name(level), 0.05 * static_cast<double>(renderers_.size()) / 6.0);
    Result<Renderer> made =
        Renderer::create({.width_px = plan_.width_px, .height_px = plan_.height_px, .beam_level = level});
    if (!made) return made.error();
    renderers_.push_back(std::make_unique<Renderer>(std::move(*made)));
    Renderer& renderer = *renderers_.back();
    if (const Status loaded = renderer.load_scene(scene); !loaded) return loaded.error();
    const AimedSource source{.table = &table_};
    renderer.set_beam(0, compose_beam_image(std::span(&source, 1)));
    return &renderer;
  }

  void add_case(std::vector<Case>& to, Case one) {
    to.push_back(std::move(one));
    Renderer& with = *to.back().renderer;
    with.draw(to.back().view(kPlaces_m[0]));
    to.back().level.memory_bytes = with.device_memory_bytes();
  }

  Status make_light_cases(std::vector<Case>& light, Renderer& exact) {
    const auto add = [&](const std::string& name, Renderer& with, Method method) {
      add_case(light, {.level = {.name = name}, .renderer = &with, .method = method});
    };
    const auto method_name = [](Method method) { return std::string(kMethodNames[static_cast<std::size_t>(method)]); };
    for (const ImageLevel level : kImageLevels) {
      const Result<Renderer*> made = level == ImageLevel::kFloatNodes ? &exact : renderer(scene_, level);
      if (!made) return made.error();
      add("fragment, " + level_name(level), **made, Method::kFragment);
    }
    if (!exact.no_reference()) add(method_name(Method::kReference), exact, Method::kReference);
    for (int cuts = 0; cuts <= (plan_.quick ? 1 : 2); ++cuts) {
      Renderer* with = &exact;
      if (cuts > 0) {
        const Result<Renderer*> made = renderer(refined(scene_, cuts, is_ground), ImageLevel::kFloatNodes);
        if (!made) return made.error();
        with = *made;
      }
      for (const Method method : {Method::kVertex, Method::kVertex1998})
        add(method_name(method) + ", ground cut " + std::to_string(cuts) + " times", *with, method);
    }
    return Done{};
  }

  Status make_cases(std::vector<Case>& light, std::vector<Case>& shadows, std::vector<Case>& lens,
                    std::vector<Case>& fog, std::vector<Case>& exposure) {
    const Result<Renderer*> made = renderer(scene_, ImageLevel::kFloatNodes);
    if (!made) return made.error();
    Renderer* const exact = *made;
    if (plan_.wanted("light"))
      if (const Status done = make_light_cases(light, *exact); !done) return done.error();
    const auto add_shadows = [&](std::vector<Case>& to, std::size_t last) {
      for (std::size_t level = 0; level <= last; ++level)
        add_case(to, {.level = {.name = std::string(kShadowNames[level])},
                      .renderer = exact,
                      .shadows = level,
                      .opening = opening_});
    };
    // A soft edge is no approximation of a hard one.
    if (plan_.wanted("shadows")) add_shadows(shadows, kRayShadows);
    if (plan_.wanted("lens")) add_shadows(lens, kShadowNames.size() - 1);
    const EffectRow& row = effect_table()[static_cast<std::size_t>(Effect::kFog)];
    for (std::size_t level = 0; plan_.wanted("fog") && level < row.levels.size(); ++level)
      add_case(fog, {.level = {.name = std::string(row.levels[level])}, .renderer = exact, .fog = level});
    if (!plan_.wanted("exposure")) return Done{};
    for (const bool hdr : {false, true})
      add_case(exposure,
               {.level = {.name = hdr ? "16-bit float image, then the tone curve" : "in the lit pass, no image"},
                .renderer = exact,
                .hdr = hdr});
    return Done{};
  }

  std::size_t samples() const { return plan_.quick ? 600 : 6000; }

  void find_light_errors(Case& one) {
    plan_.progress("errors of " + one.level.name, 0.1);
    std::vector<double> differences;
    std::size_t lit = 0, within = 0;
    for (const double x_m : kPlaces_m) {
      const FrameInput input = one.view(x_m);
      for (const AuditSample& sample : one.renderer->audit(input, samples(), plan_.seed)) {
        double exact = 0.0;
        for (const PlacedLamp& lamp : input.lamps) exact += exact_lx(table_, lamp, sample.point);
        differences.push_back(sample.illuminance_lx - exact);
        if (exact < kDim_lx) continue;
        ++lit;
        within += std::abs(differences.back()) <= 0.01 * exact ? 1u : 0u;
      }
    }
    one.level.error = errors_of(std::move(differences));
    char note[64];
    std::snprintf(note, sizeof note, "within 1 %%: %.1f %% of lit pixels",
                  lit == 0 ? 0.0 : 100.0 * static_cast<double>(within) / static_cast<double>(lit));
    one.level.note = note;
  }

  /// Share of the lamp's opening that the point sees, over places that stand for equal shares: rings of an ellipse,
  /// or rows of a rectangle. The tree knows no holes; where the scene has some, the slow way.
  double seen_share(const RayTree& tree, bool holes, const PlacedLamp& lamp, const glm::dvec3& point_m) const {
    int seen = 0;
    for (int ring = 0; ring < kOpeningRings; ++ring)
      for (int step = 0; step < kOpeningRings; ++step) {
        glm::dvec2 part(2.0 * (ring + 0.5) / kOpeningRings - 1.0, 2.0 * (step + 0.5) / kOpeningRings - 1.0);
        if (lamp.opening.round) {
          const double turn = 2.0 * std::numbers::pi * (step + 0.5 + 0.5 * (ring % 2)) / kOpeningRings;
          part = std::sqrt((ring + 0.5) / kOpeningRings) * glm::dvec2(std::cos(turn), std::sin(turn));
        }
        const glm::dvec3 place_m =
            lamp.position_m + 0.5 * (lamp.opening.width_m * part.x * lamp.world_from_image[1] +
                                     lamp.opening.height_m * part.y * lamp.world_from_image[2]);
        const bool blocked =
            holes ? occluder(scene_, place_m, point_m) != nullptr : tree.blocked(point_m, place_m, 1e-3, 1e-3);
        seen += blocked ? 0 : 1;
      }
    return static_cast<double>(seen) / (kOpeningRings * kOpeningRings);
  }

  void find_shadow_errors(std::vector<Case>& shadows, std::vector<Case>& lens) {
    const std::size_t levels = std::max(shadows.size(), lens.size());
    if (levels == 0) return;
    Renderer& renderer = *(lens.empty() ? shadows : lens).front().renderer;
    const RayTree tree(scene_);
    const bool holes = std::ranges::any_of(
        scene_.materials, [](const SceneMaterial& material) { return material.look.cut_below.has_value(); });
    std::vector<std::vector<double>> of_middle(levels), of_opening(levels);
    std::vector<std::size_t> wrong(levels);
    std::size_t decisions = 0, within_edges = 0;
    for (const double x_m : kShadowPlaces_m) {
      plan_.progress("rays for shadows", 0.2);
      FrameInput input = view_at(x_m, opening_);
      input.far_mesh_from_m = std::numeric_limits<double>::infinity();
      std::vector<MeasurePoint> points;
      for (const AuditSample& sample : renderer.audit(input, samples() / 2, plan_.seed + 1))
        points.push_back(sample.point);
      const std::size_t lamps = input.lamps.size();
      std::vector<std::vector<double>> unhidden(lamps), middle(lamps), opening(lamps);
      for (std::size_t lamp = 0; lamp < lamps; ++lamp)
        for (const MeasurePoint& point : points) {
          const double lx = exact_lx(table_, input.lamps[lamp], point);
          const bool hidden = lx > 0.0 && occluder(scene_, input.lamps[lamp].position_m, point.position_m) != nullptr;
          const double share =
              lx > 0.0 && !lens.empty() ? seen_share(tree, holes, input.lamps[lamp], point.position_m) : 0.0;
          unhidden[lamp].push_back(lx);
          middle[lamp].push_back(hidden ? 0.0 : lx);
          opening[lamp].push_back(share * lx);
          within_edges += share > 0.0 && share < 1.0 ? 1u : 0u;
        }
      for (std::size_t k = 0; k < levels; ++k) {
        const std::vector<std::vector<float>> found = renderer.measure(input.lamps, points, k);
        for (std::size_t i = 0; i < points.size(); ++i) {
          double off_middle = 0.0, off_opening = 0.0;
          for (std::size_t lamp = 0; lamp < lamps; ++lamp) {
            const double lx = static_cast<double>(found[lamp][i]);
            off_middle += lx - middle[lamp][i];
            off_opening += lx - opening[lamp][i];
            if (unhidden[lamp][i] < kDim_lx) continue;
            decisions += k == 0 ? 1u : 0u;
            wrong[k] += (lx > 0.5 * unhidden[lamp][i]) != (middle[lamp][i] > 0.0) ? 1u : 0u;
          }
          of_middle[k].push_back(off_middle);
          of_opening[k].push_back(off_opening);
        }
      }
    }
    for (std::size_t k = 0; k < lens.size(); ++k) {
      lens[k].level.error = errors_of(std::move(of_opening[k]));
      lens[k].level.note = "points that see a part of an opening: " + std::to_string(within_edges);
    }
    for (std::size_t k = 0; k < shadows.size(); ++k) {
      shadows[k].level.error = errors_of(std::move(of_middle[k]));
      shadows[k].level.note = "lit or dark wrong: " + std::to_string(wrong[k]) + " of " + std::to_string(decisions);
    }
  }

  /// In a renderer of its own: it loads another scene.
  Status find_fog_errors(std::vector<Case>& cases) {
    if (cases.empty()) return Done{};
    plan_.progress("fog against float64", 0.22);
    Result<Renderer> made = Renderer::create({.width_px = plan_.width_px, .height_px = plan_.height_px});
    if (!made) return made.error();
    std::vector<FogErrors> errors =
        fog_errors(*made, table_, {.visibility_m = kVisibility_m}, {plan_.width_px, plan_.height_px},
                   plan_.width_px / (plan_.quick ? 16 : 60));
    for (std::size_t level = 0; level < std::min(errors.size(), cases.size()); ++level) {
      char note[64];
      std::snprintf(note, sizeof note, "of the fog's light misplaced: %.2g %%", 100.0 * errors[level].misplaced);
      for (double& difference : errors[level].differences) difference *= 100.0;
      cases[level].level.error = errors_of(std::move(errors[level].differences));
      cases[level].level.note = note;
    }
    return Done{};
  }

  void find_exposure_errors(std::vector<Case>& cases) {
    if (cases.empty()) return;
    plan_.progress("exposure", 0.25);
    std::vector<std::vector<double>> differences(cases.size());
    for (const double x_m : kPlaces_m) {
      Image8 truth;
      for (std::size_t k = 0; k < cases.size(); ++k) {
        FrameInput input = cases[k].view(x_m);
        input.want_image = true;
        cases[k].renderer->draw(input);
        const Image8 seen = cases[k].renderer->read_image();
        if (k == 0) truth = seen;
        for (std::size_t i = 0; i < seen.rgba.size(); ++i)
          if (i % 4 != 3)
            differences[k].push_back(static_cast<double>(seen.rgba[i]) - static_cast<double>(truth.rgba[i]));
      }
    }
    for (std::size_t k = 0; k < cases.size(); ++k) cases[k].level.error = errors_of(std::move(differences[k]));
  }

  void time_turn_by_turn(std::span<std::vector<Case>* const> all, const std::vector<Case>& lens,
                         std::vector<Case>& shadows) {
    const int rounds = plan_.quick ? 7 : 60;
    for (int round = 0; round < rounds; ++round) {
      plan_.progress("frames, round " + std::to_string(round + 1) + " of " + std::to_string(rounds),
                     0.3 + 0.7 * round / rounds);
      const double x_m = kPlaces_m[0] + 0.1 * (round % 64);
      for (std::vector<Case>* cases : all)
        for (Case& one : *cases) {
          // Rays take as long as dozens of others: every tenth round, in one ladder, and beside them nothing is warmed up.
          const bool by_rays = one.shadows >= kRayShadows;
          if (by_rays && (round % 10 != 0 || (cases == &shadows && !lens.empty()))) continue;
          const FrameInput input = one.view(x_m);
          // What another ladder held is given up by the second frame without it: 132 MB of fog took 10 ms.
          if (&one == &cases->front()) one.renderer->draw(input);
          if (!by_rays || !clock_.on_processor()) one.renderer->draw(input);
          one.times_ms.push_back(clock_.draw_ms(*one.renderer, input));
        }
    }
    for (std::size_t level = kRayShadows; level < std::min(shadows.size(), lens.size()); ++level)
      shadows[level].times_ms = lens[level].times_ms;
    for (std::vector<Case>* cases : all)
      for (Case& one : *cases) one.level.time = times_of(std::move(one.times_ms));
  }

  static constexpr double kDim_lx = 0.01;  // below, nothing is called wrong

  const Plan& plan_;
  const Scene& scene_;
  const IntensityTable& table_;
  const LampOpening opening_;
  std::vector<std::unique_ptr<Renderer>> renderers_;
  const FrameClock clock_;
};

}  // namespace

Result<PictureLadders> picture_ladders(const Plan& plan) {
  const Result<Scene> scene = read_scene(plan.scene_file);
  if (!scene) return scene.error();
  const Result<IntensityTable> table = read_lamp(plan.lamp_file, {});
  if (!table) return table.error();
  return Pictures(plan, *scene, *table).measure();
}

}  // namespace phare::cost
