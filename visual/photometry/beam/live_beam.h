// The beam image of a lamp position while its sources are switched, dimmed and exchanged: summed again only where
// something changed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/beam_image.h"

namespace phare {

/// Sources that share their angles are summed on the union of their nodes, exactly. While sources of different angles
/// are lit together they are resampled onto one grid, and only then.
class LiveBeam {
 public:
  /// All sources of the position; their `scale` is that of full light. All are off at first. Tables outlive this.
  explicit LiveBeam(std::vector<AimedSource> sources);

  void set_dimming(std::size_t source, double dimming_01);  ///< 0: off, 1: full; the same value: nothing to do
  /// Another table with the same nodes (of a pixel light).
  void set_table(std::size_t source, const IntensityTable& table);
  /// Rectangles of nodes of a table that changes, and the flux it has now.
  void table_changed(std::size_t source, std::span<const TexelRect> nodes, double flux_lm);

  /// What an update did to the image.
  enum class Change { kNone, kPart, kWhole };
  /// Brings the image up to date.
  Change update();

  const BeamImage& image() const { return image_; }
  /// Rectangles that the last update changed, of the image's nodes.
  std::span<const TexelRect> changed() const { return changed_; }
  double lumens() const;  ///< of all sources as they are dimmed
  std::size_t sources() const { return sources_.size(); }
  /// Nodes summed since the start.
  std::uint64_t summed_texels() const;

 private:
  struct Source {
    AimedSource light;
    double dimming_01 = 0.0;
    double lumens = 0.0;  ///< at full light
    glm::vec3 colour{1.0f};
    std::size_t kind = 0;  ///< sources of one kind share their angles
  };
  /// Some of the sources on a grid.
  struct Sum {
    BeamGrid grid;
    BeamComposer composer;
    std::vector<std::size_t> source_of;  ///< of the composer's sources
  };
  std::optional<std::size_t> wanted_sum() const;
  Sum make_sum(std::size_t which) const;
  template <typename Do>
  void change_sums_of(std::size_t source, Do&& change);
  bool colours_differ() const;  ///< of the sources that shine
  glm::vec3 mean_colour() const;

  std::vector<Source> sources_;
  std::vector<std::optional<Sum>> sums_;  ///< of each kind, and last of all; made when first wanted
  std::optional<std::size_t> shown_;      ///< whose grid the image has
  BeamImage image_;
  std::vector<TexelRect> changed_;
  bool stale_ = true;
};

}  // namespace phare
