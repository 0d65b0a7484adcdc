// Tables whose nodes lie evenly: the grid that has all nodes of an axis. Pure. Checked with every format of
// tests/visual/formats_on_device_test.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace phare {

inline constexpr std::int64_t kMaxEvenCells = 1 << 20;  ///< of a grid of both axes: 16 MiB

/// Nodes a step apart from a phase; or multiples of a fine step within ±fine·step, beyond that of a coarse one from
/// there.
struct EvenAxis {
  double step = 0.0;        ///< degrees (of a screen: metres)
  double phase = 0.0;       ///< steps from 0 to node 0, below 1; 0 where there is a coarse step
  std::int64_t fine = 0;    ///< fine nodes on either side of 0
  std::int64_t coarse = 1;  ///< fine steps in a coarse one
  std::int64_t first = 0;   ///< node
  std::int64_t count = 0;
  std::vector<double> beside{};  ///< of nodes rounded in the file: how many steps beside it each lies; else empty
  /// Of nodes that were rounded to decimals: in units of the last one, which is `unit` steps, node k lay part·k + from
  /// beside a whole number.
  struct Decimals {
    double unit = 0.0, part = 0.0, from = 0.0;
  };
  std::optional<Decimals> decimals{};

  std::int64_t last() const { return first + count - 1; }
  double angle(double node) const {
    if (coarse == 1) return (node + phase) * step;
    const double inner = std::clamp(node, -static_cast<double>(fine), static_cast<double>(fine));
    return (inner + (node - inner) * static_cast<double>(coarse)) * step;
  }
};

/// Angles as written, in millionths of a degree (of a screen: places in millionths of a metre); nothing if one is not
/// whole.
std::optional<std::vector<std::int64_t>> in_millionths(const std::vector<double>& nodes);

/// The even axis of this coarse step with the fewest nodes that has all of these, in millionths; nothing if that takes
/// more than 4096. `turn`: nodes are counted from multiples of 45°, as a whole turn is.
std::optional<EvenAxis> even_axis(const std::vector<std::int64_t>& nodes, std::int64_t coarse, bool turn);

/// Both axes (degrees, ascending, at least 2 nodes each) with one coarse step, for the shader has room for one. The
/// fewest cells win; rounded nodes where exact ones would take more than 8 for each node of the table, unless they are
/// few. Nothing: more than kMaxEvenCells, or nodes that are not even.
std::optional<std::pair<EvenAxis, EvenAxis>> even_axes(const std::vector<double>& first_deg,
                                                       const std::vector<double>& second_deg, bool turn);

}  // namespace phare
