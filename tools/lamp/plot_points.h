// phare lamp plot of a laboratory's list of points.
#pragma once

#include "tools/lamp/lamp_commands.h"
#include "visual/photometry/readers/point_list.h"

namespace phare {

/// wall_25m of every beam of the list, over the rows of the rule. Returns the program's exit code.
int plot_points(const LampPlotOptions& options, const PointLists& lists);

}  // namespace phare
