// The panel: what a person sets by the mouse, laid out by Dear ImGui. It reads facts and answers with the commands that
// keys, `phare control` and the bus give too; it changes nothing itself. Knows no window and no device:
// tests/visual_process/panel_test.cpp feeds it a mouse.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "config/key_bindings.h"
#include "net/messages.h"
#include "visual/gui_content.h"
#include "visual/overlay_content.h"
#include "visual/process/panel_facts.h"
#include "visual/process/pointer_event.h"

struct ImGuiContext;

namespace phare {

/// A command, or a key as if it were pressed: those of the car are the cockpit's.
using PanelCommand = std::variant<RigControl, KeyAction>;

/// Where something lies in the picture, px from its upper left corner.
struct PanelRect {
  double left_px = 0.0, top_px = 0.0, right_px = 0.0, bottom_px = 0.0;

  bool holds(double x_px, double y_px) const {
    return x_px >= left_px && x_px < right_px && y_px >= top_px && y_px < bottom_px;
  }
};

/// What is chosen in the panel itself, and what a slider has done since it was taken hold of.
struct PanelState {
  std::size_t lamp = 0;
  struct Drag {
    bool sent = false;
    std::size_t design = 0, steps = 0;  ///< where the commands of it stand in what can be taken back
  } drag;
  std::map<std::string, PanelRect> places;    ///< of this frame's controls, by name
  std::map<std::string, std::string> tips{};  ///< what each says when the mouse rests on it
};

/// The controls inside a window of Dear ImGui that has begun (panel_sections.cpp).
std::vector<PanelCommand> panel_sections(const PanelFacts& facts, PanelState& state);

class Panel {
 public:
  /// Letters are made for a picture of this height, 16:9, and drawn larger or smaller in one of another size.
  explicit Panel(int picture_height_px);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  /// What the mouse did; takes effect with the next frames, one press or release in each, that none is missed.
  void take(std::span<const PointerEvent> events);
  /// A frame of a picture of this size, `dt_s` after the last: what it shows is content(), what was asked is returned.
  std::vector<PanelCommand> lay_out(const PanelFacts& facts, int width_px, int height_px, double dt_s);
  /// Of the newest frame; valid until the next.
  const GuiContent& content() const { return content_; }
  /// The mouse is let go, and what it did is forgotten.
  void hide();

  /// Whether the mouse there is the panel's, not the road's.
  bool covers(double x_px, double y_px) const;
  /// Of the newest frame, px from the picture's left edge: what is right of it is free.
  double right_px() const { return rect_.right_px; }
  /// Where a control lies, by its name ("lamp pitch", "view"); nothing: it is not shown.
  const PanelRect* place(const std::string& control) const;
  /// What controls say when the mouse rests on them: the key or the command that does the same.
  const std::map<std::string, std::string>& tips() const { return state_.tips; }

 private:
  void feed();

  ImGuiContext* context_ = nullptr;
  float letters_px_, text_px_;  ///< as they were made, and as they are drawn
  std::shared_ptr<const GuiAtlas> atlas_;
  GuiContent content_;
  std::deque<PointerEvent> waiting_;
  PanelState state_;
  PanelRect rect_;
  bool holds_mouse_ = false;  ///< a list is open, or a control is held
};

}  // namespace phare
