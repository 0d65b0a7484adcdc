#include "visual/renderer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <utility>

#include "visual/audit_picture.h"
#include "visual/effects_of_frame.h"
#include "visual/frame.h"
#include "visual/gpu/submissions.h"
#include "visual/gpu/window_surface.h"
#include "visual/passes/measure.h"
#include "visual/picture_memory.h"
#include "visual/reference_light.h"

namespace phare {

namespace {

gpu::DeviceOptions device_options(const RendererOptions& options) {
  gpu::DeviceOptions result{.validation = options.validation,
                            .device_name = options.device_name,
                            .float64 = options.float64,
                            .multi_draw = options.multi_draw,
                            .processor_depths = options.processor_depths};
  if (options.window != nullptr) {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) throw std::runtime_error("GLFW finds no Vulkan surface on this display");
    result.instance_extensions.assign(names, names + count);
  }
  return result;
}

/// Something of the frame is read back.
bool is_kept(const FrameInput& input) {
  const auto kept = [](const ViewInput& view) { return view.want_image || view.want_hdr; };
  return kept(input) || std::ranges::any_of(input.more_views, kept);
}

/// Passes of the frame as it was counted; images are counted when those that it did not ask for are gone.
EffectCost cost_of(gpu::Account account, const gpu::Counts& frame, const gpu::Counts& held) {
  return {.passes = frame.accounts[account].passes,
          .bytes = held.accounts[account].image_bytes + frame.accounts[account].kept_bytes};
}

/// As shaders/reference.h has them.
std::vector<double> relative_points(std::span<const MeasurePoint> points, const glm::dvec3& eye_m) {
  std::vector<double> words;
  words.reserve(shader::kReferencePointWords * points.size());
  for (const MeasurePoint& point : points) {
    const glm::dvec3 from_eye_m = point.position_m - eye_m, normal = glm::normalize(point.normal);
    words.insert(words.end(), {from_eye_m.x, from_eye_m.y, from_eye_m.z, normal.x, normal.y, normal.z});
  }
  return words;
}

}  // namespace

struct Renderer::Impl {
  /// Texels of a part of an image, for the processor.
  struct Copy {
    gpu::HostBuffer buffer;
    vk::Extent2D extent{};
  };
  static const Copy& copy_of(const std::map<std::size_t, Copy>& copies, std::size_t view) {
    const auto found = copies.find(view);
    if (found == copies.end()) throw std::logic_error("the newest frame has kept no picture of this view");
    return found->second;
  }

  RendererOptions options;
  gpu::Device device;
  gpu::FrameGraph graph{device};
  std::unique_ptr<gpu::WindowSurface> surface =
      options.window == nullptr
          ? nullptr
          : std::make_unique<gpu::WindowSurface>(device, options.window, options.frames_in_flight);
  LitScene scene{device, options.beam_level};
  ShadowPass shadows{device};
  FogPass fog{device};
  DepthPass depth{device};
  LitPass lit{device};
  GlarePass glare{device};
  ToneMappingPass tone_mapping{device};
  PictureEffects picture_effects{device};
  std::unique_ptr<OverlayPass> overlay;
  GuiPass gui{device};
  FrameTarget target;
  std::map<std::size_t, Copy> images, hdrs;  ///< read back, by view
  gpu::Submissions submissions{device, graph, surface.get()};
  struct Audit {
    std::optional<ViewInput> asked{};       ///< with the next frame
    std::unique_ptr<AuditPicture> drawn{};  ///< until it is taken
    std::size_t by = 0;                     ///< the frame it was drawn with
    bool on_way = false;                    ///< which is not done
  } audit;

  explicit Impl(const RendererOptions& wanted) : options(wanted), device(device_options(wanted)) {
    set_target(options.width_px, options.height_px);
    set_scene(Scene{}, Scene{}, std::make_shared<FixedLight>());
  }

  ~Impl() {
    if (!*device.device) return;
    try {
      device.device.waitIdle();
    } catch (const vk::SystemError&) {
      return;  // of a device that was lost nothing is left to wait for
    }
  }

  /// Of a software device the machine's memory: its heap is any number.
  std::uint64_t device_bytes() const {
    if (device.properties.deviceType == vk::PhysicalDeviceType::eCpu)
      return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    std::uint64_t most = 0;
    const vk::PhysicalDeviceMemoryProperties memory = device.physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
      if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
        most = std::max<std::uint64_t>(most, memory.memoryHeaps[i].size);
    return most;
  }

  void set_target(int width_px, int height_px) {
    vk::Extent2D extent{static_cast<std::uint32_t>(width_px), static_cast<std::uint32_t>(height_px)};
    if (surface) extent = surface->extent();
    if (const auto why = too_large(extent.width, extent.height, options.samples, device_bytes()))
      throw std::runtime_error(*why);
    submissions.finish();
    device.device.waitIdle();
    target = {extent, options.samples > 1 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1,
              surface ? surface->format() : vk::Format::eR8G8B8A8Unorm};
  }

  void set_scene(const Scene& new_scene, const Scene& moving, std::shared_ptr<const FixedLight> light,
                 const Progress& progress = {}) {
    submissions.finish();
    device.device.waitIdle();
    SceneBuffers buffers(device, new_scene, moving, *light, progress);
    ShadowCasters casters(new_scene, moving, std::move(buffers.far_casters));
    scene.set_geometry(std::move(buffers), std::move(casters), std::move(light));
  }

  /// Lavapipe shows a picture when all is done that was submitted before: the next frame is recorded meanwhile, and
  /// submitted after.
  bool shows_in_turn() const { return surface && device.properties.deviceType == vk::PhysicalDeviceType::eCpu; }

  void copy_out(gpu::Image& image, const vk::Rect2D& part, Copy& copy, vk::DeviceSize bytes_per_texel) {
    copy.extent = part.extent;
    const vk::DeviceSize bytes = bytes_per_texel * part.extent.width * part.extent.height;
    if (copy.buffer.bytes != bytes) {
      device.wait_for_frames();
      copy.buffer = gpu::HostBuffer(device, bytes, vk::BufferUsageFlagBits::eTransferDst, image.name + " copy", true);
    }
    graph.read_back(image, part, copy.buffer);
  }
  void copy_out(gpu::Image& image, Copy& copy, vk::DeviceSize bytes_per_texel) {
    copy_out(image, {{0, 0}, image.extent}, copy, bytes_per_texel);
  }

  void draw_audit() {
    if (!audit.asked) return;
    if (audit.on_way) device.wait_for_frames();  // nobody took the one before
    audit.drawn = std::make_unique<AuditPicture>(device, target.extent);
    audit.drawn->draw(graph, scene, *audit.asked);
    audit.asked.reset();
    audit.by = device.frame;
    audit.on_way = true;
  }
  /// Not after another frame has taken its number: draw() asks in time.
  void end_audit() { audit.on_way = audit.on_way && submissions.on_way(audit.by); }

  /// Copies of further views go when a frame does not ask for them; those of the frame's own view are used again.
  void forget_copies(const FrameInput& input) {
    const auto unasked = [&](std::size_t view, bool ViewInput::*wanted) {
      return view > 0 && (view > input.more_views.size() || !(input.more_views[view - 1].*wanted));
    };
    const auto forget = [&](std::map<std::size_t, Copy>& copies, bool ViewInput::*wanted) {
      for (auto copy = copies.begin(); copy != copies.end();) {
        const bool gone = unasked(copy->first, wanted);
        if (gone) device.wait_for_frames();
        copy = gone ? copies.erase(copy) : std::next(copy);
      }
    };
    forget(images, &ViewInput::want_image);
    forget(hdrs, &ViewInput::want_hdr);
  }

  FrameParts parts() { return parts_for(target); }
  FrameParts parts_for(const FrameTarget& of) {
    return {.device = device,
            .graph = graph,
            .target = of,
            .scene = scene,
            .shadows = shadows,
            .fog = fog,
            .depth = depth,
            .lit = lit,
            .glare = glare,
            .tone_mapping = tone_mapping,
            .picture_effects = picture_effects,
            .overlay = overlay,
            .gui = gui,
            .read_image = [this](std::size_t view, gpu::Image& image,
                                 const vk::Rect2D& part) { copy_out(image, part, images[view], 4); },
            .read_hdr = [this](std::size_t view, gpu::Image& image,
                               const vk::Rect2D& part) { copy_out(image, part, hdrs[view], 8); },
            .device_facts = {.shadow_maps = shadows.possible(), .shadow_rays = shadows.rays_possible(scene)}};
  }
};

Result<Renderer> Renderer::create(const RendererOptions& options) {
  const std::uint32_t largest = 16384;
  if (options.width_px < 1 || options.height_px < 1 || options.width_px > static_cast<int>(largest) ||
      options.height_px > static_cast<int>(largest))
    return Error{"picture size", "width and height have to be 1 to 16384 pixels"};
  constexpr std::int64_t kMostPixels = 1 << 27;  // 8 GB with 4 samples
  if (std::int64_t{options.width_px} * options.height_px > kMostPixels)
    return Error{"picture size", std::to_string(options.width_px) + " × " + std::to_string(options.height_px) +
                                     " is more than " + std::to_string(kMostPixels) + " pixels"};
  if (options.frames_in_flight < 1 || options.frames_in_flight > gpu::kMostFramesInFlight)
    return Error{"frames in flight", "1 or " + std::to_string(gpu::kMostFramesInFlight)};
  if (options.samples != 1 && options.samples != 4) return Error{"samples", "1 or 4 samples a pixel"};
  try {
    return Renderer(std::make_unique<Impl>(options));
  } catch (const vk::DeviceLostError&) {  // no fault of what was given
    throw;
  } catch (const std::exception& error) {
    return Error{"vulkan", error.what()};
  }
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Status Renderer::load_scene(const Scene& scene) {
  return load_scene(scene, Scene{});
}

Status Renderer::load_scene(const Scene& scene, const Scene& moving, const Progress& progress) {
  return load_scene(scene, moving, std::make_shared<FixedLight>(), progress);
}

Status Renderer::load_scene(const Scene& scene, const Scene& moving, std::shared_ptr<const FixedLight> light,
                            const Progress& progress) {
  try {
    impl_->set_scene(scene, moving, std::move(light), progress);
    return Done{};
  } catch (const vk::DeviceLostError&) {  // no fault of what was given
    throw;
  } catch (const std::exception& error) {
    return Error{scene.file.string(), error.what()};
  }
}

void Renderer::set_beam(std::size_t index, const BeamImage& image) {
  impl_->scene.set_beam(index, image);
}

void Renderer::change_beam(std::size_t index, const BeamImage& image, std::span<const TexelRect> changed) {
  impl_->scene.change_beam(index, image, changed);
}

void Renderer::resize(int width_px, int height_px) {
  impl_->submissions.finish();
  if (impl_->surface) impl_->surface->rebuild();
  impl_->set_target(width_px, height_px);
}

PictureSize Renderer::picture_size() const {
  const vk::Extent2D extent = impl_->target.extent;
  return {static_cast<int>(extent.width), static_cast<int>(extent.height)};
}

FrameResult Renderer::draw(const FrameInput& input) {
  using Clock = gpu::Submissions::Clock;
  const auto begun = Clock::now();
  gpu::Submissions& submissions = impl_->submissions;
  if (submissions.take_misfit()) resize(0, 0);  // not before: what the newest frame has kept is still read
  FrameParts parts = impl_->parts();
  FrameResult result;
  gpu::Image* display = nullptr;
  const std::uint64_t pipelines_before = *impl_->device.pipelines_made;
  impl_->forget_copies(input);
  if (impl_->options.frames_in_flight > 1) impl_->device.frame = submissions.other_frame();
  gpu::Counts counts;  // of the frame alone
  submissions.submit([&] {
    result.views = draw_frame(parts, input, display);
    counts = impl_->graph.counts();
    impl_->draw_audit();
    if (impl_->shows_in_turn()) submissions.finish(submissions.other_frame());
  });
  submissions.mark_frame(begun, is_kept(input));
  result.pipelines_made = *impl_->device.pipelines_made - pipelines_before;
  submissions.finish(submissions.other_frame());
  submissions.take_picture(*display);
  if (impl_->options.frames_in_flight == 1 || result.pipelines_made > 0) submissions.finish();
  impl_->end_audit();
  impl_->graph.free_unused();

  result.effects = plan_over(result.views);
  result.draws = counts.draws;
  result.binds = counts.binds;
  result.pass_count = counts.passes;
  result.triangles = counts.triangles;
  const gpu::Counts& held = impl_->graph.counts();
  result.images = held.images;
  result.image_bytes = held.image_bytes;
  result.shared_image_bytes = held.shared_bytes;
  result.other_cost = cost_of(gpu::kFrameAccount, counts, held);
  for (const EffectRow& row : effect_table())
    result.effect_costs[static_cast<std::size_t>(row.effect)] = cost_of(account_of(row.effect), counts, held);
  auto times = submissions.take_times();
  result.timed = times.has_value();
  if (times) {
    // When the frame before was done is not known, where this one made pipelines first: all of the call is its own.
    if (result.pipelines_made > 0)
      times->wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    result.wall_ms = times->wall_ms;
    result.gpu_ms = times->gpu_ms;
    result.timed_kept = times->kept;
    for (gpu::FrameGraph::Timing& pass : times->passes) {
      result.passes.push_back({.name = std::move(pass.name), .ms = pass.ms});
      if (pass.account != gpu::kFrameAccount) result.passes.back().effect = effect_of(pass.account);
    }
  }
  return result;
}

Rehearsal Renderer::rehearse(const FrameInput& input, std::size_t most, bool audited) {
  FrameInput seen = input;
  seen.overlay.clear(), seen.instruments.clear();
  seen.panel = {}, seen.marks = {}, seen.gui = nullptr;
  seen.want_image = seen.want_hdr = false;
  for (ViewInput& view : seen.more_views) view.want_image = view.want_hdr = false;
  FrameTarget few = impl_->target;
  few.name = "rehearsal: ", few.seen = false;
  few.extent.width = std::min(few.extent.width, 64u);
  few.extent.height = std::min(few.extent.height, 36u);
  FrameParts parts = impl_->parts_for(few);
  gpu::Image* display = nullptr;
  const std::uint64_t before = *impl_->device.pipelines_made;
  impl_->scene.begin_rehearsal(most);
  const std::uint64_t taken = *impl_->device.pipelines_made - before;
  std::size_t left = 0;
  try {
    impl_->submissions.submit_and_wait([&] {
      draw_frame(parts, seen, display);
      if (audited) AuditPicture::prepare(impl_->scene, seen, impl_->target.extent);
    });
    left = impl_->scene.end_rehearsal();
  } catch (...) {
    (void)impl_->scene.end_rehearsal();
    throw;
  }
  return {*impl_->device.pipelines_made - before - taken, taken, left};
}

bool Renderer::is_making() const {
  return impl_->scene.is_making();
}

void Renderer::finish() {
  impl_->submissions.finish();
}

bool Renderer::finish_within(std::chrono::nanoseconds most) {
  return impl_->submissions.finish_within(most);
}

bool Renderer::has_kept() const {
  return impl_->submissions.has_kept();
}

Image8 Renderer::read_image(std::size_t view) const {
  impl_->submissions.finish_kept();
  const Impl::Copy& copy = Impl::copy_of(impl_->images, view);
  Image8 image{static_cast<int>(copy.extent.width), static_cast<int>(copy.extent.height), {}};
  const auto* texels = static_cast<const std::uint8_t*>(copy.buffer.data);
  image.rgba.assign(texels, texels + copy.buffer.bytes);
  // Four bytes at once, the first lowest (x86): a picture of 3840 x 2160 is read between two frames.
  const bool blue_first = impl_->target.display_format == vk::Format::eB8G8R8A8Unorm;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    std::uint32_t pixel = 0;
    std::memcpy(&pixel, &image.rgba[i], 4);
    if (blue_first) pixel = (pixel & 0xff00u) | (pixel & 0xffu) << 16 | (pixel >> 16 & 0xffu);
    pixel |= 0xff000000u;
    std::memcpy(&image.rgba[i], &pixel, 4);
  }
  return image;
}

ImageF Renderer::read_hdr(std::size_t view) const {
  impl_->submissions.finish_kept();
  const Impl::Copy& copy = Impl::copy_of(impl_->hdrs, view);
  ImageF image{static_cast<int>(copy.extent.width), static_cast<int>(copy.extent.height), {}};
  const auto* half = static_cast<const std::uint16_t*>(copy.buffer.data);
  const std::size_t count = copy.buffer.bytes / 2;
  image.rgba.resize(count);
  std::transform(half, half + count, image.rgba.begin(), float_from_half);
  return image;
}

std::vector<std::vector<float>> Renderer::measure(std::span<const PlacedLamp> lamps,
                                                  std::span<const MeasurePoint> points, std::size_t shadows,
                                                  Method method) {
  std::vector<std::vector<float>> result(lamps.size(), std::vector<float>(points.size(), 0.0f));
  if (lamps.empty() || points.empty()) return result;
  constexpr std::size_t kWidth = 1024, kBatch = 1024 * 256;
  // Coordinates are relative to the lamps, so float32 serves anywhere in the world.
  Camera camera;
  camera.eye_m = lamps.front().position_m;
  for (std::size_t begin = 0; begin < points.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, points.size() - begin);
    std::vector<GpuVertex> vertices;
    vertices.reserve(count);
    for (const MeasurePoint& point : points.subspan(begin, count))
      vertices.push_back({glm::vec3(point.position_m - camera.eye_m), glm::vec3(glm::normalize(point.normal)), 0});
    const gpu::DeviceBuffer buffer(impl_->device, std::as_bytes(std::span(vertices)),
                                   vk::BufferUsageFlagBits::eVertexBuffer, "points");
    std::vector<double> exact;
    if (method == Method::kReference) exact = relative_points(points.subspan(begin, count), camera.eye_m);
    const vk::Extent2D extent{kWidth, static_cast<std::uint32_t>((count + kWidth - 1) / kWidth)};
    gpu::Image lx(impl_->device, vk::Format::eR32G32B32A32Sfloat, extent,
                  vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc, "lx");
    Impl::Copy copy;
    // One lamp at a time: what each gives is asked for, dark ones included.
    for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp) {
      if (impl_->scene.is_dark(lamps[lamp].beam)) continue;
      impl_->submissions.submit_and_wait([&] {
        impl_->scene.begin_frame(impl_->graph);
        LitView view = impl_->scene.view_of_points(ViewGeometry(camera, 1.0), lamps.subspan(lamp, 1));
        view.method = method;
        if (method == Method::kReference) impl_->scene.set_reference_points(exact);
        if (shadows > 0) {
          if (kShadowLevels[shadows].by_rays() && !impl_->shadows.rays_possible(impl_->scene))
            throw std::runtime_error("shadows by rays: the device holds no buffer as large as the scene's triangles");
          impl_->shadows.begin_frame();
          if (kShadowLevels[shadows].by_rays() || impl_->scene.find_casters(view) > 0)
            impl_->shadows.draw(impl_->graph, impl_->scene, view, shadows);
        }
        measure_points(impl_->graph, impl_->scene, view, lx, *buffer.buffer, static_cast<std::uint32_t>(count), 0);
        impl_->copy_out(lx, copy, 16);
      });
      const auto* values = static_cast<const float*>(copy.buffer.data);
      for (std::size_t i = 0; i < count; ++i) result[lamp][begin + i] = values[4 * i];
    }
  }
  return result;
}

std::vector<AuditSample> Renderer::audit(const FrameInput& input, std::size_t count, std::uint64_t seed) {
  AuditPicture picture(impl_->device, impl_->target.extent);
  impl_->submissions.submit_and_wait([&] {
    impl_->scene.begin_frame(impl_->graph);
    picture.draw(impl_->graph, impl_->scene, input);
  });
  return picture.samples(count, seed);
}

void Renderer::prepare_audit(const ViewInput& view) {
  impl_->submissions.submit_and_wait([&] {
    impl_->scene.begin_frame(impl_->graph);
    AuditPicture::prepare(impl_->scene, view, impl_->target.extent);
  });
}

void Renderer::ask_audit(ViewInput view) {
  impl_->audit.asked = std::move(view);
}

std::optional<std::vector<AuditSample>> Renderer::take_audit(std::size_t count, std::uint64_t seed) {
  impl_->end_audit();
  if (!impl_->audit.drawn || impl_->audit.on_way) return std::nullopt;
  return std::exchange(impl_->audit.drawn, nullptr)->samples(count, seed);
}

std::optional<std::string> Renderer::no_reference() const {
  return phare::no_reference(impl_->device);
}
std::string Renderer::device() const {
  return std::string(impl_->device.properties.deviceName.data()) + ", " + impl_->device.driver;
}
std::size_t Renderer::frames_in_flight() const {
  return impl_->options.frames_in_flight;
}
std::uint64_t Renderer::device_memory_bytes() const {
  return *impl_->device.allocated_bytes;
}
std::uint64_t Renderer::uploaded_texels() const {
  return impl_->scene.uploaded_texels();
}
std::uint64_t Renderer::validation_messages() const {
  return impl_->device.validation_messages->load();
}

}  // namespace phare
