// A panel of one rectangle, 50 x 30 pixels from (10, 10).
#pragma once

#include <memory>
#include <utility>

#include "visual/gui_content.h"

namespace phare {

inline GuiContent panel(float right_px, float bottom_px) {
  GuiContent content;
  content.atlas = std::make_shared<const GuiAtlas>(GuiAtlas{1, 1, {255}});
  for (const auto& [x, y] : {std::pair(10.0f, 10.0f), {60.0f, 10.0f}, {60.0f, 40.0f}, {10.0f, 40.0f}})
    content.vertices.push_back({x, y, 0.5f, 0.5f, {200, 100, 50, 255}});
  content.indices = {0, 1, 2, 0, 2, 3};
  content.draws = {{.indices = 6, .right_px = right_px, .bottom_px = bottom_px}};
  return content;
}

}  // namespace phare
