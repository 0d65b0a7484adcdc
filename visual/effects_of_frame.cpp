#include "visual/effects_of_frame.h"

#include <fmt/format.h>

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

std::string cost_text(const FrameResult& frame, Effect effect) {
  const EffectCost& cost = frame.effect_costs[static_cast<std::size_t>(effect)];
  const std::optional<double> ms = effect_time_ms(frame, effect);
  std::string text;
  if (cost.passes > 0) text += fmt::format(", {} {}", cost.passes, cost.passes == 1 ? "pass" : "passes");
  if (cost.bytes > 0) text += fmt::format(", {:.1f} MB", static_cast<double>(cost.bytes) / 1e6);
  if (ms) text += fmt::format(", {:.2f} ms", *ms);
  return text;
}

std::vector<std::string> effect_sentences(const FrameResult& frame) {
  std::vector<std::string> lines;
  for (const EffectRow& row : effect_table()) {
    const EffectDecision& decision = frame.effects[row.effect];
    lines.push_back(fmt::format("{} {}{}: {}", row.name, row.levels[decision.level], cost_text(frame, row.effect),
                                decision.reason));
  }
  return lines;
}

}  // namespace phare
