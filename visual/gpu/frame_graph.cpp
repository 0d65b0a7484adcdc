#include "visual/gpu/frame_graph.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>
#include <utility>

namespace phare::gpu {

namespace {

constexpr std::uint32_t kPassesInPool = 16;

struct State {
  vk::ImageLayout layout;
  vk::PipelineStageFlags2 stage;
  vk::AccessFlags2 access;
};

State state_of(Use use) {
  using Stage = vk::PipelineStageFlagBits2;
  using Access = vk::AccessFlagBits2;
  using Layout = vk::ImageLayout;
  const vk::PipelineStageFlags2 tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
  switch (use) {
    case Use::kColourTarget:
      return {Layout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
              Access::eColorAttachmentWrite | Access::eColorAttachmentRead};
    case Use::kDepthTarget:
      return {Layout::eDepthStencilAttachmentOptimal, tests,
              Access::eDepthStencilAttachmentWrite | Access::eDepthStencilAttachmentRead};
    case Use::kDepthRead:
      return {Layout::eDepthStencilReadOnlyOptimal, tests, Access::eDepthStencilAttachmentRead};
    case Use::kSampled:
      return {Layout::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead};
    case Use::kSampledByVertices:
      return {Layout::eShaderReadOnlyOptimal, Stage::eVertexShader, Access::eShaderSampledRead};
    case Use::kSampledByCompute:
      return {Layout::eShaderReadOnlyOptimal, Stage::eComputeShader, Access::eShaderSampledRead};
    case Use::kStorageRead:
      return {Layout::eGeneral, Stage::eComputeShader, Access::eShaderStorageRead};
    case Use::kStorageWrite:
      return {Layout::eGeneral, Stage::eComputeShader, Access::eShaderStorageWrite | Access::eShaderStorageRead};
    case Use::kCopySource:
      return {Layout::eTransferSrcOptimal, Stage::eCopy, Access::eTransferRead};
    case Use::kClearTarget:
      return {Layout::eTransferDstOptimal, Stage::eClear, Access::eTransferWrite};
    case Use::kPresent:
      return {Layout::ePresentSrcKHR, Stage::eBottomOfPipe, Access::eNone};
  }
  throw std::logic_error("image use");
}

}  // namespace

void Recorder::drawIndexed(std::span<const vk::MultiDrawIndexedInfoEXT> draws) {
  if (draws.size() < 2 || multi_draw_.draw == nullptr) {
    for (const vk::MultiDrawIndexedInfoEXT& one : draws)
      drawIndexed(one.indexCount, 1, one.firstIndex, one.vertexOffset, 0);
    return;
  }
  while (!draws.empty()) {
    const auto now = draws.first(std::min<std::size_t>(draws.size(), multi_draw_.most));
    draws = draws.subspan(now.size());
    std::uint32_t indices = 0;
    for (const vk::MultiDrawIndexedInfoEXT& one : now) indices += one.indexCount;
    count(indices, 1);
    multi_draw_.draw(*this, static_cast<std::uint32_t>(now.size()),
                     reinterpret_cast<const VkMultiDrawIndexedInfoEXT*>(now.data()), 1, 0, sizeof now.front(), nullptr);
  }
}

FrameGraph::FrameGraph(Device& device) : device_(device) {}

void FrameGraph::begin(vk::CommandBuffer commands) {
  commands_ = commands;
  prefix_.clear();
  account_ = kFrameAccount;
  kept_.clear();
  recorded_->passes.clear();
  recorded_->stamped = 0;
  counts_ = {};
  std::erase_if(images_, [](const auto& named) { return !named.second.slot; });  // making them failed
  for (auto& [name, held] : images_) held.asked = held.slot->taken = held.slot->released = false;
  for (const vk::raii::QueryPool& pool : recorded_->stamps) commands_.resetQueryPool(*pool, 0, 2 * kPassesInPool);
}

// The smallest that an image of this frame has left behind and that is large enough; else new memory.
std::shared_ptr<FrameGraph::Slot> FrameGraph::slot_for(const vk::MemoryRequirements& need) {
  std::shared_ptr<Slot> best;
  for (const auto& [name, held] : images_) {
    if (!held.slot || !held.slot->released || held.slot->bytes < need.size) continue;
    if ((held.slot->types & ~need.memoryTypeBits) != 0) continue;
    if (!best || held.slot->bytes < best->bytes) best = held.slot;
  }
  if (best) return best;
  best = std::make_shared<Slot>();
  best->memory = device_.allocate(need, vk::MemoryPropertyFlagBits::eDeviceLocal);
  best->bytes = need.size;
  best->types = need.memoryTypeBits;
  return best;
}

Image& FrameGraph::image(const std::string& name, const ImageNeed& need) {
  Held& held = images_[name];
  const bool there = held.slot && held.need == need;
  const bool in_use = held.slot && held.slot->taken && held.slot->last == &held;
  const bool free = held.slot && !held.slot->taken;
  if (there && in_use) return held.image;
  // Commands of this frame use the image of this name: another takes its part.
  if (held.asked && !(there && free)) return image(name + " again", need);
  if (!there || !free) {
    if (held.slot && held.slot->last == &held) held.slot->last = nullptr;
    if (held.slot) device_.wait_for_frames();
    held.image = {};  // first, so that both never take memory at once
    held.slot = nullptr;
    held.image = Image(device_, need, name);
    held.slot = slot_for(held.image.image.getMemoryRequirements());
    held.image.bind(device_, *held.slot->memory);
    held.need = need;
  }
  held.asked = held.slot->taken = true;
  held.account = account_;
  held.slot->released = false;
  if (const Held* last = std::exchange(held.slot->last, &held); last != nullptr && last != &held) {
    // What is in the memory is another image's, and its passes come first. Our own last use comes before those, but
    // synchronization validation does not see that.
    held.image.layout = vk::ImageLayout::eUndefined;
    held.image.stage |= last->image.stage;
    held.image.access |= last->image.access;
  }
  return held.image;
}

void FrameGraph::release(const Image& image) {
  for (auto& [name, held] : images_) {
    if (&held.image != &image) continue;
    held.slot->taken = false;
    held.slot->released = true;
  }
}

void FrameGraph::free_unused() {
  if (std::ranges::any_of(images_, [](const auto& named) { return !named.second.asked; })) device_.wait_for_frames();
  std::erase_if(images_, [](const auto& named) {
    const Held& held = named.second;
    if (!held.asked && held.slot && held.slot->last == &held) held.slot->last = nullptr;
    return !held.asked;
  });
  count_images();
}

void FrameGraph::count_images() {
  counts_.images = static_cast<std::uint32_t>(images_.size());
  counts_.image_bytes = counts_.shared_bytes = 0;
  for (AccountCounts& account : counts_.accounts) account.image_bytes = 0;
  std::set<const Slot*> slots;
  for (const auto& [name, held] : images_) {
    if (slots.insert(held.slot.get()).second) counts_.image_bytes += held.slot->bytes;
    counts_.shared_bytes += held.image.bytes;
    counts_.accounts[held.account].image_bytes += held.image.bytes;
  }
  counts_.shared_bytes -= std::min(counts_.shared_bytes, counts_.image_bytes);
}

void FrameGraph::count_kept(const void* what, vk::DeviceSize bytes) {
  if (std::ranges::find(kept_, what) != kept_.end()) return;
  kept_.push_back(what);
  counts_.accounts[account_].kept_bytes += bytes;
}

void FrameGraph::pass(const std::string& name, const std::vector<ImageUse>& uses,
                      const std::function<void(Recorder&)>& record) {
  ++counts_.passes;
  ++counts_.accounts[account_].passes;
  record_pass(name, uses, record);
}

void FrameGraph::copy(const std::string& name, const std::vector<ImageUse>& uses,
                      const std::function<void(Recorder&)>& record) {
  ++counts_.copies;
  record_pass(name, uses, record);
}

void FrameGraph::by_processor(const std::string& name, const std::function<void()>& draw) {
  ++counts_.passes;
  ++counts_.accounts[account_].passes;
  const auto begin = std::chrono::steady_clock::now();
  draw();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  recorded_->passes.push_back({prefix_ + name, account_, took.count()});
}

void FrameGraph::read_back(Image& image, const vk::Rect2D& part, const HostBuffer& to) {
  copy("read back " + image.name, {{&image, Use::kCopySource, false}}, [&](Recorder& commands) {
    commands.copyImageToBuffer(*image.image, vk::ImageLayout::eTransferSrcOptimal, *to.buffer,
                               vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                                   .imageOffset = {part.offset.x, part.offset.y, 0},
                                                   .imageExtent = {part.extent.width, part.extent.height, 1}});
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    const vk::MemoryBarrier2 to_host{.srcStageMask = Stage::eCopy,
                                     .srcAccessMask = Access::eTransferWrite,
                                     .dstStageMask = Stage::eHost | Stage::eCopy,
                                     .dstAccessMask = Access::eHostRead | Access::eTransferWrite};
    commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &to_host});
  });
}

void FrameGraph::record_pass(const std::string& name, const std::vector<ImageUse>& uses,
                             const std::function<void(Recorder&)>& record) {
  auto& [stamps, read, passes, stamped] = *recorded_;
  const std::uint32_t at = stamped++;
  if (at / kPassesInPool == stamps.size()) {
    stamps.emplace_back(device_.device, vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp,
                                                                .queryCount = 2 * kPassesInPool});
    commands_.resetQueryPool(*stamps.back(), 0, 2 * kPassesInPool);
  }
  std::vector<vk::ImageMemoryBarrier2> barriers;
  for (const ImageUse& use : uses) {
    Image& image = *use.image;
    const State next = state_of(use.use);
    barriers.push_back(vk::ImageMemoryBarrier2{
        .srcStageMask = image.stage,
        .srcAccessMask = image.access,
        .dstStageMask = next.stage,
        .dstAccessMask = next.access,
        .oldLayout = use.discard ? vk::ImageLayout::eUndefined : image.layout,
        .newLayout = next.layout,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = *image.image,
        .subresourceRange = {image.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}});
    image.layout = next.layout;
    image.stage = next.stage;
    image.access = next.access;
  }
  if (!barriers.empty())
    commands_.pipelineBarrier2(
        vk::DependencyInfo{.imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
                           .pImageMemoryBarriers = barriers.data()});
  const vk::QueryPool pool = *stamps[at / kPassesInPool];
  const std::uint32_t first = 2 * (at % kPassesInPool);
  if (device_.stamp_bits != 0) commands_.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, pool, first);
  Recorder recorder(commands_, counts_, device_.multi_draw);
  record(recorder);
  if (device_.stamp_bits != 0) commands_.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, pool, first + 1);
  passes.push_back({prefix_ + name, account_});
}

void FrameGraph::end() {
  read_back_stamps();
  commands_ = nullptr;
}

void FrameGraph::read_back_stamps() {
  if (device_.stamp_bits == 0) return;
  auto& [stamps, read, passes, stamped] = *recorded_;
  constexpr vk::DeviceSize kPoolBytes = 2 * kPassesInPool * sizeof(std::uint64_t);
  if (read.bytes < stamps.size() * kPoolBytes)
    read = HostBuffer(device_, stamps.size() * kPoolBytes, vk::BufferUsageFlagBits::eTransferDst, "time stamps", true);
  for (std::uint32_t begin = 0; begin < stamped; begin += kPassesInPool) {
    const std::size_t pool = begin / kPassesInPool;
    const std::uint32_t count = 2 * std::min(stamped - begin, kPassesInPool);
    commands_.copyQueryPoolResults(*stamps[pool], 0, count, *read.buffer, pool * kPoolBytes, sizeof(std::uint64_t),
                                   vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  }
  const vk::MemoryBarrier2 to_host{.srcStageMask = vk::PipelineStageFlagBits2::eCopy,
                                   .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                   .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                   .dstAccessMask = vk::AccessFlagBits2::eHostRead};
  commands_.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &to_host});
}

std::span<const std::uint64_t> FrameGraph::read_stamps(std::size_t frame) const {
  const Passes& of = recorded_.of(frame);
  if (device_.stamp_bits == 0) return {};
  return {static_cast<const std::uint64_t*>(of.read.data), std::size_t{2} * of.stamped};
}

std::vector<FrameGraph::Timing> FrameGraph::timings(std::size_t frame) const {
  std::vector<Timing> result;
  const std::span<const std::uint64_t> stamps = read_stamps(frame);
  const double ms_per_tick = static_cast<double>(device_.properties.limits.timestampPeriod) * 1e-6;
  std::size_t next = 0;
  for (const Recorded& pass : recorded_.of(frame).passes) {
    if (pass.processor_ms) {
      result.push_back({pass.name, pass.account, *pass.processor_ms});
    } else if (next + 1 < stamps.size()) {
      result.push_back(
          {pass.name, pass.account, ticks_between(stamps[next], stamps[next + 1], device_.stamp_bits) * ms_per_tick});
      next += 2;
    }
  }
  return result;
}

double FrameGraph::total_ms(std::size_t frame) const {
  const std::span<const std::uint64_t> stamps = read_stamps(frame);
  if (stamps.empty()) return 0.0;
  return ticks_between(stamps.front(), stamps.back(), device_.stamp_bits) *
         static_cast<double>(device_.properties.limits.timestampPeriod) * 1e-6;
}

}  // namespace phare::gpu
