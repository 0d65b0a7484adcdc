#include "visual/process/panel.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "visual/letters.h"

namespace phare {
namespace {

// Chosen by eye at 1280 x 720.
constexpr float kPanelText_px = 15.0f, kReferenceWidth_px = 1280.0f, kReferenceHeight_px = 720.0f;
constexpr float kLeastPanelText_px = 11.0f;  // smaller letters are not read
constexpr float kPanelWidth = 27.0f;         // in letters' heights: a third of 1280 pixels

ImVec4 grey(float level, float alpha = 1.0f) {
  return {level, level * 1.03f, level * 1.08f, alpha};
}

float text_px_of(float width_px, float height_px) {
  return std::max(kPanelText_px * std::min(width_px / kReferenceWidth_px, height_px / kReferenceHeight_px),
                  kLeastPanelText_px);
}

/// Dark: a bright panel would be the brightest thing at night.
void set_style(float text_px) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = style.FrameRounding = style.GrabRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.WindowPadding = {0.6f * text_px, 0.5f * text_px};
  style.FramePadding = {0.35f * text_px, 0.12f * text_px};
  style.ItemSpacing = {0.45f * text_px, 0.22f * text_px};
  style.ScrollbarSize = 0.8f * text_px;
  style.Colors[ImGuiCol_WindowBg] = {0.07f, 0.09f, 0.11f, 0.88f};
  style.Colors[ImGuiCol_PopupBg] = {0.10f, 0.12f, 0.15f, 0.98f};
  style.Colors[ImGuiCol_Text] = grey(0.88f);
  style.Colors[ImGuiCol_TextDisabled] = grey(0.58f);
  style.Colors[ImGuiCol_Header] = {0.16f, 0.26f, 0.38f, 0.75f};
  style.Colors[ImGuiCol_FrameBg] = {0.17f, 0.21f, 0.27f, 0.85f};
  style.Colors[ImGuiCol_SliderGrab] = {0.30f, 0.46f, 0.66f, 0.70f};  // the value is read over it
  style.Colors[ImGuiCol_Button] = {0.19f, 0.28f, 0.39f, 0.90f};
}

std::shared_ptr<const GuiAtlas> make_atlas(ImFontAtlas& fonts) {
  unsigned char* coverage = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsAlpha8(&coverage, &width, &height);
  auto atlas = std::make_shared<GuiAtlas>();
  atlas->width_px = static_cast<std::uint32_t>(width), atlas->height_px = static_cast<std::uint32_t>(height);
  atlas->coverage.assign(coverage, coverage + static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  fonts.ClearTexData();
  return atlas;
}

GuiVertex vertex_of(const ImDrawVert& from) {
  GuiVertex to{from.pos.x, from.pos.y, from.uv.x, from.uv.y, {}};
  for (int channel = 0; channel < 4; ++channel)
    to.srgba[static_cast<std::size_t>(channel)] = static_cast<std::uint8_t>(from.col >> (8 * channel));
  return to;
}

/// What Dear ImGui has laid out, without its types.
void copy_out(const ImDrawData& data, GuiContent& content) {
  content.vertices.clear(), content.indices.clear(), content.draws.clear();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    const auto vertices = static_cast<std::uint32_t>(content.vertices.size());
    const auto indices = static_cast<std::uint32_t>(content.indices.size());
    std::ranges::transform(list.VtxBuffer, std::back_inserter(content.vertices), vertex_of);
    content.indices.insert(content.indices.end(), list.IdxBuffer.begin(), list.IdxBuffer.end());
    for (const ImDrawCmd& draw : list.CmdBuffer) {
      if (draw.ElemCount == 0) continue;
      content.draws.push_back({indices + draw.IdxOffset, draw.ElemCount, vertices + draw.VtxOffset, draw.ClipRect.x,
                               draw.ClipRect.y, draw.ClipRect.z, draw.ClipRect.w});
    }
  }
}

}  // namespace

Panel::Panel(int picture_height_px)
    : context_(ImGui::CreateContext()),
      letters_px_(text_px_of(kReferenceWidth_px / kReferenceHeight_px * static_cast<float>(picture_height_px),
                             static_cast<float>(picture_height_px))),
      text_px_(letters_px_) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is kept between runs
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  if (const std::string file = letters_file("DejaVuSans.ttf"); !file.empty())
    io.Fonts->AddFontFromFileTTF(file.c_str(), letters_px_);
  else
    io.Fonts->AddFontDefault();
  atlas_ = make_atlas(*io.Fonts);
  content_.atlas = atlas_;
  set_style(text_px_);
}

Panel::~Panel() {
  ImGui::DestroyContext(context_);
}

void Panel::take(std::span<const PointerEvent> events) {
  waiting_.insert(waiting_.end(), events.begin(), events.end());
}

/// The mouse as it is in this frame. Dear ImGui asks once a frame, so a press and its release need a frame each, and a
/// control that is held has to see where the mouse went before it is let go.
void Panel::feed() {
  ImGuiIO& io = ImGui::GetIO();
  bool moved = false;
  while (!waiting_.empty()) {
    const PointerEvent event = waiting_.front();
    using Kind = PointerEvent::Kind;
    const bool left = event.button == PointerEvent::Button::kLeft;
    const ImVec2 at{static_cast<float>(event.x_px), static_cast<float>(event.y_px)};
    if (event.kind == Kind::kRelease && left && moved && io.MouseDown[0]) return;
    moved |= at.x != io.MousePos.x || at.y != io.MousePos.y;
    io.MousePos = at;
    waiting_.pop_front();
    if (event.kind == Kind::kWheel) io.MouseWheel += static_cast<float>(event.wheel);
    if (!left || (event.kind != Kind::kPress && event.kind != Kind::kRelease)) continue;
    io.MouseDown[0] = event.kind == Kind::kPress;
    return;
  }
}

std::vector<PanelCommand> Panel::lay_out(const PanelFacts& facts, int width_px, int height_px, double dt_s) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width_px), static_cast<float>(height_px)};
  io.DeltaTime = static_cast<float>(std::clamp(dt_s, 1e-4, 1.0));
  if (const float text_px = text_px_of(io.DisplaySize.x, io.DisplaySize.y);
      std::exchange(text_px_, text_px) != text_px) {
    io.FontGlobalScale = text_px / letters_px_;
    set_style(text_px);
  }
  feed();
  ImGui::NewFrame();
  const float edge = 0.5f * ImGui::GetFontSize();
  const float width = std::min(kPanelWidth * ImGui::GetFontSize(), io.DisplaySize.x - 2.0f * edge);
  ImGui::SetNextWindowPos({edge, edge});
  // As high as its content, at most as the picture.
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, io.DisplaySize.y - 2.0f * edge});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  state_.places.clear(), state_.tips.clear();
  std::vector<PanelCommand> commands = panel_sections(facts, state_);
  const ImVec2 size = ImGui::GetWindowSize();
  ImGui::End();
  holds_mouse_ =
      ImGui::IsAnyItemActive() || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  rect_ = {edge, edge, edge + size.x, edge + size.y};
  ImGui::Render();
  copy_out(*ImGui::GetDrawData(), content_);
  return commands;
}

void Panel::hide() {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.MouseDown[0] = false;
  io.MouseWheel = 0.0f;
  waiting_.clear();
  state_.drag = {};
  rect_ = {};
  holds_mouse_ = false;
}

bool Panel::covers(double x_px, double y_px) const {
  return holds_mouse_ || rect_.holds(x_px, y_px);
}

const PanelRect* Panel::place(const std::string& control) const {
  const auto found = state_.places.find(control);
  return found == state_.places.end() ? nullptr : &found->second;
}

}  // namespace phare
