// What the effects are decided by (visual/effects.h), of a frame that is asked for. Pure: `--explain` has it without a
// device.
#pragma once

#include "visual/effects.h"
#include "visual/renderer.h"

namespace phare {

/// `lit_lamps`: positions that give light in this view; `software_device`: it computes on the processor.
EffectFacts facts_of(const FrameInput& input, std::size_t lit_lamps, bool software_device);

}  // namespace phare
