// What the gui pass draws over the picture: triangles in pixels, textured with letters, apart from who laid them out.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace phare {

/// Coverage of letters and of what is filled, one byte a texel, rows from the top.
struct GuiAtlas {
  std::uint32_t width_px = 0, height_px = 0;
  std::vector<std::uint8_t> coverage;
};

struct GuiVertex {
  float x_px = 0.0f, y_px = 0.0f;       ///< from the picture's upper left corner
  float u_01 = 0.0f, v_01 = 0.0f;       ///< of the atlas
  std::array<std::uint8_t, 4> srgba{};  ///< as displayed; alpha is how much of it covers what lies below

  friend bool operator==(const GuiVertex&, const GuiVertex&) = default;
};

/// Triangles inside one rectangle; what sticks out of it is cut off.
struct GuiDraw {
  std::uint32_t first_index = 0, indices = 0;
  std::uint32_t first_vertex = 0;  ///< that index 0 means
  float left_px = 0.0f, top_px = 0.0f, right_px = 0.0f, bottom_px = 0.0f;
};

struct GuiContent {
  std::shared_ptr<const GuiAtlas> atlas{};  ///< never null where something is drawn; another one is uploaded anew
  std::vector<GuiVertex> vertices{};
  std::vector<std::uint16_t> indices{};
  std::vector<GuiDraw> draws{};  ///< in order, later ones over earlier ones
};

}  // namespace phare
