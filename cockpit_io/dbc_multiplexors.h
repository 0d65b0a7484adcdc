// Which multiplexor switches which signal of a DBC file, once all statements are read.
#pragma once

#include "cockpit_io/dbc.h"

namespace phare {

/// A multiplexor that is always present.
bool is_root_multiplexor(const DbcSignal& signal);

/// A signal with m and a number and without SG_MUL_VAL_ hangs on the one multiplexor that is always present. Signals
/// without one or with a choice of several, and those whose multiplexors hang on each other, become problems and are
/// left out. To be called when all of SG_MUL_VAL_ has been read.
void hang_multiplexors(Dbc& dbc);

}  // namespace phare
