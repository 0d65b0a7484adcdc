// Where the rays of fog's grid go: close together where light in fog changes fast. Pure.
//
// Beside a lamp it changes as one over the distance, so nodes lie in a geometric row about it, down to the width of
// its lens; about the cut-offs of the lamps that look ahead it changes by the tenth of a degree. Checked by
// tests/visual/fog_test.cpp.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "visual/view.h"

namespace phare {

/// A place along one side of a picture, 0 to 1, about which nodes lie in a geometric row down to its width.
struct NodePeak {
  double at_01 = 0.0, width_01 = 0.0;
};

/// A part of a side within which nodes lie kCloser times closer.
struct NodeBand {
  double from_01 = 0.0, to_01 = 0.0;
};

/// Of one side: places from 0 to 1, rising, and what they lie about: peaks that are apart, rising.
struct NodeRow {
  std::vector<double> at_01{};
  std::vector<NodePeak> peaks{};
};

struct FogNodes {
  NodeRow columns{}, rows{};
};

/// `count` places, of which `share_of_peaks` lie about the peaks, where there are any: as many to each factor of
/// distance from every one.
NodeRow place_nodes(std::size_t count, std::span<const NodeBand> bands, std::vector<NodePeak> peaks,
                    double share_of_peaks);

/// A lamp as it stands before the eye: where from it, and the way its light goes, both in the world's directions.
struct LampInFog {
  glm::dvec3 from_eye_m{}, forward{};
};

/// For a view of so many pixels. `columns_of_peaks`: the share of them about lamps in view.
FogNodes place_nodes(const ViewGeometry& view, const glm::dvec2& size_px, std::span<const LampInFog> lamps,
                     std::size_t columns, std::size_t rows, double columns_of_peaks);

/// For every pixel of a side where among the nodes its middle lies: node, and the weight of the next. Beside a peak
/// light falls as one over the distance, which a straight line between nodes overshoots; the weight follows that fall
/// by the most part (what lies as far across as along the side falls less).
std::vector<double> places_of_pixels(const NodeRow& nodes, double first_px, double size_px);

}  // namespace phare
