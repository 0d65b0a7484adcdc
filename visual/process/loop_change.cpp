#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>
#include <vector>

#include "visual/air_of_desk.h"
#include "visual/process/loop.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/picture_kind.h"
#include "visual/process/weather_ahead.h"

namespace phare {

namespace {

/// Of pipelines that were made beside the frames, drawn with between two of these: as many as take a short while, or as
/// long as a frame. Some 5 ms each where Mesa has kept its code from a drive before, else up to 200.
constexpr std::size_t kMostAtOnce = 4;
constexpr double kShortWhile_ms = 20.0;

/// Lights that nobody may switch to are made ready in a fifth of the time.
constexpr int kRests = 4;

}  // namespace

/// A picture of another kind may take pipelines that no picture before took, tenths of a second for all of them: they
/// are made beside the frames, while the picture goes on as it was, then it follows. Where nothing is missing it
/// follows at once, and in lockstep, where a slow frame harms nobody.
void Loop::follow_desk(const FrameMoment& moment) {
  const bool live = !s_.options.lockstep && newest_;
  if (live && !same_kind(s_.desk, shown_)) {
    if (!is_ready(moment)) {
      shown_ = with_kind_of(s_.desk, shown_);
      return;
    }
  } else if (live && change_) {
    finish_change(moment);
  }
  const bool follows = live && !same_kind(s_.desk, shown_) && change_;
  shown_ = s_.desk;
  if (!follows) return;
  const std::vector<Rehearsed> all = rehearsals();
  for (std::size_t i = 0; i < change_->done; ++i)
    if (!all[i].above) is_ready_for(all[i]);
}

bool Loop::is_made(const Desk& desk) const {
  return std::ranges::any_of(made_, [&](const Desk& made) { return same_kind(made, desk); });
}

/// A change that is given up may leave a kind half made, by which the next one can not tell what is there.
void Loop::give_up_change() {
  half_made_ = half_made_ || (change_->made.rehearsals > 0 && !change_->followed);
  change_.reset();
}

/// For the picture that the desk asks for, as it would be drawn now.
bool Loop::is_ready(const FrameMoment& moment) {
  if (change_ && !same_kind(change_->to, s_.desk)) give_up_change();
  if (is_made(s_.desk)) return true;
  if (!change_) change_ = Change{.to = s_.desk, .asked = Clock::now(), .now = lit_with_};
  // What was rehearsed was so by the light that shone then.
  if (change_->now.design != lit_with_.design || change_->now.functions != lit_with_.functions)
    change_->now = lit_with_, change_->done = 0;
  if (change_->done == 0) change_->lights = other_lights(moment.controls);
  Change& change = *change_;
  if (s_.renderer.is_making() && change.made.rehearsals > 0) return false;
  while (change.done < rehearsals_now().size()) {
    if (!is_rehearsed(moment)) return false;
    // All of a kind is made at once: where one picture of it is there, and nothing was left half made, all are, but for
    // other lights.
    if (change.made.rehearsals == 0 && !half_made_) change.done = rehearsals_by_this_light().size();
  }
  change.followed = true;
  if (change.made.rehearsals == 0) return true;
  ++s_.stats.kinds_followed;
  spdlog::info(
      "a kind of picture not drawn before: {} pipelines made beside the frames, shown {:.1f} s after it was asked for",
      change.made.pipelines, std::chrono::duration<double>(Clock::now() - change.asked).count());
  return true;
}

/// The picture has followed: what the drive may come to in it, one step a frame.
void Loop::finish_change(const FrameMoment& moment) {
  if (!same_kind(change_->to, s_.desk)) {  // it was given up before it was shown
    give_up_change();
  } else if (change_->done == rehearsals().size()) {
    made_.push_back(change_->to), ++s_.stats.kinds_complete;
    change_.reset();
  } else if (!s_.renderer.is_making() && Clock::now() >= change_->rests_until) {
    (void)is_rehearsed(moment);
  }
}

/// The next of rehearsals(), which is done when it finds nothing left to make.
bool Loop::is_rehearsed(const FrameMoment& moment) {
  Change& change = *change_;
  const Rehearsed next = rehearsals()[change.done];
  if (std::exchange(rehearsed_, true)) return false;
  const Clock::time_point begin = Clock::now();
  const bool done = is_rehearsed(next, s_.desk, change.made, moment);
  if (next.light) change.rests_until = Clock::now() + kRests * (Clock::now() - begin);
  if (!done) return false;
  ++change.done;
  if (change.followed && !next.shadows && !next.above) is_ready_for(next);
  return true;
}

/// One rehearsal of it; `made` goes on from the one before.
bool Loop::is_rehearsed(const Rehearsed& as, const Desk& desk, Making& made, const FrameMoment& moment) {
  s_.renderer.finish();
  const Clock::time_point begin = Clock::now();
  const Rehearsal rehearsal = rehearse(as, desk, made.at_once, moment);
  const double took_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  made.pipelines += rehearsal.made + rehearsal.taken;
  s_.stats.pipelines_rehearsed += rehearsal.made + rehearsal.taken;
  s_.stats.longest_rehearsal_ms = std::max(s_.stats.longest_rehearsal_ms, took_ms);
  if (rehearsal.ready()) {
    made.at_once = 1;
    return true;
  }
  const bool short_while = took_ms < std::max(kShortWhile_ms, s_.stats.newest.wall_ms);
  ++made.rehearsals;
  made.at_once = short_while ? std::min(2 * made.at_once, kMostAtOnce) : 1;
  return false;
}

/// As it would be drawn now, with something that stands in the beams and with nothing, and as lamps of others go out of
/// it.
std::vector<Loop::Rehearsed> Loop::rehearsals_now() const {
  std::vector<Rehearsed> all;
  for (std::size_t lamps = 0; lamps <= change_->now.others; ++lamps)
    for (const bool shadows : {true, false})
      all.push_back({.others = lamps, .glare = change_->now.glare, .shadows = shadows});
  return all;
}

/// Then with what a drive comes to: lamps of others, and their glare; and from above.
std::vector<Loop::Rehearsed> Loop::rehearsals_by_this_light() const {
  std::vector<Rehearsed> all = rehearsals_now();
  const LitWith& now = change_->now;
  const std::size_t others = s_.traffic.empty() ? 0 : Traffic::kMostLamps;
  const bool glares = s_.desk.glare != std::size_t{0} && (!s_.traffic.empty() || s_.fixed_light->street_lamps() > 0);
  for (std::size_t lamps = 0; lamps <= others; ++lamps)
    for (const bool glare : {false, true})
      for (const bool shadows : {true, false})
        if ((glares || !glare) && !(lamps <= now.others && glare == now.glare))
          all.push_back({.others = lamps, .glare = glare, .shadows = shadows});
  all.push_back({.above = true});
  return all;
}

std::vector<Loop::Rehearsed> Loop::rehearsals() const {
  std::vector<Rehearsed> all = rehearsals_by_this_light();
  const std::size_t others = s_.traffic.empty() ? 0 : Traffic::kMostLamps;
  for (const CockpitState& light : change_->lights)
    for (const std::size_t lamps : std::set{others, std::size_t{0}})  // a vehicle has two, mostly
      for (const bool shadows : {true, false})
        all.push_back({.others = lamps,
                       .glare = lamps > 0 ? s_.desk.glare != std::size_t{0} : change_->now.glare,
                       .shadows = shadows,
                       .light = light});
  return all;
}

/// The lights that a person may switch to, and those of other designs. None where two designs are compared: both are
/// there.
std::vector<CockpitState> Loop::other_lights(const CockpitState& controls) const {
  if (versus_.lamps() != nullptr) return {};
  const CockpitState shining = shown_by_desk(s_.desk, controls);
  std::vector<CockpitState> lights = lights_ahead(shining);
  lights.erase(lights.begin());
  for (std::uint32_t design = 0; design < s_.lamps.designs().size(); ++design) {
    if (design == s_.lamps.design_index()) continue;
    lights.push_back(shining);
    lights.back().design_index = design;
  }
  return lights;
}

/// One's own lamps by another light, with beams where those of another design are when two are compared.
std::vector<PlacedLamp> Loop::placed_by(const CockpitState& light, const VehicleState& pose) {
  if (!other_light_) {
    other_light_ = std::make_unique<Lamps>(s_.lamps);
    other_light_->forget_shown();
  }
  std::vector<Lamps::Change> changes = other_light_->set_controls(light);
  for (Lamps::Change& change : changes) change.position += Versus::kFirstBeam;
  upload(changes);
  std::vector<PlacedLamp> lamps = other_light_->placed(pose);
  for (PlacedLamp& lamp : lamps) lamp.beam += Versus::kFirstBeam;
  return lamps;
}

/// Where the car and its camera are now, after a seek far from where others were in the frame before.
Rehearsal Loop::rehearse(const Rehearsed& as, const Desk& desk, std::size_t at_once, const FrameMoment& moment) {
  FrameInput next = input_;
  next.part = {};
  next.more_views.clear();
  next.picked = picked_effects();
  set_by_desk(next, desk);
  next.windscreen.reset();
  if (desk.windscreen) next.windscreen = Windscreen{.wiper = desk.wiper};
  next.spraying.clear();
  if (wet(desk)) next.spraying = s_.traffic.spraying(users_, moment.time.seconds(), measuring_.road());
  if (as.above) next.camera = birds_eye_camera(moment.car.pose);
  // The own lamps, whoever had his turn.
  std::vector<PlacedLamp> of_others;
  std::ranges::copy_if(next.lamps, std::back_inserter(of_others), Traffic::is_theirs);
  if (as.others)
    of_others.assign(*as.others, {next.camera.eye_m, next.camera.world_from_eye, s_.traffic.beams_to_meet().front()});
  next.lamps = as.light ? placed_by(*as.light, moment.car.pose) : s_.lamps.placed(moment.car.pose);
  // Many lights have as many lamps: one reading of tables serves them, but for that which comes next most likely.
  if (as.light && as.light->light_switch != moment.controls.light_switch) next.shapes = ShapesFrom::kFrame;
  next.lamps.insert(next.lamps.end(), of_others.begin(), of_others.end());
  if (!as.glare.value_or(true)) next.glare.clear();
  if (as.glare.value_or(false)) next.glare = {{next.camera.eye_m + 10.0 * next.camera.world_from_eye[0], 1.0}};
  if (!as.shadows) next.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  // By turns each design has the whole picture; in halves both are in one.
  const Compare compare = desk.compare == Compare::kFlicker ? Compare::kSplit : desk.compare;
  if (versus_.lamps() != nullptr) versus_.show(next, compare, moment.car.pose, of_others, next.glare);
  const bool audited = s_.options.audit_every > 0 && !as.above && !as.others.value_or(0);
  return s_.renderer.rehearse(next, at_once, audited);
}

}  // namespace phare
