#include "visual/passes/overlay.h"

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "visual/letters.h"
#include "visual/passes/wrap.h"

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

// Of a picture 720 pixels high.
constexpr float kText_px = 19.0f, kTitle_px = 30.0f, kReferenceHeight_px = 720.0f;
constexpr float kLeastText_px = 11.0f;  // smaller letters are not read
constexpr float kLine = 1.32f;          // from line to line, in letters

ImFont* load_font(const char* file, float size_px) {
  const std::string path = letters_file(file);
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (path.empty()) return atlas.AddFontDefault();
  return atlas.AddFontFromFileTTF(path.c_str(), size_px);
}

ImU32 packed(OverlayColour colour, int alpha = 255) {
  return IM_COL32(colour.red, colour.green, colour.blue, alpha);
}

const ImU32 kPaper = IM_COL32(30, 36, 42, 155);  // dark enough that text is read over a lit road
const ImU32 kBlank = IM_COL32(28, 33, 42, 255);
constexpr OverlayColour kInk{235, 235, 225}, kKeyInk{255, 214, 120};

/// Letters of one size.
struct Pen {
  ImDrawList& list;
  ImFont* font;
  float size_px;

  float width(const std::string& text) const { return font->CalcTextSizeA(size_px, 1e9f, 0.0f, text.c_str()).x; }
  void write(float x, float y, OverlayColour colour, const std::string& text) const {
    list.AddText(font, size_px, {x, y}, packed(colour), text.c_str());
  }
};

/// Along the upper left edge, from `left_px` on and within `room_px` of the picture's. Returns where they end, 0
/// without any.
float draw_lines(Pen pen, float left_px, const ImVec2& room_px, const std::vector<std::string>& unwrapped) {
  if (unwrapped.empty()) return 0.0f;
  const float edge = 0.5f * pen.size_px, least_px = 0.5f * pen.size_px;
  std::vector<std::string> lines;
  float height = 0.0f;
  while (true) {
    lines.clear();
    height = pen.size_px * kLine;
    const auto width_of = [&](const std::string& text) { return static_cast<double>(pen.width(text)); };
    for (const std::string& line : unwrapped) wrap(line, room_px.x - left_px - 4.0f * edge, width_of, lines);
    if (2.0f * edge + height * static_cast<float>(lines.size()) <= room_px.y || pen.size_px * 0.95f < least_px) break;
    pen.size_px *= 0.95f;
  }
  float width = 0.0f;
  for (const std::string& line : lines) width = std::max(width, pen.width(line));
  pen.list.AddRectFilled({left_px + edge, edge},
                         {left_px + 3.0f * edge + width, 2.0f * edge + height * static_cast<float>(lines.size())},
                         kPaper, 4.0f);
  float y = 1.5f * edge;
  for (const std::string& line : lines) {
    pen.write(left_px + 2.0f * edge, y, kInk, line);
    y += height;
  }
  return y + edge;
}

/// In the middle of the lower edge from `left_px` on, or at its right end.
void draw_instruments(const Pen& small, const Pen& large, float left_px, const ImVec2& picture,
                      const std::vector<OverlayInstrument>& instruments, bool to_the_right) {
  if (instruments.empty()) return;
  const float gap = 1.1f * small.size_px;
  float width = gap;
  for (const OverlayInstrument& each : instruments) width += (each.large ? large : small).width(each.text) + gap;
  const float height = 1.3f * large.size_px, top = picture.y - height - 0.5f * small.size_px;
  float x = left_px + std::max((picture.x - left_px - width) * (to_the_right ? 1.0f : 0.5f), 0.0f);
  small.list.AddRectFilled({x, top}, {x + width, top + height}, kPaper, 6.0f);
  x += gap;
  for (const OverlayInstrument& each : instruments) {
    const Pen& pen = each.large ? large : small;
    pen.write(x, top + 0.5f * (height - pen.size_px * 1.15f), each.colour, each.text);
    x += pen.width(each.text) + gap;
  }
}

/// Boxes, lines, letters; each label with a shade, so that it is read on any ground.
void draw_marks_of(const Pen& pen, const ImVec2& picture, const OverlayMarks& marks) {
  const auto at = [&](double x_01, double y_01) {
    return ImVec2{static_cast<float>(x_01) * picture.x, static_cast<float>(y_01) * picture.y};
  };
  for (const OverlayMarks::Box& box : marks.boxes)
    pen.list.AddRectFilled(at(box.left_01, box.top_01), at(box.left_01 + box.width_01, box.top_01 + box.height_01),
                           packed(box.colour, box.alpha));
  const float width_px = std::max(1.0f, 1.4f * picture.y / kReferenceHeight_px);
  for (const OverlayMarks::Line& line : marks.lines)
    pen.list.AddLine(at(line.x0_01, line.y0_01), at(line.x1_01, line.y1_01), packed(line.colour, 200), width_px);
  for (const OverlayMarks::Label& label : marks.labels) {
    Pen letters = pen;
    letters.size_px *= 0.85f;
    const float room_px = static_cast<float>(label.room_01) * picture.x - 3.0f;  // beside the shade
    if (label.room_01 > 0.0) letters.size_px *= std::clamp(room_px / letters.width(label.text), 0.1f, 1.0f);
    const ImVec2 begin = at(label.x_01, label.y_01);
    const float x = begin.x + 2.0f, y = begin.y - 0.55f * letters.size_px;
    letters.write(x + 1.0f, y + 1.0f, {10, 12, 16}, label.text);
    letters.write(x, y, label.colour, label.text);
  }
}

/// `left_px`, `top_px`: what is left of it and what is above it is taken.
void draw_panel(Pen small, const Pen& large, float left_px, const ImVec2& picture, float top_px,
                const OverlayPanel& panel) {
  if (panel.empty()) return;
  const float edge = small.size_px;
  const float title_height = panel.title.empty() ? 0.0f : large.size_px * 1.5f;
  // All of it is to be seen: more rows than fit are written smaller, and where those would not be read in the columns
  // that leave the largest letters.
  const float letters_px = small.size_px, room = picture.y - 3.0f * edge - title_height;
  const float across = picture.x - left_px - 4.0f * edge;
  float key_width = 0.0f, column_width = 0.0f;
  std::size_t columns = 0, rows = 0;
  const auto width = [&] { return static_cast<float>(columns) * (column_width + edge) - edge; };
  const auto measure = [&](float size_px) {
    small.size_px = size_px;
    key_width = column_width = 0.0f;
    for (const OverlayPanel::Row& row : panel.rows)
      if (!row.key.empty()) key_width = std::max(key_width, small.width(row.key) + 1.5f * size_px);
    for (const OverlayPanel::Row& row : panel.rows)
      column_width = std::max(column_width, small.width(row.words) + (row.key.empty() ? 0.0f : key_width));
  };
  const auto lay_out = [&](std::size_t in_columns) {
    columns = in_columns, rows = std::max<std::size_t>((panel.rows.size() + columns - 1) / columns, 1);
    measure(std::min(letters_px, room / static_cast<float>(rows) / kLine * 1.1f));
    if (columns > 1 && width() > across) measure(small.size_px * across / width());
  };
  std::size_t best = 1;
  float best_px = 0.0f;
  for (std::size_t each = 1; each <= 3 && best_px < kLeastText_px; ++each) {
    lay_out(each);
    if (small.size_px > best_px) best = each, best_px = small.size_px;
  }
  lay_out(best);
  const float line = std::min(small.size_px * kLine, room / static_cast<float>(rows));
  const ImVec2 size{std::max(large.width(panel.title), width()) + 2.0f * edge,
                    title_height + line * static_cast<float>(rows) + 1.5f * edge};
  const bool left = panel.place == OverlayPanel::Place::kLeft;
  const ImVec2 at{left_px + (left ? edge : std::max(0.5f * (picture.x - left_px - size.x), 0.0f)),
                  left ? edge : top_px};
  if (panel.place == OverlayPanel::Place::kAlone) small.list.AddRectFilled({0.0f, 0.0f}, picture, kBlank);
  small.list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, kPaper, 8.0f);
  large.write(at.x + edge, at.y + 0.7f * edge, kInk, panel.title);
  for (std::size_t i = 0; i < panel.rows.size(); ++i) {
    const OverlayPanel::Row& row = panel.rows[i];
    const float x = at.x + edge + static_cast<float>(i / rows) * (column_width + edge);
    const float y = at.y + 0.7f * edge + title_height + static_cast<float>(i % rows) * line;
    if (!row.key.empty()) small.write(x, y, kKeyInk, row.key);
    small.write(row.key.empty() ? x : x + key_width, y, kInk, row.words);
  }
}

}  // namespace

OverlayPass::OverlayPass(gpu::Device& device, vk::Format format, std::uint32_t height_px)
    : device_(device), render_pass_(make_render_pass(device, format)) {
  const vk::DescriptorPoolSize size{vk::DescriptorType::eCombinedImageSampler, 1};
  pool_ = vk::raii::DescriptorPool(
      device.device, vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                  .maxSets = 1,
                                                  .poolSizeCount = 1,
                                                  .pPoolSizes = &size});
  context_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(context_);    // the panel has one of its own
  ImGui::GetIO().IniFilename = nullptr;  // nothing is kept between runs
  const float scale = static_cast<float>(height_px) / kReferenceHeight_px;
  text_ = load_font("DejaVuSans.ttf", std::max(kText_px * scale, kLeastText_px));
  title_ = load_font("DejaVuSans-Bold.ttf", std::max(kTitle_px * scale, kLeastText_px));
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = static_cast<VkInstance>(*device.instance);
  info.PhysicalDevice = static_cast<VkPhysicalDevice>(*device.physical);
  info.Device = static_cast<VkDevice>(*device.device);
  info.QueueFamily = device.queue_family;
  info.Queue = static_cast<VkQueue>(*device.queue);
  info.DescriptorPool = static_cast<VkDescriptorPool>(*pool_);
  info.MinImageCount = info.ImageCount = gpu::kMostFramesInFlight;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = check;
  ImGui_ImplVulkan_Init(&info, static_cast<VkRenderPass>(*render_pass_));
  device.run_once(
      [](vk::CommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(static_cast<VkCommandBuffer>(commands)); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

OverlayPass::~OverlayPass() {
  try {
    device_.device.waitIdle();
  } catch (const vk::SystemError&) {
    // Of a device that was lost nothing is left to wait for.
  }
  ImGui::SetCurrentContext(context_);
  ImGui_ImplVulkan_Shutdown();
  ImGui::DestroyContext(context_);
}

void OverlayPass::draw(gpu::FrameGraph& graph, gpu::Image& display, const std::vector<std::string>& lines,
                       const std::vector<OverlayInstrument>& instruments, const OverlayPanel& panel,
                       const OverlayMarks& marks, const OverlayRoom& room) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(display.extent.width), static_cast<float>(display.extent.height)};
  io.DeltaTime = 1.0f / 60.0f;  // nothing here moves by itself
  ImGui_ImplVulkan_NewFrame();
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float scale = io.DisplaySize.y / kReferenceHeight_px;
  const Pen small{list, text_, std::max(kText_px * scale, kLeastText_px)};
  const Pen large{list, title_, std::max(kTitle_px * scale, kLeastText_px)};
  draw_marks_of(small, io.DisplaySize, marks);
  const bool left = !panel.empty() && panel.place == OverlayPanel::Place::kLeft;
  // A panel on the left takes the place of the lines.
  const ImVec2 lines_px{static_cast<float>(room.lines_width_01) * io.DisplaySize.x,
                        static_cast<float>(room.lines_height_01) * io.DisplaySize.y};
  const float left_px = static_cast<float>(room.left_01) * io.DisplaySize.x;
  const float top_px = std::max(left ? 0.0f : draw_lines(small, left_px, lines_px, lines),
                                static_cast<float>(room.panel_top_01) * io.DisplaySize.y);
  draw_instruments(small, large, left_px, io.DisplaySize, instruments, left);
  draw_panel(small, large, left_px, io.DisplaySize, top_px, panel);
  ImGui::Render();

  const vk::ImageView view = *display.view;
  vk::raii::Framebuffer& framebuffer = framebuffer_->picture;
  framebuffer = vk::raii::Framebuffer(device_.device, vk::FramebufferCreateInfo{.renderPass = *render_pass_,
                                                                                 .attachmentCount = 1,
                                                                                 .pAttachments = &view,
                                                                                 .width = display.extent.width,
                                                                                 .height = display.extent.height,
                                                                                 .layers = 1});
  graph.pass("overlay", {{&display, gpu::Use::kColourTarget, false}}, [&](gpu::Recorder& commands) {
    commands.beginRenderPass(
        vk::RenderPassBeginInfo{
            .renderPass = *render_pass_, .framebuffer = *framebuffer, .renderArea = {{0, 0}, display.extent}},
        vk::SubpassContents::eInline);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(),
                                    static_cast<VkCommandBuffer>(static_cast<vk::CommandBuffer&>(commands)));
    commands.endRenderPass();
  });
}

}  // namespace phare
