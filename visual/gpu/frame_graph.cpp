#include "visual/gpu/frame_graph.h"

#include <stdexcept>

namespace phare::gpu {

namespace {

constexpr std::uint32_t kMaxPasses = 16;

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
    case Use::kCopySource:
      return {Layout::eTransferSrcOptimal, Stage::eCopy, Access::eTransferRead};
    case Use::kCopyTarget:
      return {Layout::eTransferDstOptimal, Stage::eCopy, Access::eTransferWrite};
    case Use::kPresent:
      return {Layout::ePresentSrcKHR, Stage::eBottomOfPipe, Access::eNone};
  }
  throw std::logic_error("image use");
}

}  // namespace

FrameGraph::FrameGraph(Device& device)
    : device_(device),
      stamps_(device.device,
              vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = 2 * kMaxPasses}) {}

void FrameGraph::begin(vk::CommandBuffer commands) {
  commands_ = commands;
  names_.clear();
  counts_ = {};
  for (auto& [name, held] : images_) held.asked = false;
  commands_.resetQueryPool(*stamps_, 0, 2 * kMaxPasses);
}

Image& FrameGraph::image(const std::string& name, const ImageNeed& need) {
  Held& held = images_[name];
  held.asked = true;
  if (!*held.image.image || held.need != need) {
    held.image = {};  // first, so that both never take memory at once
    held.image = Image(device_, need.format, need.extent, need.usage, name, need.samples);
    held.need = need;
  }
  return held.image;
}

void FrameGraph::free_unused() {
  std::erase_if(images_, [](const auto& named) { return !named.second.asked; });
  counts_.images = static_cast<std::uint32_t>(images_.size());
  counts_.image_bytes = 0;
  for (const auto& [name, held] : images_) counts_.image_bytes += held.image.bytes;
}

void FrameGraph::pass(const std::string& name, const std::vector<ImageUse>& uses,
                      const std::function<void(Recorder&)>& record) {
  ++counts_.passes;
  record_pass(name, uses, record);
}

void FrameGraph::copy(const std::string& name, const std::vector<ImageUse>& uses,
                      const std::function<void(Recorder&)>& record) {
  ++counts_.copies;
  record_pass(name, uses, record);
}

void FrameGraph::record_pass(const std::string& name, const std::vector<ImageUse>& uses,
                             const std::function<void(Recorder&)>& record) {
  if (names_.size() == kMaxPasses) throw std::logic_error("more passes than time stamps");
  std::vector<vk::ImageMemoryBarrier2> barriers;
  for (const ImageUse& use : uses) {
    Image& image = *use.image;
    const State next = state_of(use.use);
    barriers.push_back(vk::ImageMemoryBarrier2{.srcStageMask = image.stage,
                                               .srcAccessMask = image.access,
                                               .dstStageMask = next.stage,
                                               .dstAccessMask = next.access,
                                               .oldLayout = use.discard ? vk::ImageLayout::eUndefined : image.layout,
                                               .newLayout = next.layout,
                                               .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                               .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                               .image = *image.image,
                                               .subresourceRange = {image.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1}});
    image.layout = next.layout;
    image.stage = next.stage;
    image.access = next.access;
  }
  if (!barriers.empty())
    commands_.pipelineBarrier2(
        vk::DependencyInfo{.imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
                           .pImageMemoryBarriers = barriers.data()});
  const auto first = static_cast<std::uint32_t>(2 * names_.size());
  commands_.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *stamps_, first);
  Recorder recorder(commands_, counts_);
  record(recorder);
  commands_.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *stamps_, first + 1);
  names_.push_back(name);
}

void FrameGraph::end() {
  commands_ = nullptr;
}

std::vector<FrameGraph::Timing> FrameGraph::timings() const {
  std::vector<Timing> result;
  if (names_.empty()) return result;
  const auto count = static_cast<std::uint32_t>(2 * names_.size());
  const auto [status, stamps] = stamps_.getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t),
                                                                  sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
  if (status != vk::Result::eSuccess) return result;
  const double ms_per_tick = static_cast<double>(device_.properties.limits.timestampPeriod) * 1e-6;
  for (std::size_t i = 0; i < names_.size(); ++i)
    result.push_back({names_[i], static_cast<double>(stamps[2 * i + 1] - stamps[2 * i]) * ms_per_tick});
  return result;
}

double FrameGraph::total_ms() const {
  if (names_.empty()) return 0.0;
  const auto count = static_cast<std::uint32_t>(2 * names_.size());
  const auto [status, stamps] = stamps_.getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t),
                                                                  sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
  if (status != vk::Result::eSuccess) return 0.0;
  return static_cast<double>(stamps.back() - stamps.front()) *
         static_cast<double>(device_.properties.limits.timestampPeriod) * 1e-6;
}

}  // namespace phare::gpu
