// The passes of one frame, in order. A pass says which images it reads and writes; barriers, time stamps and counts
// follow from that. The images of a frame are the graph's: made when a frame asks for them, freed when one does not;
// those whose lives do not overlap share memory.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "visual/gpu/device.h"

namespace phare::gpu {

/// Sampled and storage uses name the stage that reads or writes; a storage image is in the general layout.
enum class Use {
  kColourTarget,
  kDepthTarget,
  kDepthRead,
  kSampled,  ///< by fragments
  kSampledByVertices,
  kSampledByCompute,
  kStorageRead,   ///< by compute
  kStorageWrite,  ///< by compute, which may read it too
  kCopySource,
  kClearTarget,  ///< by a command of its own, not as it is drawn into
  kPresent
};

struct ImageUse {
  Image* image = nullptr;
  Use use = Use::kColourTarget;
  bool discard = false;  ///< what was in it is not needed
};

/// Of two time stamps of which the bits in `stamp_bits` count (Device): they begin anew where those end.
constexpr double ticks_between(std::uint64_t first, std::uint64_t last, std::uint64_t stamp_bits) {
  return static_cast<double>((last - first) & stamp_bits);
}

/// Passes and memory are counted for whoever calls for them; the graph knows of those only their number.
using Account = std::size_t;
inline constexpr Account kFrameAccount = 0;  ///< the frame itself
inline constexpr Account kAccounts = 32;

/// What a frame did for one account.
struct AccountCounts {
  std::uint32_t passes = 0;       ///< that draw
  std::uint64_t image_bytes = 0;  ///< of its images, also where they use the memory of others
  std::uint64_t kept_bytes = 0;   ///< of what its passes keep for themselves
};

/// What a frame did, counted where it is recorded.
struct Counts {
  std::uint32_t passes = 0;        ///< that draw
  std::uint32_t copies = 0;        ///< passes that only copy
  std::uint32_t draws = 0;         ///< draw commands, those of the overlay's library left out
  std::uint32_t binds = 0;         ///< of pipelines, sets, vertices and indices, those of that library left out
  std::uint64_t triangles = 0;     ///< of them
  std::uint32_t images = 0;        ///< images of the frame that live
  std::uint64_t image_bytes = 0;   ///< memory they take
  std::uint64_t shared_bytes = 0;  ///< memory they would take besides, if none used that of another after it
  std::array<AccountCounts, kAccounts> accounts{};

  /// What was recorded since `before`, of the same frame; not by accounts.
  Counts since(const Counts& before) const {
    return {.passes = passes - before.passes,
            .copies = copies - before.copies,
            .draws = draws - before.draws,
            .binds = binds - before.binds,
            .triangles = triangles - before.triangles};
  }
};

/// The commands of one pass; what it draws and binds is counted.
class Recorder : public vk::CommandBuffer {
 public:
  Recorder(vk::CommandBuffer commands, Counts& counts, const MultiDraw& multi_draw)
      : vk::CommandBuffer(commands), counts_(counts), multi_draw_(multi_draw) {}
  void draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex, std::uint32_t first_instance) {
    count(vertices, instances);
    vk::CommandBuffer::draw(vertices, instances, first_vertex, first_instance);
  }
  void drawIndexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                   std::int32_t vertex_offset, std::uint32_t first_instance) {
    count(indices, instances);
    vk::CommandBuffer::drawIndexed(indices, instances, first_index, vertex_offset, first_instance);
  }
  void bindPipeline(vk::PipelineBindPoint point, vk::Pipeline pipeline) {
    ++counts_.binds;
    vk::CommandBuffer::bindPipeline(point, pipeline);
  }
  void bindDescriptorSets(vk::PipelineBindPoint point, vk::PipelineLayout layout, std::uint32_t first,
                          const vk::ArrayProxy<const vk::DescriptorSet>& sets,
                          const vk::ArrayProxy<const std::uint32_t>& offsets) {
    ++counts_.binds;
    vk::CommandBuffer::bindDescriptorSets(point, layout, first, sets, offsets);
  }
  void bindVertexBuffers(std::uint32_t first, const vk::ArrayProxy<const vk::Buffer>& buffers,
                         const vk::ArrayProxy<const vk::DeviceSize>& offsets) {
    ++counts_.binds;
    vk::CommandBuffer::bindVertexBuffers(first, buffers, offsets);
  }
  void bindIndexBuffer(vk::Buffer buffer, vk::DeviceSize offset, vk::IndexType type) {
    ++counts_.binds;
    vk::CommandBuffer::bindIndexBuffer(buffer, offset, type);
  }
  /// One instance of each, in their order: one call where the device takes them so.
  void drawIndexed(std::span<const vk::MultiDrawIndexedInfoEXT> draws);

 private:
  void count(std::uint32_t vertices, std::uint32_t instances) {
    ++counts_.draws;
    counts_.triangles += std::uint64_t{vertices} / 3 * instances;
  }
  Counts& counts_;
  const MultiDraw& multi_draw_;
};

class FrameGraph {
 public:
  explicit FrameGraph(Device& device);

  /// Starts a frame: records into `commands` from here on. Of the frames before, that of the same number is done.
  void begin(vk::CommandBuffer commands);
  /// Goes before the names of the passes that follow, to tell views apart.
  void set_prefix(const std::string& prefix) { prefix_ = prefix; }
  /// The passes, images and memory that follow are counted for it. A frame begins with its own.
  void set_account(Account account) { account_ = account; }
  /// Memory that a pass keeps for itself, over frames: a buffer, or an image of its own. Told twice in a frame, it is
  /// counted once.
  void count_kept(const void* what, vk::DeviceSize bytes);
  /// An image of this frame by its name; what is in it is left from an earlier frame at best. The reference holds until
  /// the end of the frame. An image of another need takes the place of one of the same name. Asked for twice in a frame
  /// it is the same image, unless its need changed or its memory went to another.
  Image& image(const std::string& name, const ImageNeed& need);
  /// No pass after this one reads the image: its memory may serve images asked for later in this frame.
  void release(const Image& image);
  /// One pass: barriers for its images, then `record`, between two time stamps.
  void pass(const std::string& name, const std::vector<ImageUse>& uses, const std::function<void(Recorder&)>& record);
  /// The same for one that only copies.
  void copy(const std::string& name, const std::vector<ImageUse>& uses, const std::function<void(Recorder&)>& record);
  /// A part of an image into a buffer that holds as many texels, for the processor.
  void read_back(Image& image, const vk::Rect2D& part, const HostBuffer& to);
  /// One that draws with the processor, now, into memory that the device does not read yet.
  void by_processor(const std::string& name, const std::function<void()>& draw);
  void end();

  /// Frees the images that the frame just recorded did not ask for. If there are some, frames are waited for.
  void free_unused();

  const Counts& counts() const { return counts_; }

  struct Timing {
    std::string name;
    Account account = kFrameAccount;
    double ms = 0.0;
  };
  /// Once the GPU is done with the frame of this number (Device::frame): milliseconds of each of its passes, on the
  /// device or the processor.
  std::vector<Timing> timings(std::size_t frame) const;
  /// From the first to the last time stamp of the device, ms.
  double total_ms(std::size_t frame) const;

 private:
  struct Held;
  /// Memory that images use one after the other.
  struct Slot {
    Memory memory;
    vk::DeviceSize bytes = 0;
    std::uint32_t types = 0;     ///< memory types of the image it was made for, as Vulkan's bits
    const Held* last = nullptr;  ///< what used it last
    bool taken = false;          ///< by an image of this frame, until that is released
    bool released = false;       ///< in this frame
  };
  struct Held {
    ImageNeed need;
    Image image;
    std::shared_ptr<Slot> slot;
    bool asked = false;
    Account account = kFrameAccount;  ///< that it was given to last
  };
  std::shared_ptr<Slot> slot_for(const vk::MemoryRequirements& need);
  void count_images();
  void record_pass(const std::string& name, const std::vector<ImageUse>& uses,
                   const std::function<void(Recorder&)>& record);
  void read_back_stamps();
  std::span<const std::uint64_t> read_stamps(std::size_t frame) const;

  struct Recorded {
    std::string name;
    Account account = kFrameAccount;
    std::optional<double> processor_ms{};  ///< it has no stamps
  };
  /// Of one frame.
  struct Passes {
    std::vector<vk::raii::QueryPool> stamps;  ///< each of kPassesInPool passes; more are made when a frame needs them
    HostBuffer read;  ///< two stamps a pass, once the frame is done; asked of its pool, a device may wait for all frames
    std::vector<Recorded> passes;
    std::uint32_t stamped = 0;  ///< of those, by the device
  };

  Device& device_;
  PerFrame<Passes> recorded_{device_};
  vk::CommandBuffer commands_;
  std::string prefix_;
  Account account_ = kFrameAccount;
  std::vector<const void*> kept_;  ///< counted in this frame
  std::map<std::string, Held> images_;
  Counts counts_;
};

}  // namespace phare::gpu
