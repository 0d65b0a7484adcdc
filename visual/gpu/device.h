// Instance, device, queue, memory. One queue for everything; dedicated allocations, of which a renderer of this size
// has tens.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "visual/gpu/vulkan.h"

namespace phare::gpu {

/// The device whose name contains `wanted`; empty: a discrete GPU before others. Throws when there is none.
vk::raii::PhysicalDevice pick_device(const vk::raii::Instance& instance, const std::string& wanted);

/// Bytes of device memory that live now; every allocation counts itself in and out.
using MemoryCount = std::shared_ptr<std::uint64_t>;

/// Device memory that is counted while it lives.
class Memory {
 public:
  Memory() = default;
  Memory(vk::raii::DeviceMemory memory, vk::DeviceSize bytes, MemoryCount count)
      : memory_(std::move(memory)), bytes_(bytes), count_(std::move(count)) {
    *count_ += bytes_;
  }
  Memory(Memory&& other) noexcept
      : memory_(std::move(other.memory_)), bytes_(std::exchange(other.bytes_, 0)), count_(std::move(other.count_)) {}
  Memory& operator=(Memory&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    std::swap(count_, other.count_);
    return *this;
  }
  ~Memory() {
    if (count_) *count_ -= bytes_;
  }
  vk::DeviceMemory operator*() const { return *memory_; }
  const vk::raii::DeviceMemory* operator->() const { return &memory_; }

 private:
  vk::raii::DeviceMemory memory_{nullptr};
  vk::DeviceSize bytes_ = 0;
  MemoryCount count_;
};

struct DeviceOptions {
  bool validation = false;
  std::vector<const char*> instance_extensions{};  ///< what a window needs
  std::string device_name{};  ///< part of the name of the wanted device; empty: the first discrete GPU, else any
  bool float64 = true;        ///< false: as if the device had no shaderFloat64
  bool multi_draw = true;     ///< false: as if it had no VK_EXT_multi_draw
  bool processor_depths = true;  ///< false: one that is the processor draws depths itself, as others do
};

/// So many frames may be on their way to the device: one is recorded while it draws the one before.
inline constexpr std::size_t kMostFramesInFlight = 2;

/// Draws that differ in their triangles alone, in one call (VK_EXT_multi_draw).
struct MultiDraw {
  PFN_vkCmdDrawMultiIndexedEXT draw = nullptr;  ///< none: the device has no such call
  std::uint32_t most = 0;                       ///< draws in one
};

/// Throws vk::SystemError or std::runtime_error; the renderer turns these into a Result at its border.
class Device {
 public:
  explicit Device(const DeviceOptions& options);

  vk::raii::Context context;
  vk::raii::Instance instance{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
  vk::raii::PhysicalDevice physical{nullptr};
  vk::raii::Device device{nullptr};
  std::uint32_t queue_family = 0;
  std::uint64_t stamp_bits = 0;  ///< those of a time stamp that count, of which a card may have 36; 0: it has no stamps
  vk::raii::Queue queue{nullptr};
  vk::raii::CommandPool command_pool{nullptr};
  vk::PhysicalDeviceProperties properties{};
  std::string driver;
  bool float64 = false;       ///< shaderFloat64 is there and enabled
  float most_anisotropy = 1.0f;  ///< of a sampler
  MultiDraw multi_draw;
  bool processor_depths = false;  ///< it is the processor, which draws depths faster without it
  bool primitive_id = false;  ///< fragments know their triangle: geometryShader is there and enabled
  std::shared_ptr<std::atomic<std::uint64_t>> validation_messages = std::make_shared<std::atomic<std::uint64_t>>(0);
  MemoryCount allocated_bytes = std::make_shared<std::uint64_t>(0);
  std::shared_ptr<std::uint64_t> pipelines_made = std::make_shared<std::uint64_t>(0);
  std::size_t frame = 0;       ///< which of kMostFramesInFlight is recorded, or was last; 0 where one goes at a time
  bool frames_on_way = false;  ///< some that were submitted have not been waited for

  /// Until nothing that frames before have left is read any more: for what is made anew or freed, which is rare.
  void wait_for_frames();
  Memory allocate(const vk::MemoryRequirements& need, vk::MemoryPropertyFlags flags);
  /// Records, submits and waits.
  void run_once(const std::function<void(vk::CommandBuffer)>& record);
  void name(vk::ObjectType type, std::uint64_t handle, const std::string& text) const;
};

/// One for each frame that may be on its way: the one that is being recorded has nothing in it that the device reads.
template <typename T>
class PerFrame {
 public:
  explicit PerFrame(const Device& device) : frame_(&device.frame) {}
  T& operator*() { return each_[*frame_]; }
  const T& operator*() const { return each_[*frame_]; }
  T* operator->() { return &**this; }
  const T* operator->() const { return &**this; }
  std::array<T, kMostFramesInFlight>& all() { return each_; }
  const T& of(std::size_t frame) const { return each_[frame]; }

 private:
  const std::size_t* frame_;
  std::array<T, kMostFramesInFlight> each_{};
};

/// A buffer the CPU can write (or read) all the time.
struct HostBuffer {
  Memory memory;
  vk::raii::Buffer buffer{nullptr};
  vk::DeviceSize bytes = 0;
  void* data = nullptr;

  HostBuffer() = default;
  /// `read_back`: prefer cached memory, for the CPU reads what the GPU wrote.
  HostBuffer(Device& device, vk::DeviceSize bytes, vk::BufferUsageFlags usage, const std::string& name,
             bool read_back = false);
};

/// A buffer in device memory, filled by copies.
struct DeviceBuffer {
  Memory memory;
  vk::raii::Buffer buffer{nullptr};
  vk::DeviceSize bytes = 0;

  DeviceBuffer() = default;
  DeviceBuffer(Device& device, vk::DeviceSize bytes, vk::BufferUsageFlags usage, const std::string& name);
  /// Filled, waits.
  DeviceBuffer(Device& device, std::span<const std::byte> content, vk::BufferUsageFlags usage, const std::string& name);
};

/// What an image has to be.
struct ImageNeed {
  vk::Format format = vk::Format::eUndefined;
  vk::Extent2D extent{};
  vk::ImageUsageFlags usage{};
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  std::uint32_t layers = 1;  ///< more than one: shaders see an array
  std::uint32_t mips = 1;

  friend bool operator==(const ImageNeed&, const ImageNeed&) = default;
};

/// A 2D image, or an array of them, with a view of all of it. The frame graph keeps its layout.
struct Image {
  Memory memory;  ///< none where the image lies in memory that the graph shares out
  vk::raii::Image image{nullptr};
  vk::raii::ImageView view{nullptr};
  std::vector<vk::raii::ImageView> parts;  ///< of each layer of each mip level, [mip][layer]; none where there is one
  vk::Format format = vk::Format::eUndefined;
  vk::Extent2D extent{};
  std::uint32_t layers = 1, mips = 1;
  vk::DeviceSize bytes = 0;
  vk::ImageAspectFlags aspect{};
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  std::string name;
  // Last use, for barriers.
  vk::ImageLayout layout = vk::ImageLayout::eUndefined;
  vk::PipelineStageFlags2 stage = vk::PipelineStageFlagBits2::eNone;
  vk::AccessFlags2 access = vk::AccessFlagBits2::eNone;

  Image() = default;
  Image(Device& device, vk::Format format, vk::Extent2D extent, vk::ImageUsageFlags usage, const std::string& name,
        vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1, std::uint32_t mip_levels = 1);
  /// Without memory: it and the views come with `bind`.
  Image(Device& device, const ImageNeed& need, const std::string& name);
  void bind(Device& device, vk::DeviceMemory at);

  /// One layer of one mip level, to draw into.
  vk::ImageView part(std::uint32_t layer, std::uint32_t mip) const {
    return parts.empty() ? *view : *parts[mip * layers + layer];
  }
};

/// Copies into a sampled image (usage eTransferDst), which fragments may read afterwards.
void record_fill(vk::CommandBuffer commands, Image& image, vk::Buffer from,
                 std::span<const vk::BufferImageCopy> copies);

vk::raii::ShaderModule make_shader(const Device& device, std::span<const std::uint32_t> spirv);

}  // namespace phare::gpu
