#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "visual/process/loop.h"
#include "visual/process/pick.h"
#include "visual/scene/ray_hit.h"

namespace phare {

namespace {

using namespace std::chrono_literals;

constexpr auto kStatsEvery = 1s;

}  // namespace

/// What measures in the picture, over it and in probes.csv.
void Loop::measure(const FrameMoment& moment) {
  const PictureSize size = s_.renderer.picture_size();
  const bool wall = s_.desk.camera == CameraKind::kWall;
  measuring_.see({.time = moment.time,
                  .car = moment.car.pose,
                  .picture = &input_,
                  .aspect = static_cast<double>(size.width_px) / size.height_px,
                  .wall = wall ? std::optional(wall_before(s_.lamps, moment.car.pose)) : std::nullopt,
                  .own_car = s_.props.own_car_in(s_.desk.camera, input_.camera, moment.car.pose)});
  input_.marks = measuring_.marks(drawn_frames_ % 6 == 0, shown_);
  if (versus_.lamps() != nullptr && shown_.compare != Compare::kOff)
    mark_versus(input_.marks, shown_, s_.lamps, versus_, moment.time);
  for (const ViewInput& inset : input_.more_views) {
    keep_clear(input_.marks, inset.part);
    frame_part(input_.marks, inset.part);
  }
  if (!over_ && !measuring_.log()) s_.album.missed("probes.csv");
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
      std::vector<PlacedLamp> own = input_.lamps;
      std::erase_if(own, Traffic::is_theirs);
      const std::vector<std::vector<float>> lx = s_.renderer.measure(own, points);
      const bool shadows = s_.desk.shadows != 0;
      for (std::size_t lamp = 0; lamp < lx.size(); ++lamp)
        for (std::size_t i = 0; i < points.size(); ++i)
          if (lx[lamp][i] > 0.0f && !(shadows && occluder(world_, own[lamp].position_m, points[i].position_m)))
            reply.illuminance_lx[i] += static_cast<double>(lx[lamp][i]);
    } else {
      reply.error = "no frame has been drawn yet";
    }
    s_.bus.send(asked_.front().time, reply);
  }
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
void Loop::govern(const FrameMoment& moment, double frame_ms) {
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
  s_.desk.method = shown_.method = governor.levels()[step->to].method;  // made before the drive
  spdlog::info("governor: {}", governor.text(*step));
}

/// With the frame that is drawn next, which does not wait for it.
void Loop::ask_audit(const FrameMoment& moment) {
  const std::int64_t number = s_.options.lockstep ? moment.frame_index : drawn_frames_;
  const bool others_turn = versus_.lamps() != nullptr && Versus::has_turn(shown_, moment.time);
  if (over_ || others_turn || s_.options.audit_every <= 0 || number % s_.options.audit_every != 0 ||
      input_.lamps.empty())
    return;
  finish_audit();          // where every frame is audited, of the one before
  ViewInput own = input_;  // the car's own light, which is known in float64
  own.lamps = s_.lamps.placed(moment.car.pose);
  own.camera.seen_from_01 = 0.0, own.camera.seen_to_01 = 1.0;  // the whole view, of which a half may be shown
  own.moving.clear();
  s_.renderer.ask_audit(own);
  audit_ =
      std::make_unique<AskedAudit>(AskedAudit{number, moment, std::move(own), s_.lamps, s_.renderer.picture_size()});
}

/// Of a frame that is done.
void Loop::take_audit() {
  constexpr std::size_t kPixels = 32;
  if (!audit_) return;
  const auto samples = s_.renderer.take_audit(kPixels, static_cast<std::uint64_t>(audit_->number) + 1);
  if (!samples) return;
  const std::unique_ptr<AskedAudit> of = std::exchange(audit_, nullptr);
  AuditMoment where{
      .frame = of->number,
      .time_s = of->moment.time.seconds(),
      .width_px = of->size.width_px,
      .height_px = of->size.height_px,
      .bound = audit_bound(s_.options.beam_image.value_or(s_.rig.beam_image), of->view.method, s_.options.audit_bound),
      .eye_m = of->view.camera.eye_m,
      .scene = &s_.scene,
      .by_lamp = {}};
  if (of->lamps.design_index() == s_.lamps.design_index())  // else the beams on the device are another's
    where.by_lamp = [&](const MeasurePoint& at) { return lux_by_lamp(of->view.lamps, at); };
  const auto failure = s_.audit.add(of->lamps, of->moment.car.pose, *samples, where);
  // A lockstep drive fails by it: its launcher says so, once; without one we do, when we leave.
  if (failure && !s_.options.lockstep) spdlog::warn("self-audit: {}", failure->text());
}

void Loop::finish_audit() {
  if (!audit_) return;
  s_.renderer.finish();
  take_audit();
}

void Loop::mind_the_stats(const FrameMoment& moment) {
  if (Clock::now() - stats_written_ > kStatsEvery) write_stats(moment.time);
}

/// Of every lamp of the design, as the picture's shader has it: where frames overlap, by beams a frame younger.
std::vector<double> Loop::lux_by_lamp(std::span<const PlacedLamp> lamps, const MeasurePoint& at) {
  std::vector<double> lux(s_.lamps.design().lamps.size(), 0.0);
  const auto measured = s_.renderer.measure(lamps, std::span(&at, 1));
  for (std::size_t i = 0; i < measured.size(); ++i) lux[lamps[i].beam] = static_cast<double>(measured[i].front());
  return lux;
}

std::string Loop::picked_line() const {
  if (s_.options.levels.empty()) return {};
  if (!s_.governor.on()) return "picked: " + s_.options.levels[level_].text() + ", " + s_.options.picked;
  const Governor& governor = s_.governor;
  std::string line =
      "budget " + fmt::format("{:.4g}", governor.budget_ms()) + " ms: " + governor.levels()[governor.now()].text();
  if (!governor.steps().empty()) line += ", step " + std::to_string(governor.steps().size()) + " of the governor";
  return line;
}

std::string Loop::audit_failure() const {
  return s_.options.lockstep && s_.audit.failure() ? s_.audit.failure()->text() : "";
}

}  // namespace phare
