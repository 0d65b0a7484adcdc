#include "visual/process/run_loop.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "net/silence.h"
#include "visual/air_of_desk.h"
#include "visual/process/glare_into_eye.h"
#include "visual/process/loop.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/pick.h"
#include "visual/process/picture_kind.h"

namespace phare {

namespace {

using namespace std::chrono_literals;

constexpr auto kRepeatAfter = 100ms;    // of no progress the last FrameReport is sent again
constexpr std::size_t kMostAsked = 64;  // probes of one frame; who sends more asks again
constexpr auto kFreshWithin = 1s;       // the first picture waits so long for a pose that is not held

}  // namespace

/// Who cannot be heard, or cannot hear the others, so that no drive begins. Later on a drive may be paused.
void Loop::tell_of_stall() {
  if (drawn_frames_ > 0) return;
  if (!stall_) stall_.emplace(Clock::now());
  const auto waited = stall_->told_at(Clock::now());
  if (!waited) return;
  const auto* controls = s_.bus.newest<CockpitState>();
  const auto* car = s_.bus.newest<VehicleState>();
  const std::string silent = silent_ones(controls ? &controls->value : nullptr, car ? &car->value : nullptr,
                                         drawn_index_, s_.options.lockstep);
  if (silent.empty()) return;
  spdlog::warn(
      "no picture for {} s: nothing new from {}; do bind, send_to and the key of the rig's [bus] let it be heard, and "
      "hear the others?",
      waited->count(), silent);
}

bool Loop::over() {
  if (s_.window && !s_.window->poll()) ended_ = true;
  if (s_.window) mind_the_panel(), mind_the_keys(), mind_the_mouse();
  return ended_ || s_.stop.requested();
}

/// What the picture has to do with keys, and what the cockpit and the launcher are to know of them.
void Loop::mind_the_keys() {
  WindowKeyboard& keyboard = s_.window->keyboard();
  const std::vector<KeyAction> presses = keyboard.take_presses();
  for (const KeyAction press : presses) {
    move_eye(press);
    press_for_lamps(press);
  }
  const auto set = [&](const DeskCommand& command) {
    const ControlReply reply = verbs_(RigControl{RigControl::Set{command.setting, command.value}});
    if (reply.verdict == Verdict::kRefused) refuse_key(reply.reason);
  };
  if (screens_.press(presses, keyboard.take_any(), s_.desk, set)) ended_ = true;
  if (const auto keys = keyboard.message(Clock::now())) s_.bus.send(newest_ ? newest_->time : SimTime{}, *keys);
}

/// Of several windows the first moves lamps.
void Loop::press_for_lamps(KeyAction press) {
  if (!LampKeys::has(press)) return;
  if (s_.options.channel != 0) return refuse_key("the first window of the rig moves lamps");
  // A refusal shows in the overlay: nothing has moved.
  if (const auto command = lamp_keys_.press(press, s_.lamps)) (void)verbs_(*command);
}

void Loop::refuse_key(std::string reason) {
  notice_.say(std::move(reason), Clock::now());
  fresh_ = true;
}

/// Every accepted datagram, in order.
void Loop::take(const Datagram& datagram) {
  if (const auto* state = std::get_if<VehicleState>(&datagram.payload)) {
    poses_.push(datagram.sim_time, *state);
    // By when it came, on our own clock: that of another machine may be set differently.
    clock_.observe(datagram.sim_time, s_.bus.newest<VehicleState>()->received);
  } else if (const auto* request = std::get_if<ProbeRequest>(&datagram.payload)) {
    if (asked_.size() < kMostAsked) asked_.push_back({*request, datagram.sim_time});
  } else if (const auto* state = std::get_if<LampState>(&datagram.payload)) {
    if (s_.options.channel != 0)
      if (const Status set = s_.lamps.set_mounts(state->design_index, mounts_of(*state)); !set)
        spdlog::warn("{}", set.error().text());
  } else {
    commands_.serve(s_.bus, datagram, std::cref(verbs_));
  }
}

void Loop::repeat_when_stalled() {
  if (Clock::now() - progress_ < kRepeatAfter) return;
  tell_of_stall();
  progress_ = Clock::now();
  const auto* controls = s_.bus.newest<CockpitState>();
  const auto* car = s_.bus.newest<VehicleState>();
  const bool apart = controls != nullptr && car != nullptr && controls->value.frame_index != car->value.frame_index;
  if (s_.options.lockstep && drawn_index_ < 0 && apart && car->value.frame_index >= 0) {
    // Started anew in the middle of a drive where one of the two is a frame behind: the pose we hold sets both going
    // again.
    drawn_index_ = car->value.frame_index;
    FrameReport report{drawn_index_,
                       s_.options.channel,
                       static_cast<std::uint32_t>(s_.rig.channels.size()),
                       0.0,
                       0.0,
                       0,
                       car->value,
                       true,
                       LightSwitch::kOff,
                       false,
                       false,
                       s_.album.not_kept(),
                       audit_failure()};
    s_.bus.send(car->sim_time, report);
    return;
  }
  s_.bus.send_again(kPayloadIndex<FrameReport>);
}

std::optional<FrameMoment> Loop::next_moment() {
  std::optional<FrameMoment> moment = s_.options.lockstep ? lockstep_moment() : display_moment();
  if (!moment || !s_.options.law || over_) return moment;
  const std::chrono::nanoseconds period(1'000'000'000 / s_.rig.frame_rate_hz);
  moment->controls = s_.law.lead(s_.bus, s_.lamps, moment->controls, period, s_.options.lockstep);
  return moment;
}

/// Frame k as soon as controls and pose of k are both here, and the answer of the control law where there is one.
std::optional<FrameMoment> Loop::lockstep_moment() {
  const auto* controls = s_.bus.newest<CockpitState>();
  const auto* car = s_.bus.newest<VehicleState>();
  const bool both = controls != nullptr && car != nullptr && controls->value.frame_index == car->value.frame_index;
  const bool led = both && (!s_.options.law || LawLink::has_answered(s_.bus, car->value.frame_index));
  if (led && car->value.frame_index > drawn_index_) {
    drawn_index_ = car->value.frame_index;
    return FrameMoment{
        drawn_index_, frame_time(drawn_index_, s_.rig.frame_rate_hz), controls->value, {car->value, 0.0, false}};
  }
  if (both && !led) s_.law.waits_for(car->value.frame_index);
  s_.bus.wait(s_.window ? 10ms : 20ms);
  repeat_when_stalled();
  return std::nullopt;
}

/// The pose of now, at the frame rate of the rig; of several channels the first says for all which moment that is.
std::optional<FrameMoment> Loop::display_moment() {
  if (!over_ && follows_another()) return begun_moment();
  if (!over_ && !s_.lock.may_begin(s_.bus, Clock::now())) {
    s_.bus.wait(5ms);
    return std::nullopt;
  }
  if (!pacer_.due()) {
    s_.renderer.finish_within(pacer_.left());  // a picture is shown, and its time known, as soon as it is done
    s_.bus.wait(pacer_.left());
    return std::nullopt;
  }
  if (over_) return newest_;  // the last picture stays
  const WallTime now = wall_now();
  const std::optional<SimTime> time = clock_.at(now);
  const std::optional<PoseBuffer::Drawn> car = time ? poses_.at(*time) : std::nullopt;
  // What had piled up before the picture was ready is old: the first one shows the car as it is now.
  const bool old = car && car->stale && !newest_ && Clock::now() - ready_ < kFreshWithin;
  if (!car || old) {
    repeat_when_stalled();
    return std::nullopt;
  }
  const SimTime shown = poses_.time_to_show(*time, newest_ ? std::optional(newest_->time) : std::nullopt);
  FrameMoment moment{-1, shown, controls_to_show(s_.bus, Clock::now()), *poses_.at(shown)};
  moment.car.stale = car->stale;
  if (s_.lock.leads())
    s_.lock.begin(s_.bus, shown, {0, moment.controls, moment.car.pose, moment.car.stale}, Clock::now());
  else
    s_.lock.drew_alone();
  return moment;
}

bool Loop::follows_another() {
  const Clock::time_point now = Clock::now();
  const auto beam = [](const CockpitState& controls) { return std::pair(controls.light_switch, controls.flash); };
  return s_.lock.follows(s_.bus, newest_ && beam(controls_to_show(s_.bus, now)) != beam(newest_->controls), now);
}

std::optional<FrameMoment> Loop::begun_moment() {
  if (const auto begun = s_.lock.next(s_.bus))
    return FrameMoment{-1, begun->time, begun->start.controls, {begun->start.pose, 0.0, begun->start.pose_stale}};
  s_.bus.wait(5ms);
  return std::nullopt;
}

/// Beam images follow the controls; what did not change stays as it is.
void Loop::light_up(const CockpitState& controls) {
  upload(s_.lamps.set_controls(controls));
}

void Loop::upload(const std::vector<Lamps::Change>& changes) {
  for (const Lamps::Change& change : changes) {
    if (change.part.empty())
      s_.renderer.set_beam(change.position, *change.image);
    else
      s_.renderer.change_beam(change.position, *change.image, change.part);
  }
}

/// Places of lamps: those of the drive that is shown, and what the others and the recording are to know of them.
void Loop::mind_the_lamps(SimTime now) {
  if (over_) return;
  if (const Status followed = s_.lamps_then.follow(now, s_.lamps); !followed)
    spdlog::warn("as recorded, {}; they stay as they are", followed.error().text());
  if (s_.options.channel != 0) return;
  if (const auto news = lamp_news_.of(now, s_.lamps)) s_.bus.send(now, *news);
}

std::vector<GlaringLamp> Loop::glare_in(const ViewInput& view, const VehicleState& pose, const Lamps& lamps) const {
  return glare_into_eye(view, lamps, {pose, s_.traffic, users_, *s_.fixed_light, world_});
}

/// The eyes besides the first, what shines into each, and what only some of them see. Returns the car's own tail lamps
/// as the first eye sees them.
std::vector<GlaringLamp> Loop::add_views(const FrameMoment& moment, const Lamps& shining) {
  const VehicleState& pose = moment.car.pose;
  if (s_.desk.mirrors) input_.more_views = mirror_views(input_, s_.channel(), pose);
  const bool two = s_.desk.layout != Layout::kFull;
  const CameraEye second = two ? eye_named(s_.desk, s_.desk.second_camera) : CameraEye{};
  if (two) {
    const SeenBy by = seen_by(second, s_.channel(), s_.lamps, pose, &measuring_.road());
    lay_out(input_, s_.desk.layout, camera_of(second, by), s_.desk.second_camera);
    input_.more_views.back().falling = falling_past(second, pose, moment.time);
  }
  const auto eyeshine_in = [&](const ViewInput& view) {
    return eyeshine_of(shining, pose, pupils_, world_, view.camera.eye_m, view.air);
  };
  input_.pupils = eyeshine_in(input_);
  for (ViewInput& view : input_.more_views) view.pupils = eyeshine_in(view);
  input_.glare = glare_in(input_, pose, shining);
  for (ViewInput& view : input_.more_views) view.glare = glare_in(view, pose, shining);
  const bool lit = moment.controls.light_switch != LightSwitch::kOff;
  std::vector<GlaringLamp> tail_lamps = s_.props.add_to(input_, s_.desk.camera, shining, pose, lit, world_);
  if (two) s_.props.add_to(input_.more_views.back(), second.kind, shining, pose, lit, world_);
  input_.room = room_beside(s_.desk);
  return tail_lamps;
}

CameraEye Loop::place_eye(const FrameMoment& moment) {
  const CameraEye eye = first_eye(s_.desk);
  input_.camera = camera_of(eye, seen_by(eye, s_.channel(), s_.lamps, moment.car.pose, &measuring_.road()));
  return eye;
}

void Loop::draw(const FrameMoment& moment) {
  rehearsed_ = false;
  place_eye(moment);
  light_up(light_to_show(moment));
  mind_the_lamps(moment.time);
  Desk compared = s_.desk;  // until the picture has left a comparison
  if (!s_.options.lockstep && compared.compare == Compare::kOff) compared.compare = shown_.compare;
  upload(versus_.follow(compared, s_.lamps, moment.controls));
  const CameraEye eye = place_eye(moment);  // the lamps may have been moved
  follow_desk(moment);
  set_by_desk(input_, shown_);
  input_.part = {};
  input_.falling = falling_past(eye, moment.car.pose, moment.time);
  const bool others_turn = versus_.lamps() != nullptr && Versus::has_turn(shown_, moment.time);
  input_.windscreen.reset();
  input_.lamps = others_turn ? versus_.placed(moment.car.pose) : s_.lamps.placed(moment.car.pose);
  users_ = s_.traffic.at(moment.time.seconds(), measuring_.road());
  const std::vector<PlacedLamp> their_lamps =
      Traffic::placed_lamps(users_, input_.camera.eye_m, input_.camera.world_from_eye[0], lamps_toward_first(shown_));
  input_.lamps.insert(input_.lamps.end(), their_lamps.begin(), their_lamps.end());
  input_.moving = s_.traffic.placed_meshes(users_);
  input_.spraying.clear();
  if (wet(shown_)) input_.spraying = s_.traffic.spraying(users_, moment.time.seconds(), measuring_.road());
  world_.move(input_.moving);
  input_.picked = picked_effects();
  input_.more_views.clear();
  if (std::exchange(eye_set_, s_.desk.eye) != s_.desk.eye) s_.eye = eye_set(s_.desk.eye);
  s_.eye.see(moment.time, shown_.compare == Compare::kOff ? s_.lamps.light() : versus_.light(s_.lamps));
  input_.white = s_.eye.white();
  const std::vector<GlaringLamp> tail_lamps = add_views(moment, others_turn ? *versus_.lamps() : s_.lamps);
  if (shown_.windscreen && eye.kind == CameraKind::kDriver)  // the first eye's alone
    input_.windscreen = Windscreen{moment.time.seconds(), moment.car.pose.speed_mps, shown_.wiper};
  if (s_.window) {
    screens_.see(moment.controls);
    input_.panel = screens_.panel(moment.controls, moment.time.seconds(), s_.desk.help);
    const bool one = s_.lamps.designs().size() < 2;
    input_.instruments.clear();
    if (s_.desk.instruments)
      input_.instruments =
          instruments(moment.controls, moment.car.pose, one ? std::string() : s_.lamps.design().name, moment.time);
  }
  show_panel(moment);
  measure(moment);
  if (drawn_frames_ % 6 == 0 || std::exchange(fresh_, false)) {  // ten times a second: they take rays through the scene
    mind_the_road(moment);
    if (s_.window) input_.overlay = overlay(moment);
  }
  captured_ = wants_picture(moment);
  if (captured_) keep_capture();  // before another takes its place
  input_.want_image = captured_;

  // Picked, measured and audited is the whole view.
  FrameInput halves;
  const bool both =
      versus_.lamps() != nullptr && shown_.compare != Compare::kOff && shown_.compare != Compare::kFlicker;
  if (both) {
    halves = input_;
    std::vector<GlaringLamp> glare = tail_lamps;  // into B's half; a difference has none
    if (shown_.compare == Compare::kSplit)
      for (const GlaringLamp& lamp : glare_in(input_, moment.car.pose, *versus_.lamps())) glare.push_back(lamp);
    versus_.show(halves, shown_.compare, moment.car.pose, their_lamps, std::move(glare));
    if (shown_.compare == Compare::kSplit)  // B's half comes first of the others
      halves.more_views.front().pupils = eyeshine_of(*versus_.lamps(), moment.car.pose, pupils_, world_,
                                                     input_.camera.eye_m, input_.air);
  }
  ask_audit(moment);
  const std::optional<FrameInput> without = without_new_lamps(moment);
  const FrameResult result = s_.renderer.draw(both ? halves : without ? *without : input_);
  if (over_) return;  // what is counted is the drive
  s_.stats.add(result, captured_);
  log_frame(moment);
  if (result.pipelines_made > 0)
    spdlog::info("a kind of picture not drawn before: {} pipelines made in this frame, {:.0f} ms",
                 result.pipelines_made, result.wall_ms);
  if (result.timed && result.pipelines_made == 0 && !change_) govern(moment, result.wall_ms);
  if (moment.car.stale) ++s_.stats.stale_frames;
  s_.fail_safes.add(moment.time, moment.controls);
  if (s_.switches.is_change(light_)) s_.renderer.finish();  // the driver waits for it
  const Clock::time_point now = Clock::now();
  s_.stats.frame_ended(now);
  if (frame_end_ != Clock::time_point{})
    s_.stats.interval_ms.add(std::chrono::duration<double, std::milli>(now - frame_end_).count());
  frame_end_ = now;
  progress_ = now;
  ++drawn_frames_;
  newest_ = moment;
  const bool enough = s_.options.frames > 0 && number_of(moment) + 1 >= s_.options.frames;
  if (enough || moment.controls.drive_ended || moment.car.pose.drive_ended) {
    over_ = s_.window && screens_.stays() && !enough;
    ended_ = !over_;
    if (over_) screens_.drive_over();
  }
  s_.switches.frame_finished(light_, moment.time, wall_now(), s_.options.lockstep ? s_.rig.frame_rate_hz : 0);
}

void Loop::report(const FrameMoment& moment) {
  FrameReport report{
      moment.frame_index,      s_.options.channel,        static_cast<std::uint32_t>(s_.rig.channels.size()),
      s_.stats.newest.wall_ms, s_.stats.newest.gpu_ms,    light_.light_changes,
      moment.car.pose,         moment.car.stale,          light_.light_switch,
      light_.flash,            light_.fail_safe,         s_.album.not_kept(),
      audit_failure(),         s_.lock.number()};
  s_.bus.send(moment.time, report);
  progress_ = Clock::now();  // keeping the picture may have taken longer than a stall
}

/// Frames count from 0. In lockstep by simulated time, so that a visual started anew in the middle of a drive goes on
/// with the number its predecessor had come to; in real time as they are drawn.
std::int64_t Loop::number_of(const FrameMoment& moment) const {
  return s_.options.lockstep ? moment.frame_index : drawn_frames_ - 1;
}

/// Said once when the car leaves the road's end behind, by the first channel.
void Loop::mind_the_road(const FrameMoment& moment) {
  const RoadPlace place = road_end_.of(moment.car.pose);
  screens_.set_road(place);
  if (std::exchange(road_, place) == place || place == RoadPlace::kThere || s_.options.channel != 0) return;
  spdlog::warn("{:.1f} s: {}, at x {:.0f} m, y {:.0f} m", moment.time.seconds(), road_end_line(place),
               moment.car.pose.x_m, moment.car.pose.y_m);
}

std::vector<std::string> Loop::overlay(const FrameMoment& moment) const {
  std::optional<MeasurePoint> under_mouse;
  if (const Window::Mouse mouse = s_.window->mouse();
      mouse.inside && s_.desk.lines && !on_panel(mouse.x_px, mouse.y_px)) {
    under_mouse = measuring_.seen_at((mouse.x_px + 0.5) / mouse.width_px, (mouse.y_px + 0.5) / mouse.height_px);
  }
  return overlay_lines(shown_, s_.lamps,
                       {.time = moment.time,
                        .controls = moment.controls,
                        .pose = moment.car.pose,
                        .pose_held = moment.car.stale,
                        .paused = clock_.stands() && !s_.options.lockstep && !over_,
                        .frame_ms = s_.stats.newest.wall_ms,
                        .eye = s_.eye,
                        .frame = &s_.stats.newest,
                        .under_mouse = under_mouse,
                        .road_line = &measuring_.road(),
                        .point = measuring_.lines(),
                        .world = s_.desk.shadows == 0 ? nullptr : &world_,
                        .moving = moving_lines(),
                        .road = road_,
                        .picked = picked_line(),
                        .audit = s_.audit.line(),
                        .audit_over = s_.audit.failure().has_value(),
                        .coming = !same_kind(s_.desk, shown_)});
}

/// What the keys of this window do with lamps, and why one of them did nothing.
std::vector<std::string> Loop::moving_lines() const {
  std::vector<std::string> lines = lamp_keys_.lines(s_.lamps);
  if (std::string line = notice_.line(Clock::now()); !line.empty()) lines.push_back(std::move(line));
  return lines;
}

void run_loop(Session& session) {
  Loop loop(session);
  while (!loop.over()) {
    loop.receive();
    const std::optional<FrameMoment> moment = loop.next_moment();
    loop.answer_probes();
    if (!moment) continue;
    loop.draw(*moment);
    // Reported when its picture is on the disk: a visual killed in between is given the same frame again, and no
    // picture is missing.
    loop.keep(*moment);
    loop.take_audit();
    loop.mind_the_stats(*moment);
    loop.report(*moment);
  }
  loop.finish();
}

}  // namespace phare
