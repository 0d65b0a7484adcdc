// The passes of one frame, in order. A pass says which images it reads and writes; barriers, time stamps and counts
// follow from that. The images of a frame are the graph's: made when a frame asks for them, freed when one does not.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "visual/gpu/device.h"

namespace phare::gpu {

enum class Use { kColourTarget, kDepthTarget, kDepthRead, kSampled, kCopySource, kCopyTarget, kPresent };

struct ImageUse {
  Image* image = nullptr;
  Use use = Use::kColourTarget;
  bool discard = false;  ///< what was in it is not needed
};

/// What an image of a frame has to be.
struct ImageNeed {
  vk::Format format = vk::Format::eUndefined;
  vk::Extent2D extent{};
  vk::ImageUsageFlags usage{};
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;

  friend bool operator==(const ImageNeed&, const ImageNeed&) = default;
};

/// What a frame did, counted where it is recorded.
struct Counts {
  std::uint32_t passes = 0;     ///< that draw
  std::uint32_t copies = 0;     ///< passes that only copy
  std::uint32_t draws = 0;      ///< draw commands, those of the overlay's library left out
  std::uint64_t triangles = 0;  ///< of them
  std::uint32_t images = 0;     ///< images of the frame that live
  std::uint64_t image_bytes = 0;
};

/// The commands of one pass; what it draws is counted.
class Recorder : public vk::CommandBuffer {
 public:
  Recorder(vk::CommandBuffer commands, Counts& counts) : vk::CommandBuffer(commands), counts_(counts) {}
  void draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex, std::uint32_t first_instance) {
    count(vertices, instances);
    vk::CommandBuffer::draw(vertices, instances, first_vertex, first_instance);
  }
  void drawIndexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                   std::int32_t vertex_offset, std::uint32_t first_instance) {
    count(indices, instances);
    vk::CommandBuffer::drawIndexed(indices, instances, first_index, vertex_offset, first_instance);
  }

 private:
  void count(std::uint32_t vertices, std::uint32_t instances) {
    ++counts_.draws;
    counts_.triangles += std::uint64_t{vertices} / 3 * instances;
  }
  Counts& counts_;
};

class FrameGraph {
 public:
  explicit FrameGraph(Device& device);

  /// Starts a frame: records into `commands` from here on. The frame before is done.
  void begin(vk::CommandBuffer commands);
  /// An image of this frame by its name; what is in it is left from an earlier frame at best. The reference holds until
  /// the end of the frame. An image of another need takes the place of one of the same name.
  Image& image(const std::string& name, const ImageNeed& need);
  /// One pass: barriers for its images, then `record`, between two time stamps.
  void pass(const std::string& name, const std::vector<ImageUse>& uses, const std::function<void(Recorder&)>& record);
  /// The same for one that only copies.
  void copy(const std::string& name, const std::vector<ImageUse>& uses, const std::function<void(Recorder&)>& record);
  void end();

  /// Frees the images that the frame just recorded did not ask for. Its predecessors are done; it need not be.
  void free_unused();

  const Counts& counts() const { return counts_; }

  struct Timing {
    std::string name;
    double ms = 0.0;
  };
  /// After the GPU is done: milliseconds of each pass of the last frame.
  std::vector<Timing> timings() const;
  /// From the first to the last time stamp, ms.
  double total_ms() const;

 private:
  struct Held {
    ImageNeed need;
    Image image;
    bool asked = false;
  };
  void record_pass(const std::string& name, const std::vector<ImageUse>& uses,
                   const std::function<void(Recorder&)>& record);

  Device& device_;
  vk::raii::QueryPool stamps_{nullptr};
  vk::CommandBuffer commands_;
  std::vector<std::string> names_;
  std::map<std::string, Held> images_;
  Counts counts_;
};

}  // namespace phare::gpu
