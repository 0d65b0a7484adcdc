#include "vehicle_dynamics/step.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <utility>

#include "vehicle_dynamics/models/kinematic.h"

namespace phare {

void StepLoop::step_once() {
  const auto begin = std::chrono::steady_clock::now();
  const double dt = setup_.step.seconds();
  before_ = now_;
  switch (setup_.level) {
    case Level::kPose:
      now_ = from_message(setup_.track.at(time_of(steps_ + 1)), 1.0, 1.0);
      break;
    case Level::kKinematic:
      kinematic::advance(setup_.vehicle, controls_, now_, dt);
      place_on_road(dt);
      break;
  }
  ++steps_;
  times_.add(std::chrono::steady_clock::now() - begin);
}

void StepLoop::run_to(SimTime time) {
  while (this->time() < time) step_once();
}

int StepLoop::catch_up(SimTime elapsed) {
  const std::int64_t due_until = start_.ns + elapsed.ns - dropped_.ns - paused_.ns;
  std::int64_t due = std::max<std::int64_t>(0, (due_until - time().ns) / setup_.step.ns);
  if (due > max_catch_up()) {
    dropped_.ns += (due - max_catch_up()) * setup_.step.ns;
    ++drops_;
    due = max_catch_up();
  }
  for (std::int64_t i = 0; i < due; ++i) step_once();
  return static_cast<int>(due);
}

VehicleState StepLoop::at(SimTime time) const {
  const double ahead = static_cast<double>(this->time().ns - time.ns) / static_cast<double>(setup_.step.ns);
  VehicleState out =
      setup_.level == Level::kPose ? setup_.track.at(time) : to_message(interpolate(before_, now_, 1.0 - ahead));
  out.frame_index = -1;
  out.level = name(setup_.level);
  out.step = steps();
  out.state_hash = state_hash(now_);
  out.lag_s = dropped_.seconds();
  out.high_beam_telltale = false;
  return out;
}

void StepLoop::place_on_road(double dt) {
  const auto points = kinematic::contact_points(setup_.vehicle, now_);
  std::array<double, 4> height = now_.contact_z_m;
  std::array<bool, 4> found{};
  double moved = 0.0;
  int count = 0;
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    const auto point = setup_.road.at(points[wheel].x, points[wheel].y);
    if (!point) continue;
    moved += point->z_m - height[wheel];
    height[wheel] = point->z_m;
    found[wheel] = true;
    ++count;
  }
  // Beside the surface a wheel keeps its last height, raised or lowered with the wheels that do stand on something.
  if (count < 4) {
    off_road_ = true;
    for (std::size_t wheel = 0; wheel < 4 && count > 0; ++wheel)
      if (!found[wheel]) height[wheel] += moved / count;
  }
  kinematic::stand_on(setup_.vehicle, height, now_, dt);
}

StepLoop::StepLoop(RunSetup setup, const CarState& state, SimTime start, std::uint64_t steps_before)
    : setup_(std::move(setup)), before_(state), now_(state), start_(start), steps_before_(steps_before) {
  assert(setup_.step.ns > 0);
  if (setup_.level == Level::kPose) now_ = from_message(setup_.track.at(start), 1.0, 1.0);
  if (setup_.level == Level::kKinematic) place_on_road(0.0);
  before_ = now_;
}

void StepLoop::set_controls(const Controls& controls) {
  bool refused = false;
  controls_ = accepted(controls, controls_, &refused);
  controls_refused_ += refused ? 1 : 0;
}

void StepLoop::skip(SimTime paused) {
  paused_.ns += paused.ns;
}

int StepLoop::max_catch_up() const {
  constexpr std::int64_t kMaxSteps = 25, kMaxTime_ns = 50'000'000;
  return static_cast<int>(std::clamp<std::int64_t>(kMaxTime_ns / setup_.step.ns, 1, kMaxSteps));
}

const char* name(Level level) {
  return level == Level::kPose ? "pose" : "kinematic";
}

Result<Level> parse_level(const std::string& text, const std::string& place) {
  for (const Level level : {Level::kPose, Level::kKinematic})
    if (text == name(level)) return level;
  const bool planned = text == "single-track" || text == "full";
  return Error{
      place, "level \"" + text + "\" " + (planned ? "is not built yet" : "is unknown") + "; there are pose, kinematic"};
}

}  // namespace phare
