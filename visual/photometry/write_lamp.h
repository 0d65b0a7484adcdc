// Tables as photometry files. Numbers are the shortest that read back as the same double, so a file read again gives
// the same table (EULUMDAT: to the last bit but one, because it stores candela per 1000 lm).
#pragma once

#include <string>

#include "visual/photometry/intensity_table.h"

namespace phare {

/// LM-63-2019, the table's own type and grid, symmetry not folded. A flat screen is written on a type A grid.
/// Keywords come from the header. `generation` is field 12: 1.00010 computed, 1.00001 undefined or older file.
std::string lm63_text(const IntensityTable& table, const std::string& generation = "1.00001");

/// EULUMDAT, optical axis at gamma 0, absolute photometry (lamp count -1) with the table's flux. A type C table with
/// its axis there keeps its grid; any other is sampled on 360 planes and 311 gamma angles, 0.05° apart near the axis.
std::string eulumdat_text(const IntensityTable& table);

/// A candela grid as CSV with its remarks.
std::string csv_text(const IntensityTable& table);

}  // namespace phare
