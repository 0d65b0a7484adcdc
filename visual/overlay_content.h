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

}  // namespace phare
