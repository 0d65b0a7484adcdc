// phare-dynamics --batch: the command line of batch runs and of measurements.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "config/base/result.h"
#include "vehicle_dynamics/levelling.h"
#include "vehicle_dynamics/road_laid.h"

namespace CLI {
class App;
}

namespace phare {
namespace batch {
struct Options;
}

/// Adds the options to the program's, and runs what they ask for.
class BatchCommand {
 public:
  BatchCommand();
  ~BatchCommand();
  void add_to(CLI::App& app);
  /// One of --batch, --manoeuvre, --seconds, --compare, --work-precision was given.
  bool asked() const;
  /// Whether every option given has a meaning in the kind of run asked for; Error names the first that has none.
  Status options_fit() const;
  /// --levelling, which counts for a live run too; nullopt: not given.
  std::optional<levelling::Kind> levelling() const;

  /// What the road is like beyond its scene, and the vehicle instead of the rig's (empty: the rig's).
  Conditions conditions() const;
  const std::string& vehicle() const;
  /// Exit code; says on stderr what was wrong.
  int run(const std::string& level) const;

 private:
  struct Options;
  Status driver_fits() const;
  Status read_path(batch::Options& to) const;
  std::unique_ptr<Options> options_;
};

}  // namespace phare
