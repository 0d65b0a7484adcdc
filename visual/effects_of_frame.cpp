#include "visual/effects_of_frame.h"

#include <cstddef>

namespace phare {

EffectPlan plan_over(std::span<const ViewResult> views) {
  EffectPlan plan = views.front().effects;
  for (const ViewResult& view : views.subspan(1))
    for (std::size_t i = 0; i < effect_table().size(); ++i) {
      const EffectDecision& there = view.effects.decisions[i];
      if (EffectDecision& told = plan.decisions[i]; told.level == 0 && there.level > 0)
        told = {there.level, "in " + view.name + ": " + there.reason, there.settled};
    }
  return plan;
}

std::vector<Effect> differing_effects(const ViewResult& own, const ViewResult& view) {
  std::vector<Effect> result;
  for (const EffectRow& row : effect_table()) {
    if (row.effect == Effect::kOverlay || row.effect == Effect::kGui) continue;
    if (view.effects.level(row.effect) != own.effects.level(row.effect)) result.push_back(row.effect);
  }
  return result;
}

std::optional<double> effect_time_ms(const FrameResult& frame, Effect effect) {
  std::optional<double> ms;
  for (const PassTime& pass : frame.passes)
    if (pass.effect == effect) ms = ms.value_or(0.0) + pass.ms;
  return ms;
}

}  // namespace phare
