// Views of the lit scene: which lamps light what a view sees, and the data that its draws read.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "config/base/on_all_cores.h"
#include "visual/lit_scene.h"

namespace phare {

LitView LitScene::view(const ViewGeometry& geometry, const Sky& sky, std::span<const PlacedLamp> lamps,
                       std::span<const PlacedMesh> moving, double far_mesh_from_m, std::span<const double> isolux_lx,
                       bool few_kinds) {
  LitView view{.geometry = geometry, .sky = sky, .isolux_lx = isolux_lx, .few_kinds = few_kinds};
  std::optional<Horizon> horizon;
  if (std::isfinite(far_mesh_from_m) && geometry.camera().orthographic_width_m <= 0.0)
    horizon.emplace(geometry_.ground, geometry.camera().eye_m);
  Horizon* hides = horizon ? &*horizon : nullptr;
  view.items = geometry_.visible(geometry, far_mesh_from_m, hides);
  view.moving = moving;
  if (!moving.empty()) geometry_.add_visible(view.items, view.moved, geometry, moving, far_mesh_from_m, hides);
  std::vector<bool> reached;
  std::vector<PlacedLamp> bright;
  std::vector<std::size_t> in_air_of;
  for (const PlacedLamp& lamp : lamps) {
    if (is_dark(lamp.beam)) continue;
    bright.push_back(lamp);
    const LampReach reach = reach_of(lamp);
    const bool in_air = reach.meets(geometry);
    if (in_air) view.air_lamps.push_back(lamp), in_air_of.push_back(bright.size() - 1);
    const bool reaches = in_air && std::ranges::any_of(view.items, [&](const DrawItem& item) {
                           return reach.meets(item.batch->low_m, item.batch->high_m);
                         });
    reached.push_back(reaches);
  }
  // By few kinds those after the first, which are a pair of another vehicle, light what is seen both or neither.
  if (few_kinds && bright.size() > kLampsForAll && bright.size() <= shader::kMaxLamps) {
    const auto after = reached.begin() + kLampsForAll;
    std::fill(after, reached.end(), std::find(after, reached.end(), true) != reached.end());
  }
  std::vector<std::optional<std::size_t>> lit_as(bright.size());
  for (std::size_t i = 0; i < bright.size(); ++i) {
    if (!reached[i]) continue;
    lit_as[i] = view.lit_lamps.size();
    view.lit_lamps.push_back(bright[i]);
  }
  for (const std::size_t i : in_air_of) view.air_lit.push_back(lit_as[i]);
  view.unreached += static_cast<std::uint32_t>(std::ranges::count(reached, false));
  view.lamps = static_cast<std::uint32_t>(view.lit_lamps.size());
  if (view.lamps > kLampsForAll) {
    light_by_block(view);
    return view;
  }
  view.lit_by.push_back(fill(view, view.lit_lamps));
  for (std::size_t i = 0; i < view.lamps; ++i) view.lit_by[0].lamp_at[i] = i;
  return view;
}

std::size_t LitScene::find_casters(LitView& view, const CastersFor& wanted, bool in_air) {
  for (std::size_t i = 0; in_air && i < view.air_lamps.size(); ++i) {
    if (view.air_lit[i]) continue;
    view.air_lit[i] = view.lit_lamps.size() + view.air_alone.size();
    view.air_alone.push_back(view.air_lamps[i]);
  }
  std::vector<KeptCasters::Lamp> lamps;
  for (std::size_t i = 0; i < view.lit_lamps.size() + view.air_alone.size(); ++i) {
    const PlacedLamp& lamp = view.lamp_of_cast(i);
    lamps.push_back({.reach = reach_of(lamp),
                     .world_from_image = lamp.world_from_image,
                     .carried_by = lamp.carried_by,
                     .beam = lamp.beam,
                     .version = beam_version(lamp.beam),
                     .peaks = &peaks_[lamp.beam]});
  }
  view.casts = kept_casters_.find(casters_, lamps, view.moving, wanted);
  return casters_of_all(view.casts);
}

std::size_t LitScene::wide_lamps(const LitView& view) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(view.lit_lamps, [&](const PlacedLamp& lamp) { return peaks_[lamp.beam].is_wide(); }));
}

void LitScene::light_by_block(LitView& view) {
  const std::span<const PlacedLamp> lamps = view.lit_lamps;
  std::vector<LampReach> reaches;
  for (const PlacedLamp& lamp : lamps) reaches.push_back(reach_of(lamp));
  std::map<std::vector<std::size_t>, std::size_t> sets;
  std::vector<bool> left_out(lamps.size());
  for (DrawItem& item : view.items) {
    const SceneBatch& batch = *item.batch;
    std::vector<std::size_t> here;
    for (std::size_t i = 0; i < lamps.size(); ++i)
      if (reaches[i].meets(batch.low_m, batch.high_m)) here.push_back(i);
    if (here.size() > shader::kMaxLamps) {
      // The brightest stay: peak over the square of the least distance.
      const auto at_most_lx = [&](std::size_t i) {
        const glm::dvec3 to = lamps[i].position_m - glm::clamp(lamps[i].position_m, batch.low_m, batch.high_m);
        return static_cast<double>(peaks_cd_[lamps[i].beam]) / std::max(glm::dot(to, to), 1.0);
      };
      std::ranges::stable_sort(here, std::greater(), at_most_lx);
      for (std::size_t i = shader::kMaxLamps; i < here.size(); ++i) left_out[here[i]] = true;
      here.resize(shader::kMaxLamps);
      std::ranges::sort(here);
    }
    if (view.few_kinds && lamps.size() <= shader::kMaxLamps) {
      here.resize(here.empty() || here.back() < kLampsForAll ? kLampsForAll : lamps.size());
      std::iota(here.begin(), here.end(), std::size_t{0});
    }
    const auto [set, fresh] = sets.try_emplace(here, view.lit_by.size());
    if (fresh) {
      std::vector<PlacedLamp> set_lamps;
      for (const std::size_t i : here) set_lamps.push_back(lamps[i]);
      view.lit_by.push_back(fill(view, set_lamps));
      std::ranges::copy(here, view.lit_by.back().lamp_at.begin());
    }
    item.lit_by = set->second;
  }
  view.over_limit = static_cast<std::uint32_t>(std::ranges::count(left_out, true));
  std::ranges::stable_sort(view.items, {},
                           [](const DrawItem& item) { return std::pair(drawn_by(item.batch->kind), item.lit_by); });
}

LitView LitScene::view_of_points(const ViewGeometry& geometry, std::span<const PlacedLamp> lamps) {
  LitView view{.geometry = geometry, .sky = {}};
  view.lamps = static_cast<std::uint32_t>(lamps.size());
  view.lit_lamps.assign(lamps.begin(), lamps.end());
  view.lit_by.push_back(fill(view, lamps));
  for (std::size_t i = 0; i < view.lamps; ++i) view.lit_by[0].lamp_at[i] = i;
  return view;
}

void LitView::cover_with_snow(double cover_01) {
  snow = true;
  for (const LitBy& lit : lit_by) lit.data->ground.x = static_cast<float>(cover_01);
}

void LitView::wet_ground(std::size_t level) {
  wet = true;
  for (const LitBy& lit : lit_by) lit.data->ground.y = kWetAlpha[level];
}

LitBy LitScene::fill(const LitView& view, std::span<const PlacedLamp> lamps) {
  LitBy lit;
  shader::GpuFrame frame{};
  const glm::mat4 clip = glm::mat4(view.geometry.clip_from_eye());
  for (int i = 0; i < 4; ++i) frame.clip_from_eye[i] = clip[i];
  frame.exposure = glm::vec4(view.sky.exposure_per_cdm2, 0.0f);
  frame.sky = view.sky.zenith();
  constexpr float kNowhere_lx = 1e30f;
  for (std::size_t i = 0; i < kMostIsoluxLevels; ++i)
    frame.isolux_lx[i / 4][static_cast<int>(i % 4)] =
        i < view.isolux_lx.size() ? static_cast<float>(view.isolux_lx[i]) : kNowhere_lx;
  Beams bound;
  bound.fill(kNoBeam);
  std::vector<shader::TableShape> shapes, for_any;
  std::optional<glm::vec3> first_colour;
  for (const PlacedLamp& lamp : lamps) {
    const PackedBeam& beam = beams_.beam(lamp.beam);
    bound[lit.lamps] = lamp.beam;
    shapes.push_back(beam.shape);
    const shader::TableShape any = for_any_light(beam.shape);
    frame.shapes[lit.lamps] = shape_in_frame(any);
    const auto as_first = [&] {
      return std::memcmp(&frame.shapes[0], &frame.shapes[lit.lamps], sizeof frame.shapes[0]) == 0 &&
             any.lookup == for_any.front().lookup;
    };
    const bool first = for_any.empty();
    for_any.emplace_back().lookup = any.lookup | (!first && as_first() ? shader::kLookupAsFirst : 0u);
    if (first_colour && *first_colour != beam.colour) lit.colours |= 1u;
    if (beam.tinted()) lit.colours |= 1u << (8 + lit.lamps);
    first_colour = beam.colour;
    shader::GpuLamp& out = frame.lamps[lit.lamps++];
    const glm::dvec3 from_eye_m = lamp.position_m - view.geometry.camera().eye_m;
    out.position = glm::vec4(glm::vec3(from_eye_m), peaks_cd_[lamp.beam]);
    const glm::dmat3 rows = lamp.world_from_image * beam.rows;  // columns: a, b, c in the world
    out.row_a = glm::vec4(glm::vec3(rows[0]), static_cast<float>(glm::dot(from_eye_m, from_eye_m)));
    out.row_b = glm::vec4(glm::vec3(rows[1]), lamp.of_b ? 1.0f : 0.0f);
    const bool from_behind = glm::dot(from_eye_m, lamp.world_from_image[0]) > 0.0;
    out.row_c = glm::vec4(glm::vec3(rows[2]), from_behind ? static_cast<float>(lamp.body_m) : 0.0f);
    beams_.describe(lamp.beam, out);
  }
  const auto axes_of = [&](std::size_t lamp) {
    const shader::GpuLamp& of = frame.lamps[lamp];
    return std::array{glm::vec3(of.row_a), glm::vec3(of.row_b), glm::vec3(of.row_c)};
  };
  lit.alike = lit.lamps == 2 && axes_of(0) == axes_of(1);
  lit.tables = tables_of(std::move(shapes));
  lit.any_tables = tables_of(std::move(for_any));
  auto& pages = written_->pages;
  const std::size_t view_number = written_->views++;
  const std::size_t page = view_number / kViewsInPage, place = view_number % kViewsInPage;
  if (page == pages.size())
    pages.push_back(std::make_unique<gpu::HostBuffer>(device_, kViewsInPage * stride_,
                                                       vk::BufferUsageFlagBits::eUniformBuffer, "views"));
  lit.data_at = static_cast<std::uint32_t>(place * stride_);
  lit.data = reinterpret_cast<shader::GpuFrame*>(static_cast<std::byte*>(pages[page]->data) + lit.data_at);
  std::memcpy(lit.data, &frame, sizeof frame);
  lit.set = set_of(page, bound);
  return lit;
}

glm::vec3 LitScene::mean_colour(std::span<const PlacedLamp> lamps) const {
  glm::vec3 sum(0.0f);
  float weight = 0.0f;
  for (const PlacedLamp& lamp : lamps) {
    sum += beams_.beam(lamp.beam).colour * peaks_cd_[lamp.beam];
    weight += peaks_cd_[lamp.beam];
  }
  return weight > 0.0f ? sum / weight : glm::vec3(1.0f);
}

}  // namespace phare
