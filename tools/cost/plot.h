// Error against time of a ladder, both in powers of ten, with the levels that are worth it joined and named.
#pragma once

#include <string>

#include "config/base/result.h"
#include "tools/cost/ladder.h"

namespace phare::cost {

/// Writes `stem`.svg and `stem`.png.
Status plot(const Ladder& ladder, const std::string& stem);

}  // namespace phare::cost
