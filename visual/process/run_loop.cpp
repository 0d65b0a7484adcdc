#include "visual/process/run_loop.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <numbers>
#include <utility>

#include "net/control_desk.h"
#include "net/silence.h"
#include "net/stats.h"
#include "visual/image/canvas.h"
#include "visual/process/drive_log.h"
#include "visual/process/lamp_keys.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/pick.h"
#include "visual/process/picture_instruments.h"
#include "visual/process/pose_buffer.h"
#include "visual/process/report.h"
#include "visual/process/screens.h"
#include "visual/process/verbs.h"
#include "visual/process/versus.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kRepeatAfter = 100ms;  // of no progress the last FrameReport is sent again
constexpr auto kStatsEvery = 1s;
constexpr std::size_t kMostAsked = 64;              // probes of one frame; who sends more asks again
constexpr std::int64_t kKeyframe_ns = 100'000'000;  // of the video
constexpr auto kFreshWithin = 1s;                   // the first picture waits so long for a pose that is not held

/// What one frame shows.
struct Moment {
  std::int64_t frame_index = -1;  ///< real time: -1
  SimTime time;
  CockpitState controls;
  PoseBuffer::Drawn car;
};

ScreensSetup screens_of(const VisualOptions& options, const Rig& rig) {
  using Kind = ScreensSetup::Kind;
  const bool live = options.guide == "live";
  const std::string drive = options.drive_file.filename().string();
  return {.kind = options.guide.empty() ? Kind::kNone
                  : live                ? Kind::kLive
                                        : Kind::kReplay,
          .shown = live || drive.empty() ? rig.name : drive,
          .demo = options.demo,
          .report = options.report};
}

class Loop {
 public:
  explicit Loop(Session& session)
      : s_(session),
        pacer_(std::chrono::nanoseconds(1'000'000'000 / session.rig.frame_rate_hz)),
        screens_(screens_of(session.options, session.rig)) {
    verbs_.on<RigControl::Quit>([this](const auto&) {
      s_.stop.request();
      return accepted("leaves");
    });
    // A point that is set is read at once: the headless twin of a click.
    const Verbs plain = verbs_;
    verbs_.on<RigControl::Set>([this, plain](const RigControl::Set& set) {
      ControlReply reply = plain(RigControl{set});
      if (set.setting == "point" && reply.verdict == Verdict::kAccepted)
        reply.now += newest_ ? measuring_.answer() : "\nno frame has been drawn yet";
      return reply;
    });
    s_.bus.on_datagram = [this](const Datagram& datagram, std::span<const std::byte>) { take(datagram); };
    if (!session.options.lockstep) drawn_frames_ = session.album.frames_found();
    if (!session.options.lockstep && session.album.wanted()) session.album.write_beside();
    warm_up();
    announce();
    ready_ = Clock::now();
  }

  bool over();
  void receive() { s_.bus.poll(); }
  void answer_probes();
  std::optional<Moment> next_moment();
  void draw(const Moment& moment);
  void report(const Moment& moment);
  void keep(const Moment& moment);
  void audit(const Moment& moment);
  void finish();

 private:
  void take(const Datagram& datagram);
  void mind_the_keys();
  void mind_the_mouse();
  void measure(const Moment& moment);
  void light_up(const CockpitState& controls);
  void upload(const std::vector<Lamps::Change>& changes);
  EffectChoices picked_effects() const;
  void govern(const Moment& moment, double frame_ms);
  std::vector<double> lux_by_lamp(const MeasurePoint& at);
  void mind_the_lamps(SimTime now);
  void warm_up();
  void announce();
  void repeat_when_stalled();
  std::optional<Moment> lockstep_moment();
  std::optional<Moment> display_moment();
  std::int64_t number_of(const Moment& moment) const;
  bool wants_picture(const Moment& moment);
  bool wants_stills(const Moment& moment) const;
  std::string label(const Moment& moment) const;
  /// What was picked for the budget or the tolerance, as it holds now.
  std::string picked_line() const {
    if (s_.options.levels.empty()) return {};
    if (!s_.governor.on()) return "picked: " + s_.options.levels[level_].text() + ", " + s_.options.picked;
    const Governor& governor = s_.governor;
    std::string line =
        "budget " + fmt::format("{:.4g}", governor.budget_ms()) + " ms: " + governor.levels()[governor.now()].text();
    if (!governor.steps().empty()) line += ", step " + std::to_string(governor.steps().size()) + " of the governor";
    return line;
  }
  /// What a lockstep drive fails by.
  std::string audit_failure() const {
    return s_.options.lockstep && s_.audit.failure() ? s_.audit.failure()->text() : "";
  }
  void mind_the_road(const Moment& moment);
  std::vector<std::string> overlay(const Moment& moment) const;
  void log_frame(const Moment& moment, const FrameResult& result);
  void keep_other_designs();
  void write_stats(SimTime now);

  Session& s_;
  Verbs verbs_ = visual_verbs(s_.lamps, s_.rig, s_.desk, s_.options.channel);
  LampKeys lamp_keys_;
  LampNews lamp_news_{s_.lamps};
  PictureInstruments measuring_{s_.desk, s_.lamps, s_.scene, RoadLine(s_.lane, s_.rig.scene_file),
                                ProbeLog(s_.options.channel == 0 ? s_.options.out : "", s_.options.going_on)};
  DriveLog drive_log_{s_.options.channel == 0 ? s_.options.out : "", s_.options.going_on,
                      s_.desk.compare != Compare::kOff};
  Versus versus_;
  /// The moment of the stills, to draw the other designs in.
  struct Still {
    FrameInput driver;
    Moment moment;
  };
  std::optional<Still> still_;
  ControlDesk commands_;
  EyeSetting eye_set_ = s_.desk.eye;
  struct Asked {
    ProbeRequest request;
    SimTime time;
  };
  std::deque<Asked> asked_;  // probes that wait for the next frame
  Pacer pacer_;
  PoseBuffer poses_;
  DisplayClock clock_;
  std::int64_t drawn_index_ = -1;  // lockstep
  std::int64_t drawn_frames_ = 0;
  std::int64_t next_picture_ns_ = 0;
  Clock::time_point progress_ = Clock::now(), stats_written_ = Clock::now(), frame_end_{};
  Screens screens_;
  RoadEnd road_end_{s_.scene, s_.lane};
  RoadPlace road_ = RoadPlace::kThere;
  Clock::time_point ready_;
  bool ended_ = false;
  bool over_ = false;      // the drive is, and the window stays
  bool fresh_ = false;     // the lines of the overlay are wanted with the next frame
  bool captured_ = false;  // the picture of this frame is read back
  FrameInput input_;
  std::size_t level_ = s_.options.begin_level;  // of options.levels, where the governor does not lead
  std::optional<Moment> newest_;
};

bool Loop::over() {
  if (s_.window && !s_.window->poll()) ended_ = true;
  if (s_.window) mind_the_keys(), mind_the_mouse();
  return ended_ || s_.stop.requested();
}

/// What the picture has to do with keys, and what the cockpit and the launcher are to know of them.
void Loop::mind_the_keys() {
  WindowKeyboard& keyboard = s_.window->keyboard();
  const std::vector<KeyAction> presses = keyboard.take_presses();
  for (const KeyAction press : presses) {
    // A refusal shows in the overlay: nothing has moved.
    if (const auto command = lamp_keys_.press(press, s_.lamps)) (void)verbs_(*command);
  }
  if (screens_.press(presses, keyboard.take_any(), s_.desk)) ended_ = true;
  if (const auto keys = keyboard.message(Clock::now())) s_.bus.send(newest_ ? newest_->time : SimTime{}, *keys);
}

/// A click chooses the place of the scene under it, which stays where it is in the world; one on the sky lets it go.
/// The mouse moves the free eye.
void Loop::mind_the_mouse() {
  const bool clicked = s_.window->take_click();
  if (const auto move = s_.window->take_moves(); s_.desk.camera == CameraKind::kFree) {
    // Right button held: turn, a degree for 8 pixels; middle: shift; wheel: along the way one looks. A turn is felt,
    // not measured: chosen by hand.
    FreeEye& eye = s_.desk.free_eye;
    eye.yaw_deg = std::remainder(eye.yaw_deg + move.turn_x_px / 8.0, 360.0);
    eye.pitch_deg = std::clamp(eye.pitch_deg + move.turn_y_px / 8.0, -89.0, 89.0);
    const double yaw = eye.yaw_deg * std::numbers::pi / 180.0, pitch = eye.pitch_deg * std::numbers::pi / 180.0;
    const glm::dvec3 ahead{std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
    const glm::dvec3 left{-std::sin(yaw), std::cos(yaw), 0.0};
    eye.position_m +=
        move.wheel * ahead + 0.02 * (move.shift_x_px * left + move.shift_y_px * glm::dvec3(0.0, 0.0, 1.0));
  }
  const Window::Mouse mouse = s_.window->mouse();
  if (!clicked || !newest_ || !mouse.inside) return;
  const auto at = pick(s_.scene, ViewGeometry(input_.camera, static_cast<double>(mouse.width_px) / mouse.height_px)
                                     .ray_through(mouse.x_px, mouse.y_px, mouse.width_px, mouse.height_px));
  s_.desk.point = at ? std::optional(Probe{Probe::Frame::kWorld, at->position_m, at->normal}) : std::nullopt;
  fresh_ = true;
}

/// What measures in the picture, over it and in probes.csv.
void Loop::measure(const Moment& moment) {
  const PictureSize size = s_.renderer.picture_size();
  measuring_.see({moment.time, moment.car.pose, input_.camera, static_cast<double>(size.width_px) / size.height_px});
  input_.marks = measuring_.marks(drawn_frames_ % 6 == 0);
  if (versus_.lamps() != nullptr) mark_versus(input_.marks, s_.desk, s_.lamps, *versus_.lamps(), moment.time);
  for (const ViewInput& inset : input_.more_views) {
    keep_clear(input_.marks, inset.part);
    frame_part(input_.marks, inset.part);
  }
  if (!over_ && !measuring_.log()) spdlog::error("probes.csv: cannot be written");
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

/// Lux at points of the world under the lamps of the newest frame, through the shader that draws it, and behind what
/// stands between.
void Loop::answer_probes() {
  for (; !asked_.empty(); asked_.pop_front()) {
    const ProbeRequest& request = asked_.front().request;
    ProbeReply reply{request.request_id, {}, {}};
    std::vector<MeasurePoint> points;
    for (std::size_t i = 0; i < request.x_m.size(); ++i) {
      points.push_back(
          {{request.x_m[i], request.y_m[i], request.z_m[i]}, {request.nx[i], request.ny[i], request.nz[i]}});
    }
    if (newest_) {
      reply.illuminance_lx.assign(points.size(), 0.0);
      const std::vector<std::vector<float>> lx = s_.renderer.measure(input_.lamps, points);
      const bool shadows = s_.desk.shadows != 0;
      for (std::size_t lamp = 0; lamp < lx.size(); ++lamp)
        for (std::size_t i = 0; i < points.size(); ++i)
          if (lx[lamp][i] > 0.0f &&
              !(shadows && occluder(s_.scene, input_.lamps[lamp].position_m, points[i].position_m)))
            reply.illuminance_lx[i] += static_cast<double>(lx[lamp][i]);
    } else {
      reply.error = "no frame has been drawn yet";
    }
    s_.bus.send(asked_.front().time, reply);
  }
}

/// The first picture of each kind makes the device's machine code, which may take a second: before the drive, not in
/// it. Kinds differ by how many lamps shine and how their beams are looked up, so every design is switched through its
/// lights over the whole scene; in lockstep, where a slow frame harms nobody, and in place of one that was killed,
/// which is missed, the first picture must do. Between the pictures the window is minded: a person may leave.
void Loop::warm_up() {
  const Clock::time_point begin = Clock::now();
  const VehicleState pose;
  FrameInput input;
  set_by_desk(input, s_.desk, s_.channel(), pose, nullptr);
  const Camera first_camera = std::exchange(input.camera, overview_camera(s_.scene));
  const bool thorough = !s_.options.lockstep && !s_.options.going_on;
  const int steps = thorough ? 5 * static_cast<int>(s_.lamps.designs().size()) + 2 : 1;
  int step = 0;
  bool last = false;
  const auto draw = [&](const CockpitState& controls) {
    if (over()) return;  // who does not want to wait leaves
    if (s_.window) input.panel = getting_ready_panel(++step, steps);
    light_up(controls);
    if (last) upload(versus_.follow(s_.desk, s_.lamps, controls));
    input.lamps = s_.lamps.placed(pose);
    // Without shadows and with them: the drive goes from one to the other as things come into the beams.
    std::optional<std::size_t>& shadows = input.effects[static_cast<std::size_t>(Effect::kShadows)];
    // The same for fog, where there is some to begin with, and of the light that the drive begins with.
    for (const bool clear : {true, false}) {
      if (!clear && !s_.desk.visibility_m && !(thorough && last)) continue;
      input.effects[static_cast<std::size_t>(Effect::kFog)] = s_.desk.fog;
      input.visibility_m = clear ? std::nullopt : std::optional(s_.desk.visibility_m.value_or(100.0));
      for (const bool off : {true, false}) {
        shadows = off ? std::optional<std::size_t>(0) : s_.desk.shadows;
        if (last && s_.desk.mirrors) input.more_views = mirror_views(input, s_.channel(), pose);
        s_.renderer.draw(input);
        if (!last || versus_.lamps() == nullptr) continue;
        FrameInput halves = input;  // the other design's beams may be looked up in another way
        versus_.split(halves, pose);
        s_.renderer.draw(halves);
      }
      // Where the governor may step to: not in the drive either.
      if (!last || !thorough || clear == s_.desk.visibility_m.has_value()) continue;
      for (const GovernorLevel& level : s_.governor.levels()) {
        FrameInput of_level = input;
        of_level.method = level.method;
        of_level.effects[static_cast<std::size_t>(Effect::kShadows)] = level.shadows;
        if (level.fog) of_level.effects[static_cast<std::size_t>(Effect::kFog)] = level.fog;
        s_.renderer.draw(of_level);
      }
    }
  };
  for (std::uint32_t design = 0; thorough && design < s_.lamps.designs().size(); ++design) {
    for (const LightSwitch light : {LightSwitch::kOff, LightSwitch::kLow, LightSwitch::kHigh}) {
      for (const bool fog : {false, true}) {
        CockpitState controls;
        controls.design_index = design;
        controls.light_switch = light;
        controls.fog_front = fog;
        if (!(fog && light == LightSwitch::kOff)) draw(controls);
      }
    }
  }
  // As the drive begins, over the whole scene where there is time, then as it is seen.
  last = true;
  if (thorough) draw(controls_to_show(s_.bus, Clock::now()));  // low beam
  input.camera = first_camera;
  input.want_image = s_.album.wanted();
  draw(controls_to_show(s_.bus, Clock::now()));
  s_.lamps.begin_counting();
  if (!ended_) spdlog::info("ready after {:.1f} s", std::chrono::duration<double>(Clock::now() - begin).count());
}

/// "Up, and waiting for the first pose."
void Loop::announce() {
  FrameReport report;
  report.channel = s_.options.channel;
  report.channels = static_cast<std::uint32_t>(s_.rig.channels.size());
  s_.bus.send(SimTime{}, report);
}

void Loop::repeat_when_stalled() {
  if (Clock::now() - progress_ < kRepeatAfter) return;
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

std::optional<Moment> Loop::next_moment() {
  std::optional<Moment> moment = s_.options.lockstep ? lockstep_moment() : display_moment();
  if (!moment || !s_.options.law || over_) return moment;
  const std::chrono::nanoseconds period(1'000'000'000 / s_.rig.frame_rate_hz);
  moment->controls = s_.law.lead(s_.bus, s_.lamps, moment->controls, period, s_.options.lockstep);
  return moment;
}

/// Frame k as soon as controls and pose of k are both here, and the answer of the control law where there is one.
std::optional<Moment> Loop::lockstep_moment() {
  const auto* controls = s_.bus.newest<CockpitState>();
  const auto* car = s_.bus.newest<VehicleState>();
  const bool both = controls != nullptr && car != nullptr && controls->value.frame_index == car->value.frame_index;
  const bool led = both && (!s_.options.law || LawLink::has_answered(s_.bus, car->value.frame_index));
  if (led && car->value.frame_index > drawn_index_) {
    drawn_index_ = car->value.frame_index;
    return Moment{
        drawn_index_, frame_time(drawn_index_, s_.rig.frame_rate_hz), controls->value, {car->value, 0.0, false}};
  }
  if (both && !led) s_.law.waits_for(car->value.frame_index);
  s_.bus.wait(s_.window ? 10ms : 20ms);
  repeat_when_stalled();
  return std::nullopt;
}

/// The pose of now, at the frame rate of the rig.
std::optional<Moment> Loop::display_moment() {
  if (!pacer_.due()) {
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
  Moment moment{-1, shown, controls_to_show(s_.bus, Clock::now()), *poses_.at(shown)};
  moment.car.stale = car->stale;
  return moment;
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

void Loop::draw(const Moment& moment) {
  light_up(shown_by_desk(s_.desk, moment.controls));
  mind_the_lamps(moment.time);
  upload(versus_.follow(s_.desk, s_.lamps, moment.controls));
  set_by_desk(input_, s_.desk, s_.channel(), moment.car.pose, &measuring_.road());
  const bool others_turn = versus_.lamps() != nullptr && Versus::has_turn(s_.desk, moment.time);
  input_.lamps = others_turn ? versus_.placed(moment.car.pose) : s_.lamps.placed(moment.car.pose);
  input_.picked = picked_effects();
  input_.more_views.clear();
  if (std::exchange(eye_set_, s_.desk.eye) != s_.desk.eye) s_.eye = eye_set(s_.desk.eye);
  s_.eye.see(moment.time, s_.lamps.light());
  input_.white = s_.eye.white();
  if (s_.desk.mirrors) input_.more_views = mirror_views(input_, s_.channel(), moment.car.pose);
  input_.room = s_.desk.mirrors ? kRoomBesideMirrors : OverlayRoom{};
  if (s_.window) {
    input_.panel = screens_.panel(moment.controls, moment.time.seconds(), s_.desk.help);
    const bool one = s_.lamps.designs().size() < 2;
    input_.instruments.clear();
    if (s_.desk.instruments)
      input_.instruments =
          instruments(moment.controls, moment.car.pose, one ? std::string() : s_.lamps.design().name, moment.time);
  }
  measure(moment);
  if (drawn_frames_ % 6 == 0 || std::exchange(fresh_, false)) {  // ten times a second: they take rays through the scene
    mind_the_road(moment);
    if (s_.window) input_.overlay = overlay(moment);
  }
  captured_ = wants_picture(moment);
  input_.want_image = captured_;

  // Picked, measured and audited is the whole view.
  FrameInput halves;
  const bool split = versus_.lamps() != nullptr && s_.desk.compare == Compare::kSplit;
  if (split) halves = input_, versus_.split(halves, moment.car.pose);
  const FrameResult result = s_.renderer.draw(split ? halves : input_);
  if (over_) return;  // what is counted is the drive
  s_.stats.add(result, captured_);
  log_frame(moment, result);
  if (result.pipelines_made > 0)
    spdlog::info("a kind of picture not drawn before: {} pipelines made in this frame, {:.0f} ms",
                 result.pipelines_made, result.wall_ms);
  if (!captured_ && result.pipelines_made == 0) govern(moment, result.wall_ms);
  if (moment.car.stale) ++s_.stats.stale_frames;
  s_.fail_safes.add(moment.time, moment.controls);
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
  s_.switches.frame_finished(moment.controls, moment.time, wall_now(), s_.options.lockstep ? s_.rig.frame_rate_hz : 0);
}

/// Levels of the effects that were picked, as the governor has them now.
EffectChoices Loop::picked_effects() const {
  EffectChoices picked{};
  if (s_.options.levels.empty()) return picked;
  const GovernorLevel& level = s_.options.levels[s_.governor.on() ? s_.governor.now() : level_];
  picked[static_cast<std::size_t>(Effect::kShadows)] = level.shadows;
  picked[static_cast<std::size_t>(Effect::kFog)] = level.fog;
  return picked;
}

/// A step along the levels where the budget is missed, or is met with room. Who sets the method by hand leads himself.
void Loop::govern(const Moment& moment, double frame_ms) {
  Governor& governor = s_.governor;
  if (!governor.on()) return;
  if (s_.desk.method != governor.levels()[governor.now()].method) {
    level_ = governor.now();
    s_.governor_left = governor.json();
    governor = {};
    spdlog::info("{:.2f} s: the method is set by hand: the governor leaves", moment.time.seconds());
    return;
  }
  const auto step = governor.add(moment.time.seconds(), frame_ms);
  if (!step) return;
  s_.desk.method = governor.levels()[step->to].method;
  spdlog::info("governor: {}", governor.text(*step));
}

void Loop::report(const Moment& moment) {
  FrameReport report{
      moment.frame_index,      s_.options.channel,        static_cast<std::uint32_t>(s_.rig.channels.size()),
      s_.stats.newest.wall_ms, s_.stats.newest.gpu_ms,    moment.controls.light_changes,
      moment.car.pose,         moment.car.stale,          moment.controls.light_switch,
      moment.controls.flash,   moment.controls.fail_safe, s_.album.not_kept(),
      audit_failure()};
  s_.bus.send(moment.time, report);
  progress_ = Clock::now();  // keeping the picture may have taken longer than a stall
}

void Loop::keep(const Moment& moment) {
  if (!s_.eye.fixed()) s_.album.keep_eye(s_.eye.json());
  if (captured_) {
    Image8 image = s_.renderer.read_image();
    if (moment.car.stale) draw_text(image, 12, 12, "pose held: no VehicleState", {255, 90, 60}, 2);
    if (moment.controls.fail_safe) draw_text(image, 12, 60, "FAIL-SAFE low beam", {255, 90, 60}, 2);
    if (!moment.controls.source_fault.empty()) draw_text(image, 12, 36, moment.controls.source_fault, {255, 90, 60}, 2);
    s_.album.keep_frame(number_of(moment), image, label(moment));
  }
  if (wants_stills(moment)) {
    FrameInput driver = input_;
    driver.camera = driver_camera(s_.channel(), moment.car.pose);
    driver.lamps = s_.lamps.placed(moment.car.pose);
    driver.view = View::kPhoto;
    driver.marks = {};
    driver.more_views.clear();
    still_ = Still{driver, moment};
    s_.stills_design = s_.lamps.design_index();
    s_.album.keep_stills(s_.renderer, driver, moment.car.pose, s_.lamps, s_.options.width_px, s_.options.height_px,
                         label(moment));
    if (versus_.lamps() != nullptr) s_.album.keep_versus(s_.renderer, driver, versus_, moment.car.pose, label(moment));
    progress_ = Clock::now();
    frame_end_ = {};  // not a frame interval
  }
}

void Loop::audit(const Moment& moment) {
  constexpr std::size_t kPixels = 32;
  const std::int64_t number = number_of(moment);
  const bool others_turn = versus_.lamps() != nullptr && Versus::has_turn(s_.desk, moment.time);
  if (!over_ && !others_turn && s_.options.audit_every > 0 && number % s_.options.audit_every == 0 &&
      !input_.lamps.empty()) {
    const auto samples = s_.renderer.audit(input_, kPixels, static_cast<std::uint64_t>(number) + 1);
    const AuditMoment where{
        .frame = number,
        .time_s = moment.time.seconds(),
        .width_px = s_.renderer.picture_size().width_px,
        .height_px = s_.renderer.picture_size().height_px,
        .bound = audit_bound(s_.options.beam_image.value_or(s_.rig.beam_image), input_.method, s_.options.audit_bound),
        .by_lamp = [this](const MeasurePoint& at) { return lux_by_lamp(at); }};
    const auto failure = s_.audit.add(s_.lamps, moment.car.pose, samples, where);
    // A lockstep drive fails by it: its launcher says so, once; without one we do, when we leave.
    if (failure && !s_.options.lockstep) spdlog::warn("self-audit: {}", failure->text());
  }
  if (Clock::now() - stats_written_ > kStatsEvery) write_stats(moment.time);
}

/// Of every lamp of the design, as the picture's shader has it.
std::vector<double> Loop::lux_by_lamp(const MeasurePoint& at) {
  std::vector<double> lux(s_.lamps.design().lamps.size(), 0.0);
  const auto measured = s_.renderer.measure(input_.lamps, std::span(&at, 1));
  for (std::size_t i = 0; i < measured.size(); ++i)
    lux[input_.lamps[i].beam] = static_cast<double>(measured[i].front());
  return lux;
}

void Loop::finish() {
  s_.bus.on_datagram = nullptr;
  keep_other_designs();
  s_.album.finish();
  if (newest_ && s_.album.not_kept() > 0) report(*newest_);  // the stills too: the statistics may find no room either
  write_stats(newest_ ? newest_->time : SimTime{});
}

/// Frames count from 0. In lockstep by simulated time, so that a visual started anew in the middle of a drive goes on
/// with the number its predecessor had come to; in real time as they are drawn.
std::int64_t Loop::number_of(const Moment& moment) const {
  return s_.options.lockstep ? moment.frame_index : drawn_frames_ - 1;
}

/// A row of drive.csv, and how long each design has shone.
void Loop::log_frame(const Moment& moment, const FrameResult& result) {
  DesignsLit& designs = s_.designs_lit;
  designs.see(s_.lamps.lit_text().empty() ? std::nullopt : std::optional(s_.lamps.design_index()), moment.time);
  if (versus_.lamps() != nullptr) designs.see_beside(s_.lamps.design_index(), versus_.lamps()->design_index());
  if (!drive_log_.wanted()) return;
  DriveRow row{.frame = s_.options.lockstep ? moment.frame_index : drawn_frames_,
               .time = moment.time,
               .car = moment.car.pose,
               .lit = s_.lamps.lit_text(),
               .design = s_.lamps.design().name,
               .fail_safe = moment.controls.fail_safe,
               .pose_held = moment.car.stale,
               .picture = captured_,
               .cutoff_m = s_.lamps.cutoff_height_m(moment.car.pose, kCutoffWall_m),
               .frame_ms = result.wall_ms,
               .gpu_ms = result.gpu_ms};
  if (row.cutoff_m) {  // above the road at the wall: a slope moves the mark with the road, a crest or a dip does not
    constexpr double kLamps_m = 3.3;  // ahead of the rear axle, in cars like ours
    const VehicleState& car = moment.car.pose;
    const double ahead_m = kLamps_m + kCutoffWall_m;
    const double ground_z_m =
        measuring_.road()
            .ground(car.x_m + ahead_m * std::cos(car.yaw_rad), car.y_m + ahead_m * std::sin(car.yaw_rad), car.z_m)
            .position_m.z;
    *row.cutoff_m -= ground_z_m - car.z_m;
  }
  if (drive_log_.reach_is_due(moment.time) && versus_.lamps() != nullptr)
    row.versus_reach = reach_of(*versus_.lamps(), moment.car.pose, measuring_.road());
  if (drive_log_.reach_is_due(moment.time)) row.reach = reach_of(s_.lamps, moment.car.pose, measuring_.road());
  if (!drive_log_.write(row)) spdlog::error("drive.csv: cannot be written");
}

/// Every design that has shone is on the page, in the moment of the stills and with low beam. By lamps of their own, so
/// that the counts are those of the drive.
void Loop::keep_other_designs() {
  if (!s_.album.wanted() || s_.stop.requested()) return;
  if (!still_ && newest_) still_ = Still{input_, *newest_};  // those there are were made by the process before
  if (!still_) return;
  still_->driver.more_views.clear(), still_->driver.marks = {}, still_->driver.overlay.clear();
  still_->driver.instruments.clear(), still_->driver.panel = {}, still_->driver.view = View::kPhoto;
  for (const auto& [design, seconds] : s_.designs_lit.seconds) {
    if (s_.stills_design == design) continue;
    Lamps lamps = s_.lamps;
    CockpitState controls = still_->moment.controls;
    controls.design_index = static_cast<std::uint32_t>(design);
    controls.light_switch = LightSwitch::kLow;
    controls.flash = false;
    (void)lamps.set_controls(controls);
    FrameInput driver = still_->driver;
    driver.lamps = lamps.placed(still_->moment.car.pose);
    for (const PlacedLamp& lamp : driver.lamps) s_.renderer.set_beam(lamp.beam, lamps.image(lamp.beam));
    char label[160];
    std::snprintf(label, sizeof label, "%.1f s  low  %s", still_->moment.time.seconds(), lamps.design().name.c_str());
    s_.album.keep_design(s_.renderer, driver, still_->moment.car.pose, lamps, design, label);
  }
}

/// With --frames and --video every one; else one each tenth of a second of simulated time for the video, of other
/// channels one a second. In real time fewer, when they cannot be written as fast.
bool Loop::wants_picture(const Moment& moment) {
  if (!s_.album.wanted() || over_) return false;
  if (s_.options.frames > 0) return (s_.options.lockstep ? moment.frame_index : drawn_frames_) < s_.options.frames;
  if (s_.album.busy()) return false;
  if (s_.options.video) return true;
  const std::int64_t every_ns = s_.options.channel == 0 ? kKeyframe_ns : 1'000'000'000;
  if (moment.time.ns < next_picture_ns_) return false;
  next_picture_ns_ = (moment.time.ns / every_ns + 1) * every_ns;
  return true;
}

/// Low beam at speed past the wanted time tells most; at the end whatever there is.
bool Loop::wants_stills(const Moment& moment) const {
  constexpr double kTellingSpeed_mps = 8.0;
  if (!s_.album.wanted() || s_.album.has_stills()) return false;
  if (ended_ || over_) return true;
  if (moment.time.seconds() < s_.options.still_at_s) return false;
  return moment.controls.light_switch == LightSwitch::kLow && !moment.controls.flash &&
         moment.car.pose.speed_mps > kTellingSpeed_mps;
}

std::string Loop::label(const Moment& moment) const {
  char text[120];
  std::snprintf(text, sizeof text, "%.1f s  %.0f km/h  %s%s%s", moment.time.seconds(), moment.car.pose.speed_mps * 3.6,
                s_.lamps.lit_text().c_str(), s_.lamps.designs().size() > 1 ? "  " : "",
                s_.lamps.designs().size() > 1 ? s_.lamps.design().name.c_str() : "");
  return text;
}

/// Said once when the car leaves the road's end behind, by the first channel.
void Loop::mind_the_road(const Moment& moment) {
  const RoadPlace place = road_end_.of(moment.car.pose);
  screens_.set_road(place);
  if (std::exchange(road_, place) == place || place == RoadPlace::kThere || s_.options.channel != 0) return;
  spdlog::warn("{:.1f} s: {}, at x {:.0f} m, y {:.0f} m", moment.time.seconds(), road_end_line(place),
               moment.car.pose.x_m, moment.car.pose.y_m);
}

std::vector<std::string> Loop::overlay(const Moment& moment) const {
  std::optional<MeasurePoint> under_mouse;
  if (const Window::Mouse mouse = s_.window->mouse(); mouse.inside && s_.desk.lines) {
    under_mouse = pick(s_.scene, ViewGeometry(input_.camera, static_cast<double>(mouse.width_px) / mouse.height_px)
                                     .ray_through(mouse.x_px, mouse.y_px, mouse.width_px, mouse.height_px));
  }
  return overlay_lines(s_.desk, s_.lamps,
                       {.time = moment.time,
                        .controls = moment.controls,
                        .pose = moment.car.pose,
                        .pose_held = moment.car.stale,
                        .frame_ms = s_.stats.newest.wall_ms,
                        .eye = s_.eye,
                        .effects = &s_.stats.newest.effects,
                        .under_mouse = under_mouse,
                        .road_line = &measuring_.road(),
                        .point = measuring_.lines(),
                        .scene = s_.desk.shadows == 0 ? nullptr : &s_.scene,
                        .moving = lamp_keys_.lines(s_.lamps),
                        .road = road_,
                        .picked = picked_line(),
                        .audit = s_.audit.line(),
                        .audit_over = s_.audit.failure().has_value()});
}

void Loop::write_stats(SimTime now) {
  stats_written_ = Clock::now();
  if (s_.options.stats_file.empty()) return;
  if (!write_json(s_.options.stats_file, report_json(s_, now)))
    spdlog::warn("{}: cannot be written", s_.options.stats_file.string());
}

}  // namespace

void run_loop(Session& session) {
  Loop loop(session);
  while (!loop.over()) {
    loop.receive();
    const std::optional<Moment> moment = loop.next_moment();
    loop.answer_probes();
    if (!moment) continue;
    loop.draw(*moment);
    // Reported when its picture is on the disk: a visual killed in between is given the same frame again, and no
    // picture is missing.
    loop.keep(*moment);
    loop.audit(*moment);
    loop.report(*moment);
  }
  loop.finish();
}

}  // namespace phare
