// What the effects are decided by (visual/effects.h), of a view that is asked for. Pure: `--explain` has it without a
// device.
#pragma once

#include "visual/effects.h"
#include "visual/renderer.h"

namespace phare {

/// `lit_lamps`: that light something in the view; `casters`: pieces of the scene that stand in their light; `lines`: of
/// text that will lie over it; `software_device`: it computes on the processor.
EffectFacts facts_of(const ViewInput& view, std::size_t lit_lamps, std::size_t casters, std::size_t lines,
                     bool software_device);

/// Lines of text over the frame's picture.
std::size_t text_lines(const FrameInput& input);

}  // namespace phare
