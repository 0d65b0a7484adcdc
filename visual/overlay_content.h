// What the overlay shows over the picture: text, apart from how it is drawn.
#pragma once

#include <string>
#include <vector>

namespace phare {

/// sRGB.
struct OverlayColour {
  unsigned char red = 235, green = 235, blue = 225;

  friend bool operator==(const OverlayColour&, const OverlayColour&) = default;
};

/// A piece of the instruments at the lower edge.
struct OverlayInstrument {
  std::string text;
  OverlayColour colour{};
  bool large = false;

  friend bool operator==(const OverlayInstrument&, const OverlayInstrument&) = default;
};

/// A box with a heading and two columns.
struct OverlayPanel {
  /// Above the middle, where the sky is; along the left edge from top to bottom; above the middle of a window that
  /// shows nothing else.
  enum class Place { kTop, kLeft, kAlone };
  struct Row {
    std::string key, words;  ///< no key: the words alone, from the left edge

    friend bool operator==(const Row&, const Row&) = default;
  };
  std::string title;
  std::vector<Row> rows{};
  Place place = Place::kTop;

  bool empty() const { return title.empty() && rows.empty(); }
  friend bool operator==(const OverlayPanel&, const OverlayPanel&) = default;
};

/// What insets leave to the text.
struct OverlayRoom {
  double lines_width_01 = 1.0;   ///< of the picture's, from its left edge
  double lines_height_01 = 1.0;  ///< of its height; more lines than fit are written smaller, down to half
  double left_01 = 0.0;          ///< what is left of it is taken, from the picture's left edge
  double panel_top_01 = 0.07;    ///< of a panel above the middle

  friend bool operator==(const OverlayRoom&, const OverlayRoom&) = default;
};

/// Drawn on the picture, under the text; places are shares of its width and height from the upper left corner.
struct OverlayMarks {
  struct Box {
    double left_01 = 0.0, top_01 = 0.0, width_01 = 0.0, height_01 = 0.0;
    OverlayColour colour{};
    unsigned char alpha = 255;
  };
  struct Line {
    double x0_01 = 0.0, y0_01 = 0.0, x1_01 = 0.0, y1_01 = 0.0;
    OverlayColour colour{};
  };
  /// Begins at its place, and lies about its height.
  struct Label {
    double x_01 = 0.0, y_01 = 0.0;
    std::string text;
    OverlayColour colour{};
    double room_01 = 0.0;  ///< of the width: letters shrink until it fits; 0: as wide as it comes
  };
  std::vector<Box> boxes{};  ///< below the lines, in order
  std::vector<Line> lines{};
  std::vector<Label> labels{};

  std::size_t size() const { return boxes.size() + lines.size() + labels.size(); }
};

}  // namespace phare
