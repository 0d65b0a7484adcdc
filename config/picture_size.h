// How wide and high a picture may be, by a rig file and by --size.
#pragma once

namespace phare {

/// Pixels a side: the least is chosen; the most is what devices take (visual/renderer.cpp refuses what is too large in
/// all).
inline constexpr int kLeastSide_px = 16, kMostSide_px = 16384;

}  // namespace phare
