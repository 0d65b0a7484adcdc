// Which lamps a picture is lit by, and which glare in it: all that shine, as far as the device has what it takes. What
// shines for the first time in a kind of picture, and was not made ready before the drive, is left out until it is made
// beside the frames, a second or two; no frame is late for it. So it is with lamps that are aimed apart for the first
// time, which till then stay as they were. Not in lockstep, where a slow frame harms nobody.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "config/base/conventions.h"
#include "visual/process/loop.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/picture_kind.h"

namespace phare {

namespace {

/// Pictures of two lamps aimed alike have shaders of their own (LitBy::alike); those of more have not.
bool aimed_apart(const std::vector<PlacedLamp>& lamps, std::size_t own) {
  return own == 2 && lamps[0].world_from_image != lamps[1].world_from_image;
}

}  // namespace

Loop::LitWith Loop::lit_with(const CockpitState& light, std::size_t others, bool glare) const {
  return {light.design_index, lit_functions(light, s_.rig.high_keeps_low), others, glare};
}

/// It was drawn, or rehearsed, without shadows and with them.
void Loop::is_ready_for(const Rehearsed& as) {
  const CockpitState& light = as.light ? *as.light : light_;
  const std::size_t others = as.others.value_or(lit_with_.others);
  ready_for_.insert({shown_kind(), lit_with(light, others, as.glare.value_or(lit_with_.glare))});
}

Loop::Kind Loop::shown_kind() {
  const auto known = std::ranges::find_if(kinds_, [&](const Desk& desk) { return same_kind(desk, shown_); });
  const auto kind = static_cast<Kind>(known - kinds_.begin());
  if (known == kinds_.end()) kinds_.push_back(shown_);
  return kind;
}

/// Of so many lamps of others some may reach nothing that is seen: one after the other goes out of it; beside as many
/// of one's own as light all of a view, all or none (ViewInput::few_kinds).
std::vector<Loop::LitWith> Loop::comes_to(const LitWith& lit, std::size_t own) {
  std::vector<LitWith> all;
  for (std::size_t others = 0; others <= lit.others; ++others)
    if (others == 0 || others == lit.others || own < kLampsForAll) {
      all.push_back(lit);
      all.back().others = others;
    }
  return all;
}

/// Beside so many lamps of one's own.
bool Loop::may_show(const LitWith& lit, Rehearsed as, std::size_t own, const FrameMoment& moment) {
  if (s_.options.lockstep || !newest_ || versus_.lamps() != nullptr) return true;
  for (const LitWith& with : comes_to(lit, own)) {
    as.others = with.others;
    if (!is_drawn(with, as, moment)) return false;
  }
  return true;
}

/// Once it was rehearsed with shadows and without. Of two at once the first is made first.
bool Loop::is_drawn(const LitWith& lit, const Rehearsed& as, const FrameMoment& moment) {
  const std::pair what(shown_kind(), lit);
  if (ready_for_.contains(what)) return true;
  if (std::exchange(rehearsed_, true)) return false;
  if (!awaited_ || awaited_->what != what) awaited_ = Awaited{what, Clock::now()};
  if (s_.renderer.is_making() && awaited_->made.rehearsals > 0) return false;
  for (Rehearsed next = as;;) {
    next.shadows = awaited_->shadows;
    if (!is_rehearsed(next, shown_, awaited_->made, moment)) return false;
    if (!std::exchange(awaited_->shadows, false)) break;
  }
  if (awaited_->made.rehearsals > 0)
    spdlog::info("lamps not drawn before: {} pipelines made beside the frames, shown {:.1f} s after they shone",
                 awaited_->made.pipelines, std::chrono::duration<double>(Clock::now() - awaited_->since).count());
  awaited_.reset();
  ready_for_.insert(what);
  return true;
}

/// That of one's own lamps: as it is switched, be it without the lamps of others, or as it was. The low beam of a
/// fail-safe waits for nothing.
CockpitState Loop::light_to_show(const FrameMoment& moment) {
  const CockpitState asked = shown_by_desk(s_.desk, moment.controls);
  LitWith lit = lit_with(asked, lit_with_.others, lit_with_.glare);
  bool shows = asked.fail_safe || nearest_ready(lit, 0);
  if (!shows) {
    lit.others = 0;
    shows = may_show(lit, {.glare = lit.glare, .light = asked}, 0, moment);
  }
  if (shows) {
    lit_with_ = lit, light_ = asked;
    return asked;
  }
  CockpitState light = light_;
  light.lamp_aim_rad = asked.lamp_aim_rad;
  return light;
}

/// With as many lamps of others as there is anything for. That they do not glare yet is less than that they are not
/// there; that they still glare, more.
std::optional<Loop::LitWith> Loop::nearest_ready(const LitWith& lit, std::size_t own) {
  const Kind kind = shown_kind();
  const auto is_ready = [&](const LitWith& one) { return ready_for_.contains({kind, one}); };
  std::vector<LitWith> best;
  const auto add = [&](std::size_t others, bool glare) {
    best.push_back(lit);
    best.back().others = others, best.back().glare = glare;
  };
  for (std::size_t others = lit.others + 1; others-- > 0;) {
    if (lit.glare) add(others, true);
    add(others, false);
  }
  for (std::size_t others = lit.others + 1; !lit.glare && others-- > 0;) add(others, true);
  const auto found = std::ranges::find_if(
      best, [&](const LitWith& with) { return std::ranges::all_of(comes_to(with, own), is_ready); });
  return found != best.end() ? std::optional(*found) : std::nullopt;
}

/// The frame without the lamps of others or the glare that it lacks pipelines for; none: it lacks nothing. Where it
/// lacks them for lamps that glare no more, it glares as before, and for own ones that are aimed apart, they are aimed
/// as before. What is measured and logged is as it shines.
std::optional<FrameInput> Loop::without_new_lamps(const FrameMoment& moment) {
  const auto of_others = Traffic::is_theirs;
  LitWith lit = lit_with_;
  lit.others = static_cast<std::size_t>(std::ranges::count_if(input_.lamps, of_others));
  const std::size_t own = input_.lamps.size() - lit.others;
  lit.glare = !input_.glare.empty();
  for (const ViewInput& view : input_.more_views) lit.glare = lit.glare || !view.glare.empty();
  lit.apart = aimed_apart(input_.lamps, own);
  const VehicleState& car = moment.car.pose;
  const glm::dmat3 body = world_from_car(car.roll_rad, car.pitch_rad, car.yaw_rad);
  if (may_show(lit, {.glare = lit.glare}, own, moment)) {
    lit_with_ = lit;
    if (lit.glare) glare_before_ = input_.glare;
    car_from_image_.clear();
    for (std::size_t i = 0; i < own; ++i)
      car_from_image_.push_back(glm::transpose(body) * input_.lamps[i].world_from_image);
    return std::nullopt;
  }
  FrameInput frame = input_;
  const LitWith otherwise = nearest_ready(lit, own).value_or(lit_with_);
  const auto limit = [&](ViewInput& view) {
    std::size_t others = 0;
    std::erase_if(view.lamps, [&](const PlacedLamp& lamp) { return of_others(lamp) && ++others > otherwise.others; });
    if (!otherwise.glare) view.glare.clear();
    const bool as_before = otherwise.apart != lit.apart && own == car_from_image_.size() && view.lamps.size() >= own;
    for (std::size_t i = 0; as_before && i < own; ++i) view.lamps[i].world_from_image = body * car_from_image_[i];
  };
  limit(frame);
  for (ViewInput& view : frame.more_views) limit(view);
  if (otherwise.glare && !lit.glare) frame.glare = glare_before_;
  lit_with_ = otherwise;
  return frame;
}

}  // namespace phare
