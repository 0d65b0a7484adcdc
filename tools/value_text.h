// Physical values of CAN signals as text that loses nothing: what phare can list and decode print.
#pragma once

#include <cstdint>
#include <string>

#include "cockpit_io/dbc.h"

namespace phare {

/// The fewest digits that give the same double again; whole numbers below 2^53 without an exponent.
std::string shortest_text(double value);

/// The physical value of raw bits; `value` is the same as decode() gives it. Of a signal of whole numbers it is counted
/// in decimals, to the digits that factor and offset have: 3 × 0.1 is 0.3, and 64 bits keep all theirs. A fraction
/// beyond 17 digits, which no double holds, and floats: shortest_text().
std::string value_text(const DbcSignal& signal, std::uint64_t raw, double value);

}  // namespace phare
