#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>

#include "visual/air_of_desk.h"
#include "visual/process/loop.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/picture_kind.h"

namespace phare {

namespace {

/// Of pipelines that were made beside the frames, drawn with between two of these: as many as take a short while. Some
/// 5 ms each where Mesa has kept its code from a drive before, else up to 200.
constexpr std::size_t kMostAtOnce = 4;
constexpr double kShortWhile_ms = 20.0;

}  // namespace

/// A picture of another kind may take pipelines that no picture before took, tenths of a second for all of them: they
/// are made beside the frames, while the picture goes on as it was, then it follows. Where nothing is missing it
/// follows at once, and in lockstep, where a slow frame harms nobody.
void Loop::follow_desk(const Moment& moment) {
  if (!s_.options.lockstep && newest_ && !same_kind(s_.desk, shown_) && !is_ready(moment)) {
    shown_ = with_kind_of(s_.desk, shown_);
    return;
  }
  change_.reset();
  shown_ = s_.desk;
}

/// For the picture that the desk asks for.
bool Loop::is_ready(const Moment& moment) {
  const Clock::time_point begin = Clock::now();
  if (!change_) change_ = Change{.asked = begin};
  if (s_.renderer.is_making()) return false;
  const Rehearsal rehearsal = rehearse(moment);
  if (rehearsal.ready()) {
    if (change_->rehearsals == 0) return true;
    ++s_.stats.kinds_followed;
    spdlog::info(
        "a kind of picture not drawn before: {} pipelines made beside the frames, shown {:.1f} s after it was asked "
        "for",
        change_->pipelines, std::chrono::duration<double>(Clock::now() - change_->asked).count());
    return true;
  }
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  ++change_->rehearsals;
  change_->at_once = ms < kShortWhile_ms ? std::min(2 * change_->at_once, kMostAtOnce) : 1;
  change_->pipelines += rehearsal.made;
  s_.stats.pipelines_rehearsed += rehearsal.made;
  s_.stats.longest_rehearsal_ms = std::max(s_.stats.longest_rehearsal_ms, ms);
  return false;
}

/// Where the car was in the frame before; then, if that was not there from the beginning, over the whole scene with
/// shadows and without, for the drive comes to all of these.
Rehearsal Loop::rehearse(const Moment& moment) {
  FrameInput next = input_;
  next.part = {};
  next.more_views.clear();
  set_by_desk(next, s_.desk);
  next.windscreen.reset();
  if (s_.desk.windscreen) next.windscreen = Windscreen{.wiper = s_.desk.wiper};
  next.spraying.clear();
  if (wet(s_.desk)) next.spraying = s_.traffic.spraying(users_, moment.time.seconds(), measuring_.road());
  if (versus_.lamps() != nullptr) versus_.show(next, s_.desk.compare, moment.car.pose, {}, {});
  const bool audited = s_.options.audit_every > 0;
  Rehearsal rehearsal = s_.renderer.rehearse(next, change_->at_once, audited);
  if (!rehearsal.ready() || change_->rehearsals == 0) return rehearsal;
  const auto in_each_view = [&](auto&& change) {
    change(next);
    for (ViewInput& view : next.more_views) change(view);
  };
  in_each_view([camera = overview_camera(s_.scene)](ViewInput& view) {
    view.camera = camera;
    view.far_mesh_from_m = std::numeric_limits<double>::infinity();
  });
  for (const bool off : {false, true}) {
    if (off) in_each_view([](ViewInput& view) { view.effects[static_cast<std::size_t>(Effect::kShadows)] = 0; });
    rehearsal = s_.renderer.rehearse(next, change_->at_once, audited);
    if (!rehearsal.ready()) break;
  }
  return rehearsal;
}

}  // namespace phare
