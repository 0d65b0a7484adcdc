// A drive on one page: thumbnails in a grid, each with its label.
#pragma once

#include <string>
#include <vector>

#include "visual/renderer.h"

namespace phare {

struct LabelledImage {
  Image8 image;
  std::string label;
};

struct SheetLayout {
  int columns = 0, rows = 0;
  int cell_width_px = 0, cell_height_px = 0;  ///< picture, label and gap
  int width_px = 0, height_px = 0;
};

/// Four columns (fewer for fewer pictures), as many rows as needed.
SheetLayout contact_sheet_layout(std::size_t count, int picture_width_px, int picture_height_px);
/// All pictures have the size of the first. An empty list gives an empty image.
Image8 contact_sheet(const std::vector<LabelledImage>& pictures);

/// Keeps at most `kMost` pictures spread evenly over a run of unknown length: when full, every other one is dropped and
/// from then on only every second, fourth, ... offered one is taken. Memory stays bounded over any drive.
class Thumbnails {
 public:
  static constexpr std::size_t kMost = 32;

  /// True when the next offered picture would be kept.
  bool wants_next() const { return offered_ % stride_ == 0; }
  void offer(LabelledImage picture);
  /// For pictures not even made because wants_next() was false.
  void skip() { ++offered_; }
  /// At most `count` of them, evenly chosen, first and last included.
  std::vector<LabelledImage> pick(std::size_t count) const;
  std::size_t size() const { return kept_.size(); }

 private:
  std::vector<LabelledImage> kept_;
  std::size_t offered_ = 0;
  std::size_t stride_ = 1;
};

}  // namespace phare
