// What comes out of a batch run: rows as CSV, a page with traces, and what is said at its end.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/base/whole_file.h"
#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/manoeuvre.h"
#include "vehicle_dynamics/plot_page.h"

namespace phare::batch {

struct OutputFiles {
  std::string rows, page, reference;  ///< empty: not asked for
};

class Output {
 public:
  /// `columns`: of RowColumn, in the file of rows. `what` names the run on its page. Error: a file that cannot be
  /// written, or a reference that cannot be read.
  static Result<Output> open(const OutputFiles& files, const Options& options, unsigned columns,
                             std::optional<Manoeuvre> standard, std::string what);

  void take(const Row& row);
  bool failed() const { return !written_.ok(); }
  /// The files are there, whole; then says on standard output, or standard error where the rows go there, what came
  /// out. `step_s`: of the run.
  Status finish(const Summary& summary, double step_s);

 private:
  Output(OutputFiles files, const Options& options, unsigned columns, std::optional<Manoeuvre> standard,
         std::string what);
  void pass_on(std::size_t from_size);
  std::vector<std::string> figure_lines() const;
  void tell(const Summary& summary, double step_s) const;
  std::string page(const Summary& summary, double step_s) const;

  OutputFiles files_;
  VehicleParams vehicle_;
  std::string vehicle_place_, what_;
  Level level_;
  double speed_mps_;
  unsigned columns_, shown_columns_;
  bool lamps_;
  std::optional<Manoeuvre> standard_;
  std::optional<WholeFile> file_;
  std::unique_ptr<ReferenceRun> reference_;  // traces_ points to it
  std::optional<Traces> traces_;
  std::vector<Row> rows_;  // of a manoeuvre, for its figures
  std::string text_;
  std::uint64_t below_ = 0;  // rows in which the beam does not reach the wall
  double lowest_m_ = 0.0;
  Status written_ = Done{};
};

}  // namespace phare::batch
