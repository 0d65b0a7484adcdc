// The image of a lamp position kept up to date: many dimmable sources on one grid, and when some change, only the
// rectangles they shine into are summed again.
#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// What was done so far, for tests and reports.
struct ComposeCount {
  std::size_t images = 0;   ///< updates that changed something
  std::size_t idle = 0;     ///< updates that found nothing changed
  std::size_t sources = 0;  ///< sources sampled onto the grid (made, swivelled or exchanged)
  std::size_t texels = 0;   ///< texels summed again
};

/// A rectangle of texels, half open.
struct TexelRect {
  std::size_t column = 0, row = 0, end_column = 0, end_row = 0;
  bool empty() const { return column >= end_column || row >= end_row; }
  std::size_t texels() const { return empty() ? 0 : (end_column - column) * (end_row - row); }
};

/// Sums sources into one image in candela, float32. Each source is sampled once onto its own rectangle of the grid; a
/// change of dimming sums again only that rectangle, from all sources that reach into it and in their order, so the
/// image is at every moment the same, bit for bit, as one made from nothing: no drift from adding differences.
class BeamComposer {
 public:
  /// A grid in the angles of a type, or on a flat screen. Nodes strictly ascending, at least 2 each.
  BeamComposer(std::vector<double> first_deg, std::vector<double> second_deg,
               PhotometricType type = PhotometricType::kA, GammaAxis axis = GammaAxis::kGamma0, bool screen = false);

  /// Adds a source, undimmed; returns its index. The table must outlive the composer. Columns of `image_from_lamp`: the
  /// lamp's forward, left, up in the image's frame. Sources of the grid's own type that are not turned keep their
  /// nodes. `colour`: linear sRGB of its light, luminance 1.
  /// `changes`: what of the table is dark now may shine later (table_changed).
  std::size_t add(const IntensityTable& table, const glm::dmat3& image_from_lamp = glm::dmat3{1.0},
                  const glm::vec3& colour = glm::vec3{1.0f}, bool changes = false);
  void set_dimming(std::size_t source, double scale);                     ///< 0 = off; same value: nothing to do
  void set_swivel(std::size_t source, double yaw_rad, double pitch_rad);  ///< left and up positive
  void set_table(std::size_t source, const IntensityTable& table);
  /// In a table that changes the candela of these rectangles of its own nodes have.
  void table_changed(std::size_t source, std::span<const TexelRect> nodes);

  /// Whether candela weighted by red and by blue are summed beside candela. Off at first, and costs nothing then;
  /// turned on, the next update sums them for the whole image.
  void keep_tints(bool wanted);

  /// Brings the image up to date. Returns the rectangles that changed (for the upload); none when nothing did.
  std::vector<TexelRect> update();

  std::span<const float> candela() const { return image_; }    ///< [second][first]
  std::span<const glm::vec2> tints() const { return tints_; }  ///< candela times red, times blue; empty unless kept
  std::size_t columns() const { return first_deg_.size(); }
  std::size_t rows() const { return second_deg_.size(); }
  const ComposeCount& count() const { return count_; }

 private:
  struct Source {
    const IntensityTable* table = nullptr;
    glm::dmat3 image_from_lamp{1.0};
    glm::vec2 red_blue{1.0f};  ///< of its light
    float scale = 1.0f;
    TexelRect rect;              ///< where it shines
    std::vector<float> candela;  ///< of the rectangle, undimmed
    bool dirty = true;
    bool changes = false;
  };
  bool as_filed(const Source& source) const;
  void sample(Source& source);
  template <typename Row>
  void each_row(const TexelRect& rect, std::size_t j, Row&& row) const;
  void sum(const TexelRect& rect);
  void sum_tints(const TexelRect& rect);

  std::vector<double> first_deg_, second_deg_;
  PhotometricType type_;
  GammaAxis axis_;
  bool screen_;
  std::vector<Source> sources_;
  std::vector<float> image_;
  std::vector<glm::vec2> tints_;
  bool tinted_ = false;
  std::vector<TexelRect> stale_;  ///< rectangles that sources have left
  ComposeCount count_;
};

}  // namespace phare
