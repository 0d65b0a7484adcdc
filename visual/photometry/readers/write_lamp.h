// Tables as photometry files. Numbers are the shortest that read back as the same double, so a file read again gives
// the same table (EULUMDAT: to the last bit but one, because it stores candela per 1000 lm).
#pragma once

#include <string>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// LM-63-2019, the table's own type and grid, symmetry not folded. A flat screen is written on a type A grid.
/// Keywords, lamps and rated lumens (of relative photometry), size of the opening and watts come from the header.
/// `generation` is field 12: 1.00010 computed, 1.00001 undefined or older file.
std::string lm63_text(const IntensityTable& table, const std::string& generation = "1.00001");

/// EULUMDAT. Absolute photometry has lamp count -1 and the table's flux, relative that of its lamps and the output
/// ratio. A type C table whose axis is `axis` keeps its grid, and so does a type A table with kGamma90 (C = -H, gamma =
/// 90 + V). Any other is sampled: with kGamma0 on 360 planes and 311 gamma angles, 0.05° apart near the axis.
std::string eulumdat_text(const IntensityTable& table, GammaAxis axis = GammaAxis::kGamma0);

/// A candela grid as CSV with its remarks; a flat screen as what it was, lux over y and z.
std::string csv_text(const IntensityTable& table);

/// "Right-hand traffic", "RHT" and their like in a text turned to the side asked for; whole words, any case.
std::string with_traffic_side(const std::string& text, bool left_hand);

}  // namespace phare
