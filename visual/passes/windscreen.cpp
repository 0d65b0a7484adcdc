#include "visual/passes/windscreen.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <numbers>
#include <vector>

#include "shaders/fullscreen_vert.h"
#include "shaders/windscreen.h"
#include "shaders/windscreen_frag.h"
#include "shaders/windscreen_light_frag.h"
#include "shaders/windscreen_vert.h"
#include "visual/passes/pipeline.h"

namespace phare {

static_assert(sizeof(shader::GpuScreenLight) == 128 && sizeof(shader::GpuScreen) == 128, "push constants");

namespace {

constexpr vk::Format kScreenFormat = vk::Format::eR16G16B16A16Sfloat;
constexpr vk::Extent2D kScreenExtent{shader::kScreenColumns, shader::kScreenRows};
/// Of an eye at night: what a drop on the glass is blurred to.
constexpr double kPupil_m = 0.006;
constexpr double kDiscMean = 2.0 / 3.0;  // of screen_disc()
constexpr auto kVertexOrFragment = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

constexpr vk::DescriptorSetLayoutBinding kScreenInput{.binding = 0,
                                                .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                .descriptorCount = 1,
                                                .stageFlags = kVertexOrFragment};

/// Columns: a way of 1 m to the left, up, and ahead of the eye.
std::array<glm::vec4, 4> clip_from_glass(const ViewGeometry& view) {
  const glm::dmat3& eye = view.camera().world_from_eye;
  const glm::dmat4 clip = view.clip_from_eye();
  return {glm::vec4(clip * glm::dvec4(eye[1], 0.0)), glm::vec4(clip * glm::dvec4(eye[2], 0.0)),
          glm::vec4(clip * glm::dvec4(eye[0], 0.0)), glm::vec4(clip[3])};
}

/// Of a tangent in the middle of the picture, px.
double px_per_tangent(const ViewGeometry& view, const vk::Rect2D& area) {
  return 0.5 * area.extent.height / view.half_up();
}

glm::vec4 screen_area(const vk::Rect2D& area) {
  return {area.offset.x, area.offset.y, area.extent.width, area.extent.height};
}

shader::GpuScreenLight light_of(const ViewGeometry& view, const vk::Rect2D& area, std::span<const GlaringLamp> lamps) {
  const double bends_rad = static_cast<double>(shader::kDropBends_deg) * std::numbers::pi / 180.0;
  shader::GpuScreenLight data{};
  std::ranges::copy(clip_from_glass(view), data.clip_from_glass);
  data.area = screen_area(area);
  data.reach = glm::vec4(glm::dvec4(px_per_tangent(view, area) * std::tan(bends_rad),
                                    2.0 * std::numbers::pi * (1.0 - std::cos(bends_rad)), 0.0, 0.0));
  std::size_t used = 0;
  for (const GlaringLamp& lamp : lamps) {  // strongest first
    const glm::dvec4 clip = view.clip_from_eye() * glm::dvec4(lamp.place_m - view.camera().eye_m, 1.0);
    if (clip.w <= 0.0 || used == 2) continue;
    data.lamps[used++] = {data.area.x + data.area.z * (0.5f + 0.5f * static_cast<float>(clip.x / clip.w)),
                          data.area.y + data.area.w * (0.5f + 0.5f * static_cast<float>(clip.y / clip.w)),
                          static_cast<float>(lamp.eye_lx),
                          std::bit_cast<float>(glm::packHalf2x16({lamp.colour.x, lamp.colour.z}))};
  }
  return data;
}

shader::GpuScreen screen_of(const ViewGeometry& view, const vk::Rect2D& area, const Windscreen& screen,
                            const Air& air) {
  shader::GpuScreen data{};
  std::ranges::copy(clip_from_glass(view), data.clip_from_glass);
  data.area = screen_area(area);
  const WiperPace pace = pace_of(screen.wiper);
  // The same drops come again after so many strokes: float32 knows the time to a millisecond.
  constexpr double kStrokes = 1024.0;
  const double time_s = pace.period_s > 0.0 ? std::fmod(screen.time_s, kStrokes * pace.period_s) : 0.0;
  data.wiper = glm::vec4(glm::dvec4(time_s, pace.period_s, pace.stroke_s, 0.0));
  // A disc as large as the pupil's image, weighed by its profile; all of them together are all that lies on the glass.
  const double radius_m = 0.5 * kPupil_m / std::sqrt(kDiscMean);
  const double disc_m2 = kDiscMean * std::numbers::pi * radius_m * radius_m;
  const double glass_m2 = 4.0 * static_cast<double>(shader::kGlassAside_m) * static_cast<double>(shader::kGlassUp_m);
  const double discs_01 = static_cast<double>(shader::kScreenPlaces) * disc_m2 / glass_m2;
  data.water = glm::vec4(glm::dvec4(covered_per_s(air, screen.speed_mps) / kMostCovered_01,
                                    std::min(kMostCovered_01 / discs_01, 1.0),
                                    px_per_tangent(view, area) * radius_m / double{shader::kGlass_m}, 0.0));
  // Chosen: below 40 km/h drops run down, from 65 km/h on the air takes them up; the faster, the more it draws them out.
  constexpr double kDown_mps = 11.0, kUp_mps = 18.0, kFullyDrawn_mps = 40.0;
  data.wind = glm::vec4(glm::dvec4(
      screen.speed_mps < kDown_mps ? -1.0 : screen.speed_mps > kUp_mps ? 1.0 : 0.0,
      0.6 * std::clamp((screen.speed_mps - kDown_mps) / (kFullyDrawn_mps - kDown_mps), 0.0, 1.0),
      std::fmod(screen.time_s, kStrokes * double{shader::kRunsFor_s}), 0.0));
  return data;
}

}  // namespace

WindscreenPass::WindscreenPass(gpu::Device& device)
    : device_(device),
      sets_(device, std::span(&kScreenInput, 1)),
      light_layout_(pushing_layout(device, sets_.layout(), kVertexOrFragment, sizeof(shader::GpuScreenLight))),
      layout_(pushing_layout(device, sets_.layout(), kVertexOrFragment, sizeof(shader::GpuScreen))),
      sampler_(device.device, vk::SamplerCreateInfo{}) {
  const vk::raii::ShaderModule whole = gpu::make_shader(device, k_fullscreen_vert),
                               light = gpu::make_shader(device, k_windscreen_light_frag),
                               vertex = gpu::make_shader(device, k_windscreen_vert),
                               fragment = gpu::make_shader(device, k_windscreen_frag);
  light_ = make_pipeline(
      device, {.vertex = *whole, .fragment = *light, .colour = {kScreenFormat}, .layout = *light_layout_});
  drops_ = make_pipeline(
      device, {.vertex = *vertex, .fragment = *fragment, .colour = {kScreenFormat}, .over = true, .layout = *layout_});
}

void WindscreenPass::begin_frame() {
  sets_.begin_frame();
}

vk::DescriptorSet WindscreenPass::reads(const gpu::Image& image) {
  const vk::DescriptorImageInfo input{*sampler_, *image.view, vk::ImageLayout::eShaderReadOnlyOptimal};
  const vk::DescriptorSet set = sets_.make();
  device_.device.updateDescriptorSets(
      vk::WriteDescriptorSet{.dstSet = set,
                             .dstBinding = 0,
                             .descriptorCount = 1,
                             .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                             .pImageInfo = &input},
      nullptr);
  return set;
}

void WindscreenPass::draw(const PictureDraw& at) {
  using Use = vk::ImageUsageFlagBits;
  gpu::FrameGraph& graph = at.graph;
  gpu::Image& hdr_cdm2 = at.picture;
  const vk::Rect2D area = at.area;
  gpu::Image& light = graph.image("windscreen", {kScreenFormat, kScreenExtent, Use::eColorAttachment | Use::eSampled});
  const shader::GpuScreenLight light_data = light_of(at.geometry, area, at.glare);
  const shader::GpuScreen data = screen_of(at.geometry, area, *at.input.windscreen, at.input.air);
  const auto begin = [](gpu::Recorder& commands, const gpu::Image& target, const vk::Rect2D& part,
                        vk::AttachmentLoadOp load) {
    const vk::RenderingAttachmentInfo colour =
        attachment(target, vk::ImageLayout::eColorAttachmentOptimal, load, vk::ClearValue{});
    commands.beginRendering(vk::RenderingInfo{
        .renderArea = part, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &colour});
  };
  const vk::DescriptorSet picture = reads(hdr_cdm2), of_drops = reads(light);
  graph.pass("windscreen light", {{&hdr_cdm2, gpu::Use::kSampled, false}, {&light, gpu::Use::kColourTarget, true}},
             [&](gpu::Recorder& commands) {
               begin(commands, light, {{0, 0}, kScreenExtent}, vk::AttachmentLoadOp::eDontCare);
               set_area(commands, kScreenExtent);
               commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *light_);
               commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *light_layout_, 0, picture, nullptr);
               commands.pushConstants<shader::GpuScreenLight>(*light_layout_, kVertexOrFragment, 0, light_data);
               commands.draw(3, 1, 0, 0);
               commands.endRendering();
             });
  graph.pass("windscreen", {{&light, gpu::Use::kSampledByVertices, false}, {&hdr_cdm2, gpu::Use::kColourTarget, false}},
             [&](gpu::Recorder& commands) {
               begin(commands, hdr_cdm2, area, vk::AttachmentLoadOp::eLoad);
               set_area(commands, area);
               commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *drops_);
               commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, of_drops, nullptr);
               commands.pushConstants<shader::GpuScreen>(*layout_, kVertexOrFragment, 0, data);
               commands.draw(6 * shader::kScreenPlaces, 1, 0, 0);
               commands.endRendering();
             });
  graph.release(light);
}

}  // namespace phare
