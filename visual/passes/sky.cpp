#include "visual/passes/sky.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "shaders/lib/tone.h"
#include "shaders/sky.h"
#include "shaders/sky_frag.h"
#include "shaders/sky_frag_flat.h"
#include "shaders/sky_vert.h"
#include "shaders/sky_vert_flat.h"
#include "visual/lit_scene.h"

namespace phare {

static_assert(sizeof(shader::SkyConstants) == 64);

namespace {

constexpr double kWidestSector_rad = std::numbers::pi / 8.0;
constexpr double kBeside_rad = 0.01;             // sectors reach beyond the view, or its edge shows where they end
constexpr std::size_t kFirstBytes = 256 * 1024;  // a driver's view takes 10 KiB
constexpr const char* kName = "dome of the sky";

bool is_parallel(const ViewGeometry& view) {
  return view.camera().orthographic_width_m > 0.0;
}

glm::vec3 shown(const Sky& sky, double sine) {
  const glm::vec3 luminance = shader::sky_luminance(sky.zenith(), static_cast<float>(sine));
  return shader::srgb_encoded(shader::tone_curve(luminance * sky.exposure_per_cdm2));
}

struct SkyVertex {
  glm::vec3 direction, colour;
};
static_assert(sizeof(SkyVertex) == 24);

std::vector<SkyBand> bands_of_display(const Sky& sky) {
  const glm::vec3 horizon = 255.0f * shown(sky, 0.0), zenith = 255.0f * shown(sky, 1.0), fall = horizon - zenith;
  const int channel = fall.x >= fall.y && fall.x >= fall.z ? 0 : fall.y >= fall.z ? 1 : 2;
  std::vector<SkyBand> bands;
  double low = 0.0;
  const auto band_to = [&](double high) {
    const glm::vec3 colour = glm::round(255.0f * shown(sky, 0.5 * (low + high))) / 255.0f;
    bands.push_back({static_cast<float>(low), static_cast<float>(high), colour, colour});
    low = high;
  };
  // Where it goes from one of its 256 values to the next; it falls from the horizon to the zenith.
  const int first = static_cast<int>(std::lround(horizon[channel])),
            last = static_cast<int>(std::lround(zenith[channel]));
  for (int value = first; value > last; --value) {
    double before = low, after = 1.0;
    for (int i = 0; i < 24; ++i) {
      const double middle = 0.5 * (before + after);
      (255.0 * static_cast<double>(shown(sky, middle)[channel]) > value - 0.5 ? before : after) = middle;
    }
    band_to(before);
  }
  band_to(1.0);
  return bands;
}

/// Two triangles for each of its sectors.
void add_band(const SkyBand& band, const SkySectors& sectors, std::vector<SkyVertex>& vertices) {
  const auto at = [&](float sine, std::uint32_t edge, const glm::vec3& colour) {
    const double azimuth = sectors.first_rad + edge * sectors.step_rad, s = static_cast<double>(sine);
    const double cosine = std::sqrt(std::max(1.0 - s * s, 0.0));
    return SkyVertex{glm::vec3(cosine * std::cos(azimuth), cosine * std::sin(azimuth), s), colour};
  };
  for (std::uint32_t i = 0; i < sectors.count; ++i) {
    const SkyVertex right = at(band.low, i, band.colour_low), left = at(band.low, i + 1, band.colour_low),
                    above_right = at(band.high, i, band.colour_high),
                    above_left = at(band.high, i + 1, band.colour_high);
    vertices.insert(vertices.end(), {right, left, above_right, above_right, left, above_left});
  }
}

/// A fan of triangles about the moon's middle.
void add_moon(const MoonDisc& moon, const glm::vec3& colour, std::vector<SkyVertex>& vertices) {
  constexpr int kCorners = 24;
  const glm::dvec3 side = glm::normalize(
                       glm::cross(std::abs(moon.toward.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0),
                                  moon.toward)),
                   up = glm::cross(moon.toward, side);
  const auto rim = [&](int corner) {
    const double turn = 2.0 * std::numbers::pi * corner / kCorners;
    return SkyVertex{glm::vec3(moon.toward + std::tan(kMoonRadius_rad) * (std::cos(turn) * side + std::sin(turn) * up)),
                     colour};
  };
  for (int i = 0; i < kCorners; ++i)
    vertices.insert(vertices.end(), {SkyVertex{glm::vec3(moon.toward), colour}, rim(i), rim(i + 1)});
}

}  // namespace

std::vector<SkyBand> sky_bands(const Sky& sky, SkyKind kind) {
  if (kind == SkyKind::kFlat) return bands_of_display(sky);
  constexpr int kBands = 28;
  const auto sine = [](int edge) { return static_cast<float>(edge * edge) / (kBands * kBands); };
  const auto colour = [&](float at) {
    return kind == SkyKind::kHdr ? shader::sky_luminance(sky.zenith(), at) : shown(sky, static_cast<double>(at));
  };
  std::vector<SkyBand> bands;
  for (int i = 0; i < kBands; ++i) bands.push_back({sine(i), sine(i + 1), colour(sine(i)), colour(sine(i + 1))});
  return bands;
}

SkySectors sky_sectors(const ViewGeometry& view) {
  SkySectors seen;
  const auto direction = [&](double x, double y) {
    return glm::normalize(glm::dvec3(view.direction_from_clip() * glm::dvec4(x, y, 1.0, 0.0)));
  };
  // Azimuths from that of the middle. An edge of the view is a plane, so its corners are its ends in azimuth, as long
  // as it does not come near the zenith or behind.
  const glm::dvec3 ahead = direction(0.0, 0.0);
  const double along = std::atan2(ahead.y, ahead.x);
  double left = 0.0, right = 0.0;
  bool around = std::hypot(ahead.x, ahead.y) < 0.5;
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0}) {
      const glm::dvec3 there = direction(x, y);
      seen.highest_sine = std::max(seen.highest_sine, there.z);
      const double off = std::remainder(std::atan2(there.y, there.x) - along, 2.0 * std::numbers::pi);
      left = std::min(left, off), right = std::max(right, off);
      around |= std::hypot(there.x, there.y) < 0.5 || std::abs(off) > 1.4;
    }
  // Of a view that leans the highest elevation lies within an edge a + t b, not at its ends.
  const std::array corners{glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto ray = [&](const glm::dvec2& at) {
      return glm::dvec3(view.direction_from_clip() * glm::dvec4(at, 1.0, 0.0));
    };
    const glm::dvec3 a = ray(corners[i]), b = ray(corners[(i + 1) % corners.size()]) - a;
    const double ab = glm::dot(a, b), bend = b.z * ab - a.z * glm::dot(b, b);
    if (bend == 0.0) continue;
    const double t = std::clamp((a.z * ab - b.z * glm::dot(a, a)) / bend, 0.0, 1.0);
    seen.highest_sine = std::max(seen.highest_sine, glm::normalize(a + t * b).z);
  }
  if (seen.highest_sine <= 0.0) return seen;
  if (around)
    left = -std::numbers::pi, right = std::numbers::pi, seen.highest_sine = 1.0;
  else
    left -= kBeside_rad, right += kBeside_rad;
  seen.count = static_cast<std::uint32_t>(std::max(std::ceil((right - left) / kWidestSector_rad - 1e-9), 1.0));
  seen.first_rad = along + left;
  seen.step_rad = (right - left) / seen.count;
  return seen;
}

glm::vec4 Sky::zenith() const {
  return {glm::vec3(0.75f, 1.0f, 1.7f) * static_cast<float>(zenith_cdm2), 3.0f};
}

SkyPass::SkyPass(gpu::Device& device)
    : device_(device),
      vertex_{gpu::make_shader(device, k_sky_vert), gpu::make_shader(device, k_sky_vert_flat)},
      fragment_{gpu::make_shader(device, k_sky_frag), gpu::make_shader(device, k_sky_frag_flat)} {
  const vk::PushConstantRange push{
      .stageFlags = vk::ShaderStageFlagBits::eVertex, .offset = 0, .size = sizeof(shader::SkyConstants)};
  layout_ = vk::raii::PipelineLayout(
      device.device, vk::PipelineLayoutCreateInfo{.pushConstantRangeCount = 1, .pPushConstantRanges = &push});
}

vk::ClearValue SkyPass::clear_value(const Sky& sky, LampOutput output, const ViewGeometry& view) {
  if (output == LampOutput::kDifference || output == LampOutput::kRatio)  // neither is brighter where there is no light
    return vk::ClearColorValue(std::array{0.0f, 0.0f, 0.0f, 1.0f});
  if (shows_lux(output)) return vk::ClearColorValue(std::array{0.0f, 0.0f, 0.1f, 1.0f});
  // Parallel rays have one direction, so one colour of sky.
  const double sine = is_parallel(view) ? view.camera().world_from_eye[0].z : 0.0;
  const bool hdr = output == LampOutput::kHdr;
  const glm::vec3 colour =
      hdr ? shader::sky_luminance(sky.zenith(), static_cast<float>(sine)) : shown(sky, std::max(sine, 0.0));
  return vk::ClearColorValue(std::array{colour.x, colour.y, colour.z, hdr ? 0.0f : 1.0f});
}

void SkyPass::begin_frame() {
  views_ = vertices_->used_bytes = 0;
  vertices_->outgrown.clear();
}

SkyPass::Dome& SkyPass::dome_of(const Sky& sky, SkyKind kind) {
  if (views_ == domes_.size()) domes_.emplace_back();
  Dome& dome = domes_[views_++];
  if (dome.bands.empty() || dome.sky != sky || dome.kind != kind) {
    dome.sky = sky, dome.kind = kind;
    dome.bands = sky_bands(sky, kind);
  }
  return dome;
}

void SkyPass::draw(gpu::Recorder& commands, const Sky& sky, const ViewGeometry& view, LampOutput output,
                   vk::Format format, vk::SampleCountFlagBits samples) {
  if (shows_lux(output) || is_parallel(view)) return;
  const SkySectors sectors = sky_sectors(view);
  if (sectors.count == 0) return;
  const bool hdr = output == LampOutput::kHdr;
  const SkyKind kind = hdr                                      ? SkyKind::kHdr
                       : samples == vk::SampleCountFlagBits::e1 ? SkyKind::kFlat
                                                                : SkyKind::kBlended;
  const std::size_t variant = kind == SkyKind::kFlat ? 1 : 0;
  const auto key = std::tuple(output, format, samples);
  auto found = pipelines_.find(key);
  if (found == pipelines_.end()) {
    const auto value = static_cast<std::uint32_t>(output);
    const vk::SpecializationMapEntry entry{.constantID = shader::kSpecSkyOutput, .offset = 0, .size = 4};
    const vk::SpecializationInfo constants{.mapEntryCount = 1, .pMapEntries = &entry, .dataSize = 4, .pData = &value};
    const std::array attributes{
        vk::VertexInputAttributeDescription{.location = 0, .binding = 0, .format = vk::Format::eR32G32B32Sfloat},
        vk::VertexInputAttributeDescription{
            .location = 1, .binding = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = 12}};
    found = pipelines_
                .emplace(key, make_pipeline(device_, {.vertex = *vertex_[variant],
                                                      .fragment = *fragment_[variant],
                                                      .constants = &constants,
                                                      .attributes = attributes,
                                                      .stride = sizeof(SkyVertex),
                                                      .colour = {format},
                                                      .depth = true,
                                                      .compare = vk::CompareOp::eAlways,
                                                      .samples = samples,
                                                      .layout = *layout_}))
                .first;
  }
  shader::SkyConstants push{};
  const glm::mat4 clip(view.clip_from_eye());
  for (int i = 0; i < 4; ++i) push.clip_from_eye[i] = clip[i];
  const Dome& dome = dome_of(sky, kind);
  std::vector<SkyVertex> vertices;
  for (const SkyBand& band : dome.bands)
    if (static_cast<double>(band.low) < sectors.highest_sine) add_band(band, sectors, vertices);
  if (sky.moon)
    add_moon(*sky.moon,
             hdr ? sky.moon->luminance_cdm2
                 : shader::srgb_encoded(shader::tone_curve(sky.moon->luminance_cdm2 * sky.exposure_per_cdm2)),
             vertices);
  const std::size_t bytes = vertices.size() * sizeof(SkyVertex);
  auto& [buffer, outgrown, used_bytes] = *vertices_;
  if (used_bytes + bytes > buffer.bytes) {
    const vk::DeviceSize more = std::max<vk::DeviceSize>(kFirstBytes, 2 * (used_bytes + bytes));
    outgrown.push_back(std::exchange(
        buffer, gpu::HostBuffer(device_, more, vk::BufferUsageFlagBits::eVertexBuffer, kName)));
    used_bytes = 0;
  }
  const vk::DeviceSize at = std::exchange(used_bytes, used_bytes + bytes);
  std::memcpy(static_cast<std::byte*>(buffer.data) + at, vertices.data(), bytes);
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *found->second);
  commands.bindVertexBuffers(0, *buffer.buffer, at);
  commands.pushConstants<shader::SkyConstants>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, push);
  commands.draw(static_cast<std::uint32_t>(vertices.size()), 1, 0, 0);
}

}  // namespace phare
