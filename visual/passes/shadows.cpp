#include "visual/passes/shadows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <optional>

#include "config/base/on_all_cores.h"
#include "shaders/depth_cut_frag.h"
#include "shaders/shadow_cut_vert.h"
#include "shaders/shadow_vert.h"
#include "shaders/textured.h"
#include "visual/caster_depths.h"
#include "visual/caster_grid.h"
#include "visual/passes/constants.h"

namespace phare {
namespace {

/// How the map takes points relative to the eye. Its outermost texels stay empty: beyond it all is lit.
shader::GpuShadow place_of(const PlacedLamp& lamp, const ViewGeometry& view, const glm::dvec2& texels, double zoom) {
  const glm::dvec3 from_lamp = view.camera().eye_m - lamp.position_m;
  const auto row = [&](const glm::dvec3& direction) {
    return glm::vec4(glm::vec3(direction), static_cast<float>(glm::dot(direction, from_lamp)));
  };
  return {row(lamp.world_from_image[1] * -texels.x), row(lamp.world_from_image[2] * -texels.y),
          row(lamp.world_from_image[0]), glm::vec4(zoom, view.mirrored() ? -1.0 : 1.0, 0.0, 0.0)};
}

/// How many times as large a map's second picture shows its middle: that holds all that a driver sees of the road and
/// what stands beside it, tangents of 1 across and 0.25 up and down, but at least a quarter of each side and at most
/// half. Chosen by the edge of a verge's shadow, which comes in steps where the first picture shows it.
double zoom_of(const glm::dvec2& half) {
  return std::clamp(std::min(half.x / 1.0, half.y / 0.25), 2.0, 4.0);
}

/// Of the first picture of a map nothing is read this far from its middle, in texels, where the second shows it larger:
/// where shaders/lib/shadow.glsl turns to the second, less the two texels around a point that are weighed, and one.
glm::vec2 half_unread(const ShadowLevel& level, double zoom) {
  const glm::vec2 half(0.5f * static_cast<float>(level.width), 0.5f * static_cast<float>(level.height));
  return (half - 1.0f) / static_cast<float>(zoom) - 3.0f;
}

struct Map {
  std::size_t lamp = 0;    ///< of the view
  glm::dvec2 half{1.0};    ///< sides of what its first picture shows, tangents
  glm::dvec2 texels{0.0};  ///< of its first picture, to a tangent of 1
  double zoom = 1.0;       ///< of its second; the same for all of a view
};

DepthPicture picture_of(const Map& map, const ShadowLevel& level, bool close) {
  DepthPicture picture{.width = level.width, .height = level.height, .texels = map.texels * (close ? map.zoom : 1.0)};
  if (!close) picture.margin = 1, picture.half_unread = half_unread(level, map.zoom);
  return picture;
}

template <typename Corner>
void append_seen(std::vector<Corner>& seen, const std::vector<Corner>& corners, const std::vector<CastBounds>& bounds,
                 const DepthPicture& picture) {
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (picture.shows(bounds[i])) seen.insert(seen.end(), &corners[3 * i], &corners[3 * i] + 3);
}

std::size_t texels_of_map(const ShadowLevel& level) {
  return std::size_t{2} * level.width * level.height;
}

/// A map for each lamp that something stands before, `most` of them; the view's data say where points fall on it. An
/// empty one for each of the others, where the view asks for that and there is room.
std::vector<Map> place_maps(LitView& view, const ShadowLevel& level, std::size_t most) {
  std::vector<Map> maps;
  double zoom = HUGE_VAL;
  const bool each = view.few_kinds && view.casts.size() <= most && casters_of_all(view.casts) > 0;
  for (std::size_t lamp = 0; lamp < view.casts.size(); ++lamp) {
    const bool casts = view.casts[lamp]->count > 0;
    if (!casts && !each) continue;
    if (maps.size() == most) {
      ++view.without_map;
      continue;
    }
    Map& map = maps.emplace_back(Map{.lamp = lamp});
    if (casts) {
      map.half = half_sides(view.casts[lamp]->part);
      zoom = std::min(zoom, zoom_of(map.half));
    }
    map.texels = (0.5 * glm::dvec2(level.width, level.height) - 1.0) / map.half;
  }
  view.air_shadows.maps.resize(view.casts.size());
  for (std::size_t map = 0; map < maps.size(); ++map) {
    maps[map].zoom = zoom;
    const std::size_t lamp = maps[map].lamp;
    const shader::GpuShadow place = place_of(view.lamp_of_cast(lamp), view.geometry, maps[map].texels, zoom);
    view.air_shadows.maps[lamp] = {static_cast<std::uint32_t>(map + 1), place};
    for (LitBy& lit : view.lit_by)
      for (std::size_t k = 0; k < lit.lamps; ++k) {
        if (lit.lamp_at[k] != lamp) continue;
        lit.data->shadows[k] = place;
        lit.shadow_maps |= static_cast<std::uint32_t>(map + 1) << (4 * k);
      }
  }
  return maps;
}

/// Where a map may hide light.
struct Shade {
  glm::dmat3 image_from_world{1.0};
  glm::dvec3 lamp_m{0.0};
  const CasterGrid& grid;

  bool may_fall_on(const glm::dvec3& low_m, const glm::dvec3& high_m) const {
    return grid.may_shade(box_corners(image_from_world, lamp_m, low_m, high_m));
  }
};

/// Of those of one kind about one origin, that are drawn in one call where nothing else tells them apart, first those
/// that no shadow reaches.
void draw_together(std::vector<DrawItem>& items) {
  for (auto begin = items.begin(); begin != items.end();) {
    const auto end = std::find_if_not(begin, items.end(), [&](const DrawItem& item) {
      return item.batch->kind == begin->batch->kind && item.is_placed_as(*begin);
    });
    std::stable_partition(begin, end, [](const DrawItem& item) { return !item.shadowed; });
    begin = end;
  }
}

/// What begins farther away fills so little of a picture that its pieces are not told apart: chosen.
constexpr float kPiecesTo_m = 60.0f;

/// Tells which of the view's draws a shadow may fall on. Of what is near that is done by pieces: those that none can
/// reach are drawn first, as where nothing casts.
void tell_shadowed(LitView& view, std::span<const Shade> shades) {
  const auto may_fall_on = [&](const glm::dvec3& low_m, const glm::dvec3& high_m) {
    return std::ranges::any_of(shades, [&](const Shade& shade) { return shade.may_fall_on(low_m, high_m); });
  };
  std::vector<std::vector<bool>> on_pieces(view.items.size());
  on_all_cores(view.items.size(), [&](std::size_t i) {
    DrawItem& item = view.items[i];
    const SceneBatch& batch = *item.batch;
    item.shadowed = may_fall_on(batch.low_m, batch.high_m);
    if (!item.shadowed || item.distance_m > kPiecesTo_m || item.index_count != batch.index_count) return;
    for (const BatchPiece& piece : batch.pieces)
      on_pieces[i].push_back(
          may_fall_on(batch.origin_m + glm::dvec3(piece.low_m), batch.origin_m + glm::dvec3(piece.high_m)));
  });
  std::vector<DrawItem> items, shadowed;
  items.reserve(2 * view.items.size());
  for (std::size_t i = 0; i < view.items.size(); ++i) {
    const DrawItem& item = view.items[i];
    if (on_pieces[i].empty()) {
      items.push_back(item);
      continue;
    }
    shadowed.clear();
    std::uint32_t first_index = item.first_index;
    std::optional<bool> before;
    for (std::size_t k = 0; k < on_pieces[i].size(); ++k) {
      const std::uint32_t count = item.batch->pieces[k].index_count;
      const bool here = on_pieces[i][k];
      std::vector<DrawItem>& run = here ? shadowed : items;
      if (before != here) {
        run.push_back(item);
        run.back().first_index = first_index, run.back().index_count = 0;
        run.back().shadowed = here;
      }
      run.back().index_count += count;
      first_index += count;
      before = here;
    }
    items.insert(items.end(), shadowed.begin(), shadowed.end());
  }
  view.items = std::move(items);
  draw_together(view.items);
}

/// Of what casts in the view some has holes that are drawn.
bool has_holes(const LitScene& scene, const LitView& view) {
  return scene.has_textures() && std::ranges::any_of(view.casts, [](const auto& cast) { return !cast->cut.empty(); });
}

template <typename Corner>
void fill_buffer(gpu::Device& device, gpu::HostBuffer& buffer, const std::vector<Corner>& corners) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(corners));
  if (buffer.bytes < bytes.size() || buffer.bytes == 0)
    buffer = gpu::HostBuffer(device, std::max<vk::DeviceSize>(2 * bytes.size(), 4096),
                             vk::BufferUsageFlagBits::eVertexBuffer, "shadow casters");
  std::memcpy(buffer.data, bytes.data(), bytes.size());
}

/// Where pictures of maps are drawn, one below the other.
gpu::Image& map_image(gpu::FrameGraph& graph, const ShadowLevel& level, std::size_t pictures) {
  using Usage = vk::ImageUsageFlagBits;
  return graph.image("shadow maps", {vk::Format::eD32Sfloat,
                                     {level.width, level.height * static_cast<std::uint32_t>(pictures)},
                                     Usage::eDepthStencilAttachment | Usage::eTransferSrc | Usage::eTransferDst});
}

/// What is drawn into the two pictures of a map.
struct Drawn {
  std::vector<glm::vec3> corners{};
  std::vector<CutCorner> cut_corners{};
  std::array<ShadowPass::Ranges, 2> pictures{};
};

Drawn drawn_into(const Map& map, const CastBy& cast, const ShadowLevel& level, bool textures) {
  Drawn drawn;
  drawn.corners.reserve(3 * (cast.far_sides.bounds.size() + cast.both_sides.bounds.size()));
  for (std::size_t close = 0; close < 2; ++close) {
    const DepthPicture seen = picture_of(map, level, close == 1);
    ShadowPass::Ranges& picture = drawn.pictures[close];
    for (std::size_t side = 0; side < 2; ++side) {
      const WholeCasters& whole = side == 0 ? cast.far_sides : cast.both_sides;
      const auto first = static_cast<std::uint32_t>(drawn.corners.size());
      append_seen(drawn.corners, whole.corners, whole.bounds, seen);
      if (side == 1 && !textures)  // a device that draws no holes: whole
        for (const CutCasters& cut : cast.cut) {
          std::vector<glm::vec3> corners;
          for (const CutCorner& corner : cut.corners) corners.push_back(corner.corner_m);
          append_seen(drawn.corners, corners, cut.bounds, seen);
        }
      picture.sides[side] = {first, static_cast<std::uint32_t>(drawn.corners.size()) - first};
    }
    if (!textures) continue;
    for (const CutCasters& cut : cast.cut) {
      const auto first = static_cast<std::uint32_t>(drawn.cut_corners.size());
      append_seen(drawn.cut_corners, cut.corners, cut.bounds, seen);
      if (const auto count = static_cast<std::uint32_t>(drawn.cut_corners.size()) - first; count > 0)
        picture.cut.push_back({cut.material, {first, count}});
    }
  }
  return drawn;
}

/// The triangles of each picture into the buffers that they are drawn from, behind those of the maps before.
std::vector<ShadowPass::Ranges> fill_triangles(gpu::Device& device, ShadowDepths& depths, std::span<Drawn> maps) {
  std::vector<glm::vec3> corners;
  std::vector<CutCorner> cut_corners;
  std::vector<ShadowPass::Ranges> ranges;
  for (Drawn& map : maps) {
    for (ShadowPass::Ranges& picture : map.pictures) {
      for (ShadowPass::Range& side : picture.sides) side.first += static_cast<std::uint32_t>(corners.size());
      for (ShadowPass::CutRange& cut : picture.cut) cut.range.first += static_cast<std::uint32_t>(cut_corners.size());
      ranges.push_back(std::move(picture));
    }
    corners.insert(corners.end(), map.corners.begin(), map.corners.end());
    cut_corners.insert(cut_corners.end(), map.cut_corners.begin(), map.cut_corners.end());
  }
  fill_buffer(device, depths.triangles->whole, corners);
  if (!cut_corners.empty()) fill_buffer(device, depths.triangles->cut, cut_corners);
  return ranges;
}

}  // namespace

std::size_t shadow_maps_in_image(const ShadowLevel& level, const ShadowLimits& limits) {
  return level.width > limits.image_side ? 0 : limits.image_side / (2 * level.height);
}

std::size_t most_shadow_maps(const ShadowLevel& level, const ShadowLimits& limits) {
  if (shadow_maps_in_image(level, limits) == 0) return 0;
  return std::min<std::size_t>(kMostShadowMaps, limits.buffer_texels / (std::uint64_t{2} * level.width * level.height));
}

ShadowPass::ShadowPass(gpu::Device& device)
    : device_(device),
      limits_{device.properties.limits.maxTexelBufferElements, device.properties.limits.maxImageDimension2D} {}

void ShadowPass::begin_frame(bool seen) {
  if (used_ < depths_.size()) device_.wait_for_frames();
  depths_.resize(std::min(depths_.size(), used_));
  used_ = 0;
  if (seen && rays_ && !rays_->begin_frame()) {
    device_.wait_for_frames();
    rays_.reset();
  }
}

ShadowDepths& ShadowPass::depths_of(std::size_t texels) {
  if (used_ == depths_.size()) depths_.push_back(std::make_unique<ShadowDepths>(device_));
  ShadowDepths& depths = *depths_[used_++];
  const vk::DeviceSize bytes = 4 * texels;
  if (depths.bytes() == bytes * (device_.processor_depths ? gpu::kMostFramesInFlight : 1)) return depths;
  if (depths.bytes() > 0) device_.wait_for_frames();
  depths = ShadowDepths(device_);
  depths.sets = gpu::DescriptorSets(device_, kShadowBindings);
  using Usage = vk::BufferUsageFlagBits;
  const auto set_of = [&](const vk::raii::Buffer& buffer, vk::raii::BufferView& view) {
    view = vk::raii::BufferView(
        device_.device,
        vk::BufferViewCreateInfo{.buffer = *buffer, .format = vk::Format::eR32Sfloat, .range = VK_WHOLE_SIZE});
    const vk::DescriptorSet set = depths.sets.make();
    device_.device.updateDescriptorSets(
        vk::WriteDescriptorSet{.dstSet = set,
                               .dstBinding = 0,
                               .descriptorCount = 1,
                               .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                               .pTexelBufferView = &*view},
        nullptr);
    return set;
  };
  if (device_.processor_depths) {
    depths.in_turn.resize(gpu::kMostFramesInFlight);
    for (ShadowDepths::InTurn& one : depths.in_turn) {
      one.texels = gpu::HostBuffer(device_, bytes, Usage::eUniformTexelBuffer | Usage::eTransferDst, "shadow depths");
      one.set = set_of(one.texels.buffer, one.view);
    }
    depths.set = depths.in_turn.front().set;
  } else {
    depths.texels = gpu::DeviceBuffer(device_, bytes, Usage::eUniformTexelBuffer, "shadow depths");
    depths.set = set_of(depths.texels.buffer, depths.view);
  }
  return depths;
}

vk::Pipeline ShadowPass::pipeline(const LitScene& scene, bool both_sides) {
  vk::raii::Pipeline& pipeline = pipelines_[both_sides ? 1 : 0];
  if (*pipeline) return *pipeline;
  if (!*vertex_) vertex_ = gpu::make_shader(device_, k_shadow_vert);
  // What is seen from both sides casts with the one that faces the lamp too, moved back by as much as depth changes
  // over one and a half texels, so that it does not shadow itself.
  pipeline = make_pipeline(device_, {.vertex = *vertex_,
                                     .attributes = std::span(kVertexAttributes).first(1),
                                     .stride = sizeof(glm::vec3),
                                     .depth = true,
                                     .depth_write = true,
                                     .depth_slope = both_sides ? -1.5f : 0.0f,
                                     .layout = scene.layout()});
  return *pipeline;
}

vk::Pipeline ShadowPass::cut_pipeline(LitScene& scene) {
  if (*cut_pipeline_) return *cut_pipeline_;
  cut_vertex_ = gpu::make_shader(device_, k_shadow_cut_vert);
  cut_fragment_ = gpu::make_shader(device_, k_depth_cut_frag);
  const std::array attributes{
      kVertexAttributes[0],
      vk::VertexInputAttributeDescription{.location = 1,
                                          .binding = 0,
                                          .format = vk::Format::eR32G32Sfloat,
                                          .offset = offsetof(CutCorner, uv)}};
  SpecConstants numbers;
  numbers.put(shader::kSpecLook, shader::kLookBase | shader::kLookCut);
  const vk::SpecializationInfo constants = numbers.info();
  cut_pipeline_ = make_pipeline(device_, {.vertex = *cut_vertex_,
                                          .fragment = *cut_fragment_,
                                          .constants = &constants,
                                          .attributes = attributes,
                                          .stride = sizeof(CutCorner),
                                          .depth = true,
                                          .depth_write = true,
                                          .depth_slope = -1.5f,
                                          .layout = scene.textured_layout()});
  return *cut_pipeline_;
}

void ShadowPass::draw(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level, bool in_air) {
  if (!kShadowLevels[level].by_rays()) {
    draw_maps(graph, scene, view, level);
    return;
  }
  if (in_air) {
    draw_maps(graph, scene, view, kRayShadows - 1);
    for (LitBy& lit : view.lit_by) lit.shadow_maps = 0;
    view.without_map = 0;
  }
  if (!rays_) rays_ = std::make_unique<ShadowRays>(device_);
  rays_->place(graph, scene, view, kShadowLevels[level]);
}

void ShadowPass::draw_maps(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level_number) {
  while (level_number > 1 && most_shadow_maps(kShadowLevels[level_number], limits_) == 0) --level_number;
  const ShadowLevel& level = kShadowLevels[level_number];
  const std::vector<Map> maps = place_maps(view, level, most_shadow_maps(level, limits_));
  if (maps.empty()) return;
  ShadowDepths& depths = depths_of(maps.size() * texels_of_map(level));
  const std::size_t in_image = shadow_maps_in_image(level, limits_);
  std::vector<ShadowDepths::Held> held;
  for (const Map& map : maps) held.push_back({view.casts[map.lamp], map.half, map.texels, map.zoom});
  if (depths.held == held && depths.level == level) {
    // All stands still: the maps are as they were, and so is the memory that they will be drawn in.
    if (!device_.processor_depths || has_holes(scene, view))
      graph.release(map_image(graph, level, 2 * std::min(maps.size(), in_image)));
  } else {
    depths.held = std::move(held), depths.level = level;
    depths.grids.resize(maps.size());
    if (!depths.in_turn.empty()) {
      depths.turn = (depths.turn + 1) % depths.in_turn.size();
      depths.set = depths.in_turn[depths.turn].set;
    }
    const auto cast_by = [&](std::size_t map) -> const CastBy& { return *view.casts[maps[map].lamp]; };
    const auto find_grid = [&](std::size_t map) {
      depths.grids[map] = CasterGrid(cast_by(map), maps[map].half, 1.0 / maps[map].texels, maps[map].zoom);
    };
    if (device_.processor_depths && !has_holes(scene, view)) {
      float* const texels = static_cast<float*>(depths.in_turn[depths.turn].texels.data);
      const std::size_t in_picture = texels_of_map(level) / 2;
      graph.by_processor("shadows", [&] {
        on_all_cores(3 * maps.size(), [&](std::size_t turn) {
          const std::size_t map = turn / 3, picture = turn % 3;
          if (picture == 2) return find_grid(map);
          const std::span<float> into(texels + (2 * map + picture) * in_picture, in_picture);
          std::ranges::fill(into, 0.0f);
          raise_depths(picture_of(maps[map], level, picture == 1), cast_by(map), true, into);
        });
      });
    } else {
      std::vector<Drawn> drawn(maps.size());
      on_all_cores(2 * maps.size(), [&](std::size_t turn) {
        const std::size_t map = turn / 2;
        if (turn % 2 == 0) return find_grid(map);
        drawn[map] = drawn_into(maps[map], cast_by(map), level, scene.has_textures());
      });
      const std::vector<Ranges> ranges = fill_triangles(device_, depths, drawn);
      for (std::size_t first = 0; first < maps.size(); first += in_image) {
        std::vector<Picture> pictures;
        for (std::size_t map = first; map < std::min(maps.size(), first + in_image); ++map)
          for (const bool close : {false, true})
            pictures.push_back({.close = close,
                                .scale = maps[map].texels * (close ? maps[map].zoom : 1.0) /
                                         glm::dvec2(0.5 * level.width, 0.5 * level.height),
                                .ranges = ranges[2 * map + (close ? 1 : 0)]});
        draw_image(graph, scene, depths, level, pictures, first * texels_of_map(level));
      }
    }
  }
  std::vector<Shade> shades;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (maps[i].lamp >= view.lit_lamps.size()) break;  // those that light air alone come last, and shade no surface
    const PlacedLamp& lamp = view.lit_lamps[maps[i].lamp];
    shades.push_back({glm::transpose(lamp.world_from_image), lamp.position_m, depths.grids[i]});
  }
  tell_shadowed(view, shades);
  graph.count_kept(&depths, depths.bytes());
  view.shadows = view.air_shadows.level = level;
  view.depths = view.air_shadows.depths = &depths;
}

void ShadowPass::draw_image(gpu::FrameGraph& graph, LitScene& scene, const ShadowDepths& depths,
                            const ShadowLevel& level, const std::vector<Picture>& pictures, std::size_t first_texel) {
  gpu::Image& image = map_image(graph, level, pictures.size());
  const vk::Extent2D extent = image.extent;
  const vk::ClearDepthStencilValue nothing{0.0f, 0};
  // Lavapipe clears as it draws tile by tile, 256 bytes at a time; at once it takes half of the processor's time. Not
  // so of a picture, whose tiles are all drawn into while what was cleared is still in the cache.
  const bool at_once = device_.properties.deviceType == vk::PhysicalDeviceType::eCpu;
  if (at_once)
    graph.copy("clear shadows", {{&image, gpu::Use::kClearTarget, true}}, [&](gpu::Recorder& commands) {
      commands.clearDepthStencilImage(*image.image, vk::ImageLayout::eTransferDstOptimal, nothing,
                                      vk::ImageSubresourceRange{vk::ImageAspectFlagBits::eDepth, 0, 1, 0, 1});
    });
  graph.pass("shadows", {{&image, gpu::Use::kDepthTarget, !at_once}}, [&](gpu::Recorder& commands) {
    const vk::RenderingAttachmentInfo target =
        attachment(image, vk::ImageLayout::eDepthStencilAttachmentOptimal,
                   at_once ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear, nothing);
    commands.beginRendering(
        vk::RenderingInfo{.renderArea = {{0, 0}, extent}, .layerCount = 1, .pDepthAttachment = &target});
    const auto push = [&](const Picture& picture) {
      scene.push(commands, {.origin = glm::vec4(glm::vec2(picture.scale), 0.0f, 0.0f),
                            .detail_origin = glm::vec4(0.0f),
                            .turn = {}});
    };
    commands.bindVertexBuffers(0, *depths.triangles->whole.buffer, vk::DeviceSize{0});
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const Picture& picture = pictures[i];
      const auto top = static_cast<std::int32_t>(i * level.height);
      set_area(commands, {{0, top}, {level.width, level.height}});
      if (!picture.close) commands.setScissor(0, vk::Rect2D{{1, top + 1}, {level.width - 2, level.height - 2}});
      for (const bool both_sides : {false, true}) {
        const Range& range = picture.ranges.sides[both_sides ? 1 : 0];
        if (range.count == 0) continue;
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline(scene, both_sides));
        push(picture);
        commands.draw(range.count, 1, range.first, 0);
      }
      if (picture.ranges.cut.empty()) continue;
      commands.bindPipeline(vk::PipelineBindPoint::eGraphics, cut_pipeline(scene));
      commands.bindVertexBuffers(0, *depths.triangles->cut.buffer, vk::DeviceSize{0});
      push(picture);
      for (const CutRange& cut : picture.ranges.cut) {
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, scene.textured_layout(), 3,
                                    scene.textures_of(cut.material), nullptr);
        commands.draw(cut.range.count, 1, cut.range.first, 0);
      }
      commands.bindVertexBuffers(0, *depths.triangles->whole.buffer, vk::DeviceSize{0});
    }
    commands.endRendering();
  });
  const vk::Buffer buffer = depths.in_turn.empty() ? *depths.texels.buffer : *depths.in_turn[depths.turn].texels.buffer;
  graph.copy("shadow depths", {{&image, gpu::Use::kCopySource, false}}, [&](gpu::Recorder& commands) {
    // The frame before may still read its own.
    constexpr vk::PipelineStageFlags2 kReaders =
        vk::PipelineStageFlagBits2::eFragmentShader | vk::PipelineStageFlagBits2::eComputeShader;
    const vk::MemoryBarrier2 once_read{.srcStageMask = kReaders,
                                       .dstStageMask = vk::PipelineStageFlagBits2::eCopy,
                                       .dstAccessMask = vk::AccessFlagBits2::eTransferWrite};
    commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &once_read});
    commands.copyImageToBuffer(*image.image, vk::ImageLayout::eTransferSrcOptimal, buffer,
                               vk::BufferImageCopy{.bufferOffset = 4 * first_texel,
                                                   .imageSubresource = {vk::ImageAspectFlagBits::eDepth, 0, 0, 1},
                                                   .imageExtent = {extent.width, extent.height, 1}});
    const vk::MemoryBarrier2 to_shader{.srcStageMask = vk::PipelineStageFlagBits2::eCopy,
                                       .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                       .dstStageMask = kReaders,
                                       .dstAccessMask = vk::AccessFlagBits2::eShaderSampledRead};
    commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &to_shader});
  });
  graph.release(image);
}

}  // namespace phare
