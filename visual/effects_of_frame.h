// What the effects of a drawn frame were over all its views, and what they took. Pure.
// Checked by tests/visual/renderer_test.cpp, tests/visual/glare_test.cpp and tests/visual_process/frame_stats_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "visual/renderer.h"

namespace phare {

/// What the frame's own view has on, by its reason; and what only another has, by the first that has it, which is named
/// before the reason. `views`: one at least.
EffectPlan plan_over(std::span<const ViewResult> views);

/// Effects whose level in `view` is another than in the frame's own view, `own`. Overlay and panel lie over the frame
/// and are none of a view's.
std::vector<Effect> differing_effects(const ViewResult& own, const ViewResult& view);

/// On the device: passes that the effect calls for, those that only copy too; nothing: it has none among those timed.
std::optional<double> effect_time_ms(const FrameResult& frame, Effect effect);

}  // namespace phare
