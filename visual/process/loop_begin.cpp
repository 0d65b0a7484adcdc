#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "config/base/on_all_cores.h"
#include "net/control_desk.h"
#include "net/silence.h"
#include "visual/air_of_desk.h"
#include "visual/process/loop.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/weather_ahead.h"

namespace phare {

namespace {

using namespace std::chrono_literals;

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

/// A panel that nobody sees, for the machine code that draws one: a triangle that covers nothing.
const GuiContent& unseen_panel() {
  static const GuiContent content{
      .atlas = std::make_shared<const GuiAtlas>(GuiAtlas{1, 1, {0}}),
      .vertices = {{0.0f, 0.0f, 0.0f, 0.0f, {}}, {4.0f, 0.0f, 0.0f, 0.0f, {}}, {0.0f, 4.0f, 0.0f, 0.0f, {}}},
      .indices = {0, 1, 2},
      .draws = {{.indices = 3, .right_px = 4.0f, .bottom_px = 4.0f}}};
  return content;
}

/// Of a picture that nobody is to see: they have no part in what is made for it.
constexpr PicturePart kFewPixels{.width_01 = 1.0 / 16.0, .height_01 = 1.0 / 16.0};

/// So long a person waits before a window for weather that the drive may come to; chosen.
constexpr auto kMostWait = 8s;

void set_weather(FrameInput& input, const WeatherAhead& weather) {
  input.air = weather.air;
  input.snow_cover_01 = weather.snow_cover_01;
  input.effects[static_cast<std::size_t>(Effect::kWetGround)] = weather.ground;
}

}  // namespace

Loop::Loop(Session& session)
    : s_(session),
      pacer_(std::chrono::nanoseconds(1'000'000'000 / session.rig.frame_rate_hz)),
      screens_(screens_of(session.options, session.rig)) {
  verbs_.on<RigControl::Quit>([this](const auto&) {
    s_.stop.request();
    s_.bus.leaves_as_told();
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
  if (!session.options.lockstep) drawn_frames_ = std::max(session.album.frames_found(), drive_log_.frames_before());
  session.stats.frames_before = static_cast<std::uint64_t>(std::max<std::int64_t>(drawn_frames_, 0));
  if (!session.options.lockstep && session.album.wanted()) session.album.write_beside();
  if (!session.options.lockstep) input_.shapes = ShapesFrom::kEither, input_.few_kinds = true;
  warm_up();
  announce();
  ready_ = Clock::now();
}

/// The first picture of each kind makes the device's machine code, which may take a second: before the drive, not in
/// it. Kinds differ by how many lamps shine and how their beams are looked up, so every design is switched through its
/// lights over the whole scene; in lockstep, where a slow frame harms nobody, and in place of one that was killed,
/// which is missed, the first picture must do. Between the pictures the window is minded: a person may leave.
void Loop::warm_up() {
  const Clock::time_point begin = Clock::now();
  const VehicleState pose;
  FrameInput input;
  input.few_kinds = input_.few_kinds;
  set_by_desk(input, s_.desk);
  input.camera = camera_of(first_eye(s_.desk), seen_by(first_eye(s_.desk), s_.channel(), s_.lamps, pose));
  const Camera first_camera = std::exchange(input.camera, overview_camera(s_.scene));
  if (s_.desk.windscreen) input.windscreen = Windscreen{.wiper = s_.desk.wiper};
  // As an animal will look at the lamps.
  if (!pupils_.none())
    input.pupils = {{input.camera.eye_m + 10.0 * input.camera.world_from_eye[0], glm::vec3(1.0f), 1e-4}};
  // As vehicles will throw up water, where the ground is wet.
  if (!s_.traffic.empty()) {
    SprayingVehicle vehicle{.speed_mps = 2.0 * kSprayFrom_mps};
    for (std::size_t i = 0; i < vehicle.wheels_m.size(); ++i)
      vehicle.wheels_m[i] = input.camera.eye_m + (20.0 - 5.0 * static_cast<double>(i)) * input.camera.world_from_eye[0];
    input.spraying = {vehicle};
  }
  const double far_mesh_from_m = std::exchange(input.far_mesh_from_m, std::numeric_limits<double>::infinity());
  const bool thorough = !s_.options.lockstep && !s_.options.going_on;
  if (thorough) input.part = kFewPixels;
  const int steps = thorough ? 5 * static_cast<int>(s_.lamps.designs().size()) + 2 : 1;
  const bool beside = s_.fixed_light->street_lamps() > 0;  // they glare from the first picture on
  int step = 0;
  bool last = false;
  // Else found when first asked for, and missed there.
  if (thorough && (drive_log_.wanted() || s_.window))
    on_all_cores(2, [&](std::size_t i) { i == 0 ? s_.lamps.find_cutoffs() : measuring_.road().prepare(); });
  const auto draw = [&](const CockpitState& controls) {
    if (over()) return;  // who does not want to wait leaves
    if (s_.window) input.panel = getting_ready_panel(++step, steps);
    if (s_.window && last) input.gui = &unseen_panel();
    light_up(controls);
    if (last) upload(versus_.follow(s_.desk, s_.lamps, controls));
    input.lamps = s_.lamps.placed(pose);
    // Others are met with the beams that a drive mostly has; with fog lamps besides each would take seconds more.
    const bool met =
        !s_.traffic.empty() && (last || (controls.light_switch >= LightSwitch::kLow && !controls.fog_front));
    // Their bodies may be of a kind of surface that the scene lacks.
    input.moving.clear();
    const glm::dvec3 ahead_m = input.camera.eye_m + 20.0 * input.camera.world_from_eye[0];
    if (met) input.moving = s_.traffic.one_of_each(ahead_m);
    if (thorough)
      for (const PlacedMesh& prop : s_.props.one_of_each(ahead_m)) input.moving.push_back(prop);
    // From outside one sees the car's own tail lamps, whichever camera the drive begins with.
    const bool glaring =
        s_.desk.glare != std::size_t{0} &&
        (met || beside || (last && thorough) || !s_.lamps.glare_at(pose, first_camera.eye_m, Scene{}, {}).empty());
    if (thorough && s_.options.audit_every > 0) s_.renderer.prepare_audit(input);
    const auto is_ready = [&](std::size_t others, bool glare) {
      if (thorough) ready_for_.insert({shown_kind(), lit_with(controls, others, glare)});
    };
    is_ready(0, false);
    for (std::size_t lamps = 0; glaring && lamps <= (met ? Traffic::kMostLamps : 0); ++lamps) is_ready(lamps, true);
    // Without shadows and with them: the drive goes from one to the other as things come into the beams.
    std::optional<std::size_t>& shadows = input.effects[static_cast<std::size_t>(Effect::kShadows)];
    // The same for fog, where there is some to begin with, and of the light that the drive begins with.
    for (const bool clear : {true, false}) {
      if (!clear && air_of(s_.desk).clear() && !(thorough && last)) continue;
      input.effects[static_cast<std::size_t>(Effect::kFog)] = s_.desk.fog;
      input.air = clear ? Air{} : air_of(s_.desk);
      if (!clear && input.air.clear()) input.air.visibility_m = 100.0;
      for (const bool off : {true, false}) {
        shadows = off ? std::optional<std::size_t>(0) : s_.desk.shadows;
        if (last && s_.desk.mirrors) input.more_views = mirror_views(input, s_.channel(), pose);
        s_.renderer.draw(input);
        if (glaring) {  // a lamp ahead shines into this eye, as one will into that of the drive
          FrameInput blinded = input;
          blinded.glare = {{input.camera.eye_m + 10.0 * input.camera.world_from_eye[0], 1.0}};
          s_.renderer.draw(blinded);
          // The pass sums two, four, eight or twelve.
          while ((met || beside) && last && blinded.glare.size() < kMostGlaringLamps) {
            const std::size_t more =
                std::min(blinded.glare.size() < 2 ? 3 : 2 * blinded.glare.size() - 1, kMostGlaringLamps);
            blinded.glare.resize(more, blinded.glare.front());
            s_.renderer.draw(blinded);
          }
          // Of others one lamp lights the scene, or two.
          for (const std::size_t beam : met ? s_.traffic.beams_to_meet() : std::vector<std::size_t>{}) {
            const auto draw_beside = [&](const std::vector<PlacedLamp>& own) {
              blinded.lamps = own;
              for (std::size_t lamp = 1; lamp <= Traffic::kMostLamps; ++lamp) {
                blinded.lamps.push_back({input.camera.eye_m, input.camera.world_from_eye, beam});
                s_.renderer.draw(blinded);
              }
            };
            draw_beside(input.lamps);
            if (!last || beam == Traffic::kBeam) continue;
            // Light of its own colour shares no pipelines with the car's as they pass: what the own lamps do not reach,
            // and when they shine past the eye.
            draw_beside({});
            std::vector<GlaringLamp> glare = std::exchange(blinded.glare, {});
            draw_beside(input.lamps);
            draw_beside({});
            blinded.glare = std::move(glare);
          }
        }
        if (!last || versus_.lamps() == nullptr) continue;
        FrameInput halves = input;  // the other design's beams may be looked up in another way
        versus_.show(halves, s_.desk.compare, pose, {}, {});
        s_.renderer.draw(halves);
      }
      // Where the governor may step to: not in the drive either. But by "reference" with the first beam alone: its
      // pictures take long.
      if (controls.light_switch < LightSwitch::kLow || !thorough || clear != air_of(s_.desk).clear()) continue;
      for (const GovernorLevel& level : s_.governor.levels()) {
        if (!last && level.method == Method::kReference) continue;
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
  if (thorough) draw(shown_by_desk(s_.desk, controls_to_show(s_.bus, Clock::now())));  // low beam
  if (thorough && makes_weather_ready(s_.desk, s_.window.has_value())) {
    const bool waited_for = s_.window && !s_.desk.weather_ahead;
    warm_up_weather(input, waited_for ? Clock::now() + kMostWait : Clock::time_point::max());
  }
  input.part = {};
  input.camera = first_camera;
  input.far_mesh_from_m = far_mesh_from_m;
  input.want_image = s_.album.wanted();
  draw(shown_by_desk(s_.desk, controls_to_show(s_.bus, Clock::now())));
  s_.lamps.begin_counting();
  if (thorough) made_.push_back(s_.desk);
  if (!ended_) spdlog::info("ready after {:.1f} s", std::chrono::duration<double>(Clock::now() - begin).count());
}

/// Of the light that `input` has: every kind of weather that the drive may come to, where an occluder stands in the
/// beams and where none does, with the lamps of others and without.
/// A kind of weather that is begun is made to its end; once `until` is past, the others are left to Loop::follow_desk.
void Loop::warm_up_weather(FrameInput input, Clock::time_point until) {
  const std::vector<WeatherAhead> weathers = weathers_ahead(s_.desk);
  input.more_views.clear();
  const bool glares = s_.desk.glare != std::size_t{0} && (!s_.traffic.empty() || s_.fixed_light->street_lamps() > 0);
  warm_up_views(input);
  int step = 0;
  for (const WeatherAhead& weather : weathers) {
    if (Clock::now() >= until) {
      spdlog::info(
          "weather made ahead: {} kinds of {}; the others are made when they are set (--set weather_ahead=on: all)",
          step, weathers.size());
      return;
    }
    set_weather(input, weather);
    // A screen may be set before the eye in the drive, too.
    input.windscreen = Windscreen{.wiper = s_.desk.wiper};
    if (s_.window) input.panel = getting_ready_panel(++step, static_cast<int>(weathers.size()));
    for (const bool off : {true, false}) {
      if (over()) return;
      input.effects[static_cast<std::size_t>(Effect::kShadows)] = off ? std::optional<std::size_t>(0) : s_.desk.shadows;
      const auto draw_with = [&](std::size_t lamps, std::size_t beam) {
        FrameInput of_others = input;
        of_others.lamps.resize(input.lamps.size() + lamps, {input.camera.eye_m, input.camera.world_from_eye, beam});
        of_others.glare.clear();
        s_.renderer.draw(of_others);
        if (!glares) return;
        of_others.glare = {{input.camera.eye_m + 10.0 * input.camera.world_from_eye[0], 1.0}};
        s_.renderer.draw(of_others);
      };
      draw_with(0, Traffic::kBeam);
      for (const std::size_t beam : s_.traffic.empty() ? std::vector<std::size_t>{} : s_.traffic.beams_to_meet())
        for (std::size_t lamps = 1; lamps <= Traffic::kMostLamps; ++lamps) draw_with(lamps, beam);
    }
  }
  warm_up_lights(std::move(input), until);
}

/// What else a person may choose to see in a window, in the air that the drive begins with.
void Loop::warm_up_views(FrameInput input) {
  if (!s_.window) return;
  set_weather(input, weather_of(s_.desk));
  for (const View view : {View::kFalseColour, View::kClipping}) {
    input.view = view;
    for (const bool off : {true, false}) {
      if (over()) return;
      input.effects[static_cast<std::size_t>(Effect::kShadows)] = off ? std::optional<std::size_t>(0) : s_.desk.shadows;
      s_.renderer.draw(input);
    }
  }
  input.camera.world_from_eye = glm::dmat3(1.0);  // level ahead: the sky
  s_.renderer.draw(input);
}

/// Weather for which one switches lights, under those that a person may switch to; among street lamps with their glare,
/// which is in every picture. Lights whose tables have shapes of their own, but as many lamps as one before, share
/// pipelines that read shapes from the frame: slower by a fifth, and no frame waits for them. Until `until`.
void Loop::warm_up_lights(FrameInput input, Clock::time_point until) {
  const std::vector<WeatherAhead> weathers = weathers_for_lights(s_.desk);
  std::vector<CockpitState> lights = lights_ahead(shown_by_desk(s_.desk, controls_to_show(s_.bus, Clock::now())));
  input.glare.clear();
  if (s_.desk.glare != std::size_t{0} && s_.fixed_light->street_lamps() > 0)
    input.glare = {{input.camera.eye_m + 10.0 * input.camera.world_from_eye[0], 1.0}};
  std::set<std::size_t> lamps{input.lamps.size()};
  lights.erase(lights.begin());
  for (const CockpitState& light : lights) {
    light_up(light);
    input.lamps = s_.lamps.placed(VehicleState{});
    input.shapes = ShapesFrom::kPipeline;
    bool apart = false;  // its pipelines are not those of a light before
    for (const WeatherAhead& weather : weathers) {
      if (Clock::now() >= until) return;
      set_weather(input, weather);
      std::uint64_t made = 0;
      for (const bool off : {true, false}) {
        if (over()) return;
        input.effects[static_cast<std::size_t>(Effect::kShadows)] =
            off ? std::optional<std::size_t>(0) : s_.desk.shadows;
        made += s_.renderer.draw(input).pipelines_made;
      }
      if (made == 0 || std::exchange(apart, true)) continue;
      if (!lamps.insert(input.lamps.size()).second) input.shapes = ShapesFrom::kFrame;
    }
  }
}

/// "Up, and waiting for the first pose."
void Loop::announce() {
  FrameReport report;
  report.channel = s_.options.channel;
  report.channels = static_cast<std::uint32_t>(s_.rig.channels.size());
  s_.bus.send(SimTime{}, report);
}

}  // namespace phare
