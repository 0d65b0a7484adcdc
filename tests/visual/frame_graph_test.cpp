// The frame graph by itself: images with layers and levels, memory that is shared one after the other, any number of
// passes. Validation sees every barrier.
#include "visual/gpu/frame_graph.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace phare::gpu {
namespace {

using Usage = vk::ImageUsageFlagBits;
constexpr vk::Extent2D kSize{64, 32};
constexpr ImageNeed kNeed{
    .format = vk::Format::eR8G8B8A8Unorm, .extent = kSize, .usage = Usage::eColorAttachment | Usage::eTransferSrc};

class FrameGraphTest : public testing::Test {
 protected:
  void frame(const std::function<void()>& record) {
    device.run_once([&](vk::CommandBuffer commands) {
      graph.begin(commands);
      record();
      graph.end();
    });
    graph.free_unused();
  }
  void clear(const std::string& name, Image& image, float red, std::uint32_t layer = 0, std::uint32_t mip = 0) {
    graph.pass(name, {{&image, Use::kColourTarget, image.layout == vk::ImageLayout::eUndefined}},
               [&](Recorder& commands) {
                 const vk::RenderingAttachmentInfo target{
                     .imageView = image.part(layer, mip),
                     .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                     .loadOp = vk::AttachmentLoadOp::eClear,
                     .storeOp = vk::AttachmentStoreOp::eStore,
                     .clearValue = vk::ClearColorValue(std::array{red, 0.0f, 0.0f, 1.0f})};
                 commands.beginRendering(
                     vk::RenderingInfo{.renderArea = {{0, 0}, {image.extent.width >> mip, image.extent.height >> mip}},
                                       .layerCount = 1,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &target});
                 commands.endRendering();
               });
  }
  void read(Image& image, HostBuffer& to, std::uint32_t layer = 0, std::uint32_t mip = 0) {
    graph.copy("read", {{&image, Use::kCopySource, false}}, [&](Recorder& commands) {
      commands.copyImageToBuffer(
          *image.image, vk::ImageLayout::eTransferSrcOptimal, *to.buffer,
          vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, mip, layer, 1},
                              .imageExtent = {image.extent.width >> mip, image.extent.height >> mip, 1}});
    });
  }
  HostBuffer buffer() { return HostBuffer(device, 64 * 32 * 4, vk::BufferUsageFlagBits::eTransferDst, "read", true); }
  static int red_of(const HostBuffer& buffer) { return static_cast<const unsigned char*>(buffer.data)[0]; }

  Device device{{.validation = true}};
  FrameGraph graph{device};
  void TearDown() override { EXPECT_EQ(device.validation_messages->load(), 0u); }
};

TEST_F(FrameGraphTest, ImagesOneAfterTheOtherShareMemoryAndKeepTheirOwnContent) {
  HostBuffer first = buffer(), second = buffer(), third = buffer();
  for (int round = 0; round < 3; ++round) {
    frame([&] {
      Image& a = graph.image("a", kNeed);
      clear("a", a, 1.0f);
      read(a, first);
      graph.release(a);
      Image& b = graph.image("b", kNeed);  // in the memory of a
      clear("b", b, 0.0f);
      Image& c = graph.image("c", kNeed);  // nothing is free
      clear("c", c, 0.4f);
      read(b, second);
      read(c, third);
    });
    EXPECT_EQ(red_of(first), 255);
    EXPECT_EQ(red_of(second), 0);
    EXPECT_EQ(red_of(third), 102);
    EXPECT_EQ(graph.counts().images, 3u);
    EXPECT_EQ(graph.counts().image_bytes, 2 * graph.counts().shared_bytes);
    EXPECT_EQ(graph.counts().passes, 3u);
    EXPECT_EQ(graph.counts().copies, 3u);
  }
}

TEST_F(FrameGraphTest, MemoryGoesWithTheLastImageThatUsesIt) {
  frame([&] { clear("b", graph.image("b", kNeed), 0.5f); });  // room for time stamps stays
  frame([] {});
  const std::uint64_t before = *device.allocated_bytes;
  frame([&] {
    Image& a = graph.image("a", kNeed);
    clear("a", a, 1.0f);
    graph.release(a);
    clear("b", graph.image("b", kNeed), 0.5f);
  });
  EXPECT_EQ(*device.allocated_bytes - before, graph.counts().image_bytes);
  frame([&] { clear("b", graph.image("b", kNeed), 0.5f); });
  EXPECT_EQ(*device.allocated_bytes - before, graph.counts().image_bytes);
  frame([] {});
  EXPECT_EQ(*device.allocated_bytes, before);
}

// A card whose stamps have 36 bits begins anew within two hours; all bits above are not to be counted.
TEST(TimeStamps, BeginAnewWhereTheirBitsEnd) {
  constexpr std::uint64_t k36 = (std::uint64_t{1} << 36) - 1, kAll = ~std::uint64_t{0};
  EXPECT_EQ(ticks_between(100, 350, k36), 250.0);
  EXPECT_EQ(ticks_between(k36 - 99, 150, k36), 250.0);
  EXPECT_EQ(ticks_between(kAll - 99, 150, kAll), 250.0);
}

// A pass, an image and what a pass keeps are counted for the account that is set; copies are timed for it, and are no
// passes. Images that share memory count in full, each for its own.
TEST_F(FrameGraphTest, EachAccountHasWhatWasCountedForIt) {
  HostBuffer to = buffer();
  for (int round = 0; round < 2; ++round) {
    frame([&] {
      Image& a = graph.image("a", kNeed);
      clear("a", a, 1.0f);
      graph.release(a);
      graph.set_account(3);
      Image& b = graph.image("b", kNeed);  // in the memory of a
      clear("b", b, 0.0f);
      clear("b again", b, 0.0f);
      graph.count_kept(&to, 100);
      graph.count_kept(&to, 100);
      read(b, to);
      graph.set_account(kFrameAccount);
      graph.count_kept(&to, 100);  // counted
    });
    const Counts& counts = graph.counts();
    EXPECT_EQ(counts.accounts[kFrameAccount].passes, 1u);
    EXPECT_EQ(counts.accounts[3].passes, 2u);
    EXPECT_EQ(counts.accounts[3].kept_bytes, 100u);
    EXPECT_EQ(counts.accounts[kFrameAccount].kept_bytes, 0u);
    EXPECT_EQ(counts.accounts[3].image_bytes, counts.image_bytes) << "all the memory there is";
    EXPECT_EQ(counts.accounts[kFrameAccount].image_bytes, counts.image_bytes);
    EXPECT_EQ(counts.shared_bytes, counts.image_bytes);
    const std::vector<FrameGraph::Timing> timed = graph.timings(0);
    ASSERT_EQ(timed.size(), 4u);
    EXPECT_EQ(timed[0].account, kFrameAccount);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(timed[i].account, 3u) << timed[i].name;
  }
  frame([&] { clear("a", graph.image("a", kNeed), 1.0f); });
  EXPECT_EQ(graph.counts().accounts[3].passes, 0u);
  EXPECT_EQ(graph.counts().accounts[3].image_bytes, 0u);
  EXPECT_EQ(graph.counts().accounts[3].kept_bytes, 0u);
}

// Asked for again while another has its memory, or with another need: the first one stays whole.
TEST_F(FrameGraphTest, AnImageAskedForTwiceIsNeverTakenFromAPassThatUsesIt) {
  HostBuffer first = buffer(), second = buffer();
  for (int round = 0; round < 2; ++round) {
    frame([&] {
      Image& a = graph.image("a", kNeed);
      EXPECT_EQ(&graph.image("a", kNeed), &a);
      clear("a", a, 1.0f);
      graph.release(a);
      Image& b = graph.image("b", kNeed);
      clear("b", b, 0.0f);
      Image& again = graph.image("a", kNeed);
      EXPECT_NE(&again, &a);
      clear("a again", again, 0.4f);
      ImageNeed other = kNeed;
      other.format = vk::Format::eB8G8R8A8Unorm;
      EXPECT_NE(&graph.image("b", other), &b);
      clear("b again", graph.image("b", other), 0.4f);
      read(b, first);
      read(again, second);
    });
    EXPECT_EQ(red_of(first), 0);
    EXPECT_EQ(red_of(second), 102);
  }
}

TEST_F(FrameGraphTest, LayersLevelsAndEveryUse) {
  HostBuffer top = buffer(), deep = buffer();
  frame([&] {
    ImageNeed need = kNeed;
    need.layers = 3;
    need.mips = 2;
    need.usage |= Usage::eSampled | Usage::eStorage | Usage::eTransferDst;
    Image& image = graph.image("layers", need);
    for (std::uint32_t mip = 0; mip < 2; ++mip)
      for (std::uint32_t layer = 0; layer < 3; ++layer)
        clear("layer", image, 0.2f * static_cast<float>(layer + 3 * mip), layer, mip);
    for (const Use use : {Use::kSampled, Use::kSampledByVertices, Use::kSampledByCompute, Use::kStorageRead,
                          Use::kStorageWrite, Use::kStorageWrite, Use::kSampledByVertices})
      graph.pass("use", {{&image, use, false}}, [](Recorder&) {});
    read(image, top, 2, 0);
    read(image, deep, 1, 1);
  });
  EXPECT_EQ(red_of(top), 102);
  EXPECT_EQ(red_of(deep), 204);
}

TEST_F(FrameGraphTest, AnyNumberOfPassesIsTimed) {
  for (const std::size_t count : {50u, 1u, 17u}) {
    frame([&] {
      for (std::size_t i = 0; i < count; ++i) clear("pass", graph.image("a", kNeed), 0.5f);
    });
    EXPECT_EQ(graph.timings(0).size(), count);
    EXPECT_EQ(graph.counts().passes, count);
  }
}

}  // namespace
}  // namespace phare::gpu
