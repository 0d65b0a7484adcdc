// The page of a batch run: figures and traces as SVG in one HTML file without scripts, for screen and printer.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vehicle_dynamics/traces.h"

namespace phare::batch {

struct PageWords {
  std::string title;                                       ///< manoeuvre or inputs
  std::vector<std::pair<std::string, std::string>> facts;  ///< "vehicle", "Compact hatchback (chosen)"
  std::vector<std::string> figures;                        ///< of a manoeuvre, "stopping distance 36.1 m"
  std::vector<LevelSwitch> switched;                       ///< of level auto, drawn as lines in every panel
};

std::string plot_page(const PageWords& words, const Traces& traces);

}  // namespace phare::batch
