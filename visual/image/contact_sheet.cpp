#include "visual/image/contact_sheet.h"

#include <algorithm>

#include "visual/image/canvas.h"
#include "visual/image/image.h"

namespace phare {
namespace {

constexpr int kColumns = 4;
constexpr int kGap_px = 6;

}  // namespace

SheetLayout contact_sheet_layout(std::size_t count, int picture_width_px, int picture_height_px) {
  SheetLayout layout;
  const int pictures = static_cast<int>(count);
  if (pictures == 0) return layout;
  layout.columns = std::min(kColumns, pictures);
  layout.rows = (pictures + layout.columns - 1) / layout.columns;
  layout.cell_width_px = picture_width_px + kGap_px;
  layout.cell_height_px = picture_height_px + text_height_px() + 3 + kGap_px;
  layout.width_px = layout.columns * layout.cell_width_px + kGap_px;
  layout.height_px = layout.rows * layout.cell_height_px + kGap_px;
  return layout;
}

Image8 contact_sheet(const std::vector<LabelledImage>& pictures) {
  if (pictures.empty()) return {};
  const Image8& first = pictures.front().image;
  const SheetLayout layout = contact_sheet_layout(pictures.size(), first.width_px, first.height_px);
  Image8 sheet = blank_image(layout.width_px, layout.height_px, 24, 24, 26);
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
    const LabelledImage& picture = pictures[static_cast<std::size_t>(i)];
    const int x = kGap_px + i % layout.columns * layout.cell_width_px;
    const int y = kGap_px + i / layout.columns * layout.cell_height_px;
    paste(sheet, picture.image, x, y);
    draw_text(sheet, x + 2, y + first.height_px + 2, picture.label, {220, 220, 220});
  }
  return sheet;
}

void Thumbnails::offer(LabelledImage picture) {
  if (wants_next()) kept_.push_back(std::move(picture));
  ++offered_;
  if (kept_.size() < kMost) return;
  for (std::size_t i = 1; i < kMost / 2; ++i) kept_[i] = std::move(kept_[2 * i]);
  kept_.resize(kMost / 2);
  stride_ *= 2;
}

std::vector<LabelledImage> Thumbnails::pick(std::size_t count) const {
  if (kept_.size() <= count) return kept_;
  std::vector<LabelledImage> picked;
  for (std::size_t i = 0; i < count; ++i) picked.push_back(kept_[count < 2 ? 0 : i * (kept_.size() - 1) / (count - 1)]);
  return picked;
}

}  // namespace phare
