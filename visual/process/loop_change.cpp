#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <limits>
#include <vector>

#include "visual/air_of_desk.h"
#include "visual/process/loop.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/picture_kind.h"

namespace phare {

namespace {

/// Of pipelines that were made beside the frames, drawn with between two of these: as many as take a short while. Some
/// 5 ms each where Mesa has kept its code from a drive before, else up to 200.
constexpr std::size_t kMostAtOnce = 4;
constexpr std::chrono::milliseconds kShortWhile{20};

}  // namespace

/// What a picture of the kind that is asked for may come to, once the drive goes on.
struct Loop::Rehearsed {
  enum class Eye { kAsNow, kOverview, kAbove } eye = Eye::kAsNow;  ///< above: parallel rays
  std::size_t others = 0;                                          ///< lamps of others
  bool glare = false, shadows = true;
};

/// A picture of another kind may take pipelines that no picture before took, tenths of a second for all of them: they
/// are made beside the frames, while the picture goes on as it was, then it follows. Where nothing is missing it
/// follows at once, and in lockstep, where a slow frame harms nobody.
void Loop::follow_desk(const Moment& moment) {
  if (!s_.options.lockstep && newest_ && !same_kind(s_.desk, shown_)) {
    if (!is_ready(moment)) {
      shown_ = with_kind_of(s_.desk, shown_);
      return;
    }
  } else if (change_ && change_->rehearsals > 0) {
    half_made_ = true;
  }
  change_.reset();
  shown_ = s_.desk;
}

/// For the picture that the desk asks for.
bool Loop::is_ready(const Moment& moment) {
  const Clock::time_point begin = Clock::now();
  if (!change_ || !same_kind(change_->to, s_.desk)) {
    half_made_ = half_made_ || (change_ && change_->rehearsals > 0);
    change_ = Change{.to = s_.desk, .asked = begin};
  }
  Change& change = *change_;
  if (s_.renderer.is_making() && change.rehearsals > 0) return false;
  const std::vector<Rehearsed> all = rehearsals();
  while (change.done < all.size()) {
    const Rehearsal rehearsal = rehearse(all[change.done], moment);
    const auto took = Clock::now() - begin;
    if (!rehearsal.ready()) {
      ++change.rehearsals;
      change.pipelines += rehearsal.made;
      change.at_once = took < kShortWhile ? std::min(2 * change.at_once, kMostAtOnce) : 1;
      s_.stats.pipelines_rehearsed += rehearsal.made;
      s_.stats.longest_rehearsal_ms =
          std::max(s_.stats.longest_rehearsal_ms, std::chrono::duration<double, std::milli>(took).count());
      return false;
    }
    // All of a kind is made at once: where one picture of it is there, and nothing was left half made, all are.
    if (change.rehearsals == 0 && !half_made_) return true;
    if (++change.done < all.size() && took > kShortWhile) return false;
  }
  if (change.rehearsals == 0) return true;
  ++s_.stats.kinds_followed;
  spdlog::info(
      "a kind of picture not drawn before: {} pipelines made beside the frames, shown {:.1f} s after it was asked for",
      change.pipelines, std::chrono::duration<double>(Clock::now() - change.asked).count());
  return true;
}

/// As it would be drawn now; then over the whole scene with all that a drive comes to: lamps of others, their glare,
/// and something that stands in the beams or nothing; and from above.
std::vector<Loop::Rehearsed> Loop::rehearsals() const {
  std::vector<Rehearsed> all{{}};
  const std::size_t others = s_.traffic.empty() ? 0 : Traffic::kMostLamps;
  const bool glares = s_.desk.glare != std::size_t{0} && (!s_.traffic.empty() || s_.fixed_light->street_lamps() > 0);
  for (std::size_t lamps = 0; lamps <= others; ++lamps)
    for (const bool glare : {false, true})
      for (const bool shadows : {true, false})
        if (glares || !glare) all.push_back({Rehearsed::Eye::kOverview, lamps, glare, shadows});
  all.push_back({.eye = Rehearsed::Eye::kAbove});
  return all;
}

/// Where the car was in the frame before.
Rehearsal Loop::rehearse(const Rehearsed& as, const Moment& moment) {
  FrameInput next = input_;
  next.part = {};
  next.more_views.clear();
  next.picked = picked_effects();
  set_by_desk(next, s_.desk);
  next.windscreen.reset();
  if (s_.desk.windscreen) next.windscreen = Windscreen{.wiper = s_.desk.wiper};
  next.spraying.clear();
  if (wet(s_.desk)) next.spraying = s_.traffic.spraying(users_, moment.time.seconds(), measuring_.road());
  // The own lamps, whoever had his turn.
  std::vector<PlacedLamp> of_others;
  std::ranges::copy_if(next.lamps, std::back_inserter(of_others),
                       [](const PlacedLamp& lamp) { return lamp.beam == Traffic::kBeam; });
  next.lamps = s_.lamps.placed(moment.car.pose);
  if (as.eye != Rehearsed::Eye::kAsNow) {
    const bool above = as.eye == Rehearsed::Eye::kAbove;
    next.camera = above ? birds_eye_camera(moment.car.pose) : overview_camera(s_.scene);
    next.far_mesh_from_m = std::numeric_limits<double>::infinity();
    of_others.assign(as.others, {next.camera.eye_m, next.camera.world_from_eye, Traffic::kBeam});
    next.glare.clear();
    if (as.glare) next.glare = {{next.camera.eye_m + 10.0 * next.camera.world_from_eye[0], 1.0}};
    if (!as.shadows) next.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  }
  next.lamps.insert(next.lamps.end(), of_others.begin(), of_others.end());
  // By turns each design has the whole picture; in halves both are in one.
  const Compare compare = s_.desk.compare == Compare::kFlicker ? Compare::kSplit : s_.desk.compare;
  if (versus_.lamps() != nullptr) versus_.show(next, compare, moment.car.pose, of_others, next.glare);
  const bool audited = s_.options.audit_every > 0 && as.eye == Rehearsed::Eye::kOverview && of_others.empty();
  return s_.renderer.rehearse(next, change_->at_once, audited);
}

}  // namespace phare
