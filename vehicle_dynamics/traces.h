// What a batch run's page shows: the rows of a run as traces that do not grow with it, and how far they are from a
// reference.
//
// A trace is thinned to at most 2000 pieces of the run, of each the least and the largest value: no peak is lost,
// however long the run. The difference from a reference is taken from every row. Tests:
// tests/vehicle_dynamics/plot_page_test.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vehicle_dynamics/batch.h"

namespace phare::batch {

/// One line of a panel.
struct Quantity {
  const char* column;  ///< of OUT, by which a reference may call it
  const char* alias;   ///< as the reference runs of other programs call it, or nullptr
  const char* legend;  ///< beside others of its panel
  std::size_t at;      ///< number in a Row
};

struct Panel {
  const char* title;
  const char* unit;
  double scale;        ///< unit per SI unit
  unsigned only_with;  ///< bits of RowColumn, 0: always
  bool lamps;          ///< only where the vehicle has lamps
  std::vector<Quantity> lines;
};
const std::vector<Panel>& panels();

/// A run of another program or of ours: times and columns that a panel knows.
struct ReferenceRun {
  std::string name;
  std::vector<double> time_s;
  std::map<std::string, std::vector<double>> columns;  ///< by the Quantity's column; SI units
};
/// A CSV with time_s or t, and columns called as in OUT or as in the reference runs (yaw_rate, pitch, X, …). Error:
/// none that a panel shows, or time that does not rise.
Result<ReferenceRun> read_reference_run(const std::filesystem::path& file);

/// How far a line is from its reference, at the reference's times.
struct Difference {
  double largest = 0.0, at_s = 0.0, sum_of_squares = 0.0, peak = 0.0;  ///< peak: of the reference
  std::size_t count = 0;
};

class Traces {
 public:
  Traces(bool lamps, unsigned columns, const ReferenceRun* reference);
  void add(const Row& row);

  struct Piece {
    double from_s = 0.0, to_s = 0.0;
    std::vector<float> least, largest;  ///< of every Row number
  };
  const std::vector<Piece>& pieces() const { return pieces_; }
  bool shows(const Panel& panel) const;
  /// nullptr: the reference does not have it.
  const Difference* difference(const Quantity& quantity) const;
  const ReferenceRun* reference() const { return reference_; }

 private:
  void compare(const Row& row);

  bool lamps_;
  unsigned columns_;
  const ReferenceRun* reference_;
  std::size_t rows_per_piece_ = 1, rows_in_last_ = 0, next_ = 0;  ///< next: of the reference's times
  std::vector<Piece> pieces_;
  std::optional<Row> before_;
  std::map<std::string, Difference> differences_;
};

}  // namespace phare::batch
