// What the effects of a drawn frame were over all its views, and what they took. Pure.
// Checked by tests/visual/renderer_test.cpp, tests/visual/glare_test.cpp and tests/visual_process/frame_stats_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
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

/// ", 2 passes, 4.2 MB, 0.31 ms": what it added to the frame; nothing for what draws in the pass of another.
std::string cost_text(const FrameResult& frame, Effect effect);

/// "shadows soft, 1 pass, 12.6 MB, 3.04 ms: 69 pieces …" for each effect, in letters that are not all equally wide.
std::vector<std::string> effect_sentences(const FrameResult& frame);

}  // namespace phare
