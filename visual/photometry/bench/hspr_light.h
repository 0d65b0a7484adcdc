// The light of a pair of lamps as HSPR looks it up, and as it is: what the method's ranges, widths, flux and glare are
// made of. Facts from running the program HSPR 2.1.1, as the project's notes have them; the text of CE-5815 was not at
// hand. Frame: origin on the ground between the lamps, x right, y up, z ahead, metres. Checked by hspr_test.cpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// One lamp of the pair.
struct HsprLamp {
  const IntensityTable* table = nullptr;
  double x_m = 0.0;  ///< right positive
  double y_m = 0.75;
  double aim_up_deg = 0.0;
};

/// kMethod: on the method's grid and with its departures from physics. kPhysical: the same question asked of the table
/// itself, with the cosines that the method leaves out, dark outside the table.
enum class HsprView { kMethod, kPhysical };

/// A file as the method holds it: H -45 to 45 and V -15 to 15 in 0.05°, 0 outside the file's own angles.
class HsprGrid {
 public:
  static constexpr std::size_t kColumns = 1801, kRows = 601;
  static constexpr double kStep_deg = 0.05, kWide_deg = 45.0, kHigh_deg = 15.0;

  explicit HsprGrid(const HsprLamp& lamp);
  /// Beyond its angles the grid gives its edge, as the method does.
  double nearest_cd(double h_deg, double v_deg) const;
  double bilinear_cd(double h_deg, double v_deg) const;
  double at(std::size_t column, std::size_t row) const { return candela_[row * kColumns + column]; }

 private:
  std::vector<double> candela_;  ///< [row][column], from the lower left
};

/// A weighted part of the glare window: columns of 0.01 m from `x_m` (their left edge), all rows.
struct HsprStrip {
  double x_m = 0.0;
  int columns = 0;
  double factor = 1.0;
  double z_end_m = 50.0;  ///< the method moves the strip away by its end; physically it lies at 50 m
};

class HsprLight {
 public:
  explicit HsprLight(std::span<const HsprLamp> lamps);

  /// Lux on a plane that faces the car: Σ I·z/d³. The method takes the nearest node.
  double lux(HsprView view, double x_m, double y_m, double z_m) const;
  /// Lumens into H ±45° and V from `low` to `high`. The method samples every 0.01°, both ends, without the cosine of V,
  /// each lamp's grid turned outwards by half the lamps' distance seen from `shift_at_m`.
  double flux_lm(HsprView view, double v_low_deg, double v_high_deg, double shift_at_m) const;
  /// Lumens, weighted, into a window at 50 m, y 0.93 to 1.62 m; one number a lamp. `weight` of row (from the top) and
  /// column of samples, row 0 to 49 and column of the strip. The method leaves out the window's cosine.
  std::vector<double> glare_lm(HsprView view, std::span<const HsprStrip> strips,
                               const std::function<double(int row, int column)>& weight) const;
  /// Brightest of lamp `lamp` on a line of constant V, at 100 even steps in H, on the method's grid.
  double brightest_cd(std::size_t lamp, double h_from_deg, double h_to_deg, double v_deg) const;

  std::span<const HsprLamp> lamps() const { return lamps_; }
  double spacing_m() const;

 private:
  double physical_cd(std::size_t lamp, double dx, double dy, double dz) const;

  std::vector<HsprLamp> lamps_;
  std::vector<std::shared_ptr<const HsprGrid>> grids_;  ///< of each lamp; of equal tables aimed alike it is one
};

/// Walks from `from` inwards in even steps to the first place where E is strictly above the threshold; nothing if E
/// never is before 0.
std::optional<double> hspr_walk_in(double from, double step, double threshold_lx,
                                   const std::function<double(double)>& lux_at);

/// The method's figure is that of its walk; physically E crosses the threshold within the last step, at a place known
/// to 2^-40 of the step.
std::optional<double> hspr_reach(HsprView view, double from, double step, double threshold_lx,
                                 const std::function<double(double)>& lux_at);

}  // namespace phare
