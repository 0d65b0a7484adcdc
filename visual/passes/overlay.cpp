#include "visual/passes/overlay.h"

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>
#include <stdexcept>

namespace phare {

namespace {

void check(VkResult result) {
  if (result < 0) throw std::runtime_error("overlay: " + vk::to_string(vk::Result(result)));
}

vk::raii::RenderPass make_render_pass(gpu::Device& device, vk::Format format) {
  const auto layout = vk::ImageLayout::eColorAttachmentOptimal;
  const vk::AttachmentDescription picture{.format = format,
                                          .loadOp = vk::AttachmentLoadOp::eLoad,
                                          .storeOp = vk::AttachmentStoreOp::eStore,
                                          .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
                                          .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
                                          .initialLayout = layout,
                                          .finalLayout = layout};
  const vk::AttachmentReference reference{0, layout};
  const vk::SubpassDescription subpass{.colorAttachmentCount = 1, .pColorAttachments = &reference};
  return {device.device,
          vk::RenderPassCreateInfo{
              .attachmentCount = 1, .pAttachments = &picture, .subpassCount = 1, .pSubpasses = &subpass}};
}

}  // namespace

OverlayPass::OverlayPass(gpu::Device& device, vk::Format format)
    : device_(device), render_pass_(make_render_pass(device, format)) {
  const vk::DescriptorPoolSize size{vk::DescriptorType::eCombinedImageSampler, 1};
  pool_ = vk::raii::DescriptorPool(
      device.device, vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                  .maxSets = 1,
                                                  .poolSizeCount = 1,
                                                  .pPoolSizes = &size});
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // nothing is kept between runs
  ImGui::GetIO().FontGlobalScale = 1.25f;
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = static_cast<VkInstance>(*device.instance);
  info.PhysicalDevice = static_cast<VkPhysicalDevice>(*device.physical);
  info.Device = static_cast<VkDevice>(*device.device);
  info.QueueFamily = device.queue_family;
  info.Queue = static_cast<VkQueue>(*device.queue);
  info.DescriptorPool = static_cast<VkDescriptorPool>(*pool_);
  info.MinImageCount = info.ImageCount = 2;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = check;
  ImGui_ImplVulkan_Init(&info, static_cast<VkRenderPass>(*render_pass_));
  device.run_once(
      [](vk::CommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(static_cast<VkCommandBuffer>(commands)); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

OverlayPass::~OverlayPass() {
  device_.device.waitIdle();
  ImGui_ImplVulkan_Shutdown();
  ImGui::DestroyContext();
}

void OverlayPass::draw(gpu::FrameGraph& graph, gpu::Image& display, const std::vector<std::string>& lines) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(display.extent.width), static_cast<float>(display.extent.height)};
  io.DeltaTime = 1.0f / 60.0f;  // nothing here moves by itself
  ImGui_ImplVulkan_NewFrame();
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float height = ImGui::GetTextLineHeight() + 4.0f;
  float width = 0.0f;
  for (const std::string& line : lines) width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
  list.AddRectFilled({8.0f, 8.0f}, {24.0f + width, 16.0f + height * static_cast<float>(lines.size())},
                     IM_COL32(0, 0, 0, 110), 4.0f);
  float y = 12.0f;
  for (const std::string& line : lines) {
    list.AddText({16.0f, y}, IM_COL32(235, 235, 225, 255), line.c_str());
    y += height;
  }
  ImGui::Render();

  const vk::ImageView view = *display.view;
  framebuffer_ = vk::raii::Framebuffer(device_.device, vk::FramebufferCreateInfo{.renderPass = *render_pass_,
                                                                                 .attachmentCount = 1,
                                                                                 .pAttachments = &view,
                                                                                 .width = display.extent.width,
                                                                                 .height = display.extent.height,
                                                                                 .layers = 1});
  graph.pass("overlay", {{&display, gpu::Use::kColourTarget, false}}, [&](gpu::Recorder& commands) {
    commands.beginRenderPass(
        vk::RenderPassBeginInfo{
            .renderPass = *render_pass_, .framebuffer = *framebuffer_, .renderArea = {{0, 0}, display.extent}},
        vk::SubpassContents::eInline);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(),
                                    static_cast<VkCommandBuffer>(static_cast<vk::CommandBuffer&>(commands)));
    commands.endRenderPass();
  });
}

}  // namespace phare
