// The mouse and the panel in the loop of the visual process.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "visual/process/loop.h"

namespace phare {
namespace {

/// The eye that the user moves: turned, and shifted by so much ahead, to the left and up of where it looks.
void shift_eye(FreeEye& eye, double left_deg, double up_deg, const glm::dvec3& by_m) {
  eye.yaw_deg = std::remainder(eye.yaw_deg + left_deg, 360.0);
  eye.pitch_deg = std::clamp(eye.pitch_deg + up_deg, -89.0, 89.0);
  const double yaw = eye.yaw_deg * std::numbers::pi / 180.0, pitch = eye.pitch_deg * std::numbers::pi / 180.0;
  const glm::dvec3 ahead{std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
  const glm::dvec3 left{-std::sin(yaw), std::cos(yaw), 0.0};
  eye.position_m += by_m.x * ahead + by_m.y * left + by_m.z * glm::dvec3(0.0, 0.0, 1.0);
}

}  // namespace

/// A click chooses the place of the scene under it, which stays where it is in the world; one on the sky lets it go.
/// The mouse moves the free eye. What it does on the panel is the panel's.
void Loop::mind_the_mouse() {
  using Kind = PointerEvent::Kind;
  using Button = PointerEvent::Button;
  const std::vector<PointerEvent> events = s_.window->take_pointer();
  if (panel_ && s_.desk.panel) panel_->take(events);
  std::optional<PointerEvent> click;
  double wheel = 0.0;
  for (const PointerEvent& event : events) {
    const bool on_road = !on_panel(event.x_px, event.y_px);
    if (event.kind == Kind::kPress && event.button == Button::kLeft && on_road) click = event;
    if (event.kind == Kind::kPress && event.button != Button::kLeft) eye_held_ = on_road;
    if (event.kind == Kind::kWheel && on_road) wheel += event.wheel;
  }
  Window::Moves moves = s_.window->take_moves();
  if (!eye_held_) moves = {};
  // Right button held: turn, a degree for 8 pixels; middle: shift; wheel: along the way one looks. A turn is felt, not
  // measured: chosen by hand.
  if (s_.desk.camera == CameraKind::kFree)
    shift_eye(s_.desk.free_eye, moves.turn_x_px / 8.0, moves.turn_y_px / 8.0,
              {wheel, 0.02 * moves.shift_x_px, 0.02 * moves.shift_y_px});
  const Window::Mouse mouse = s_.window->mouse();
  if (!click || !newest_ || !mouse.inside) return;
  const auto at = measuring_.seen_at((click->x_px + 0.5) / mouse.width_px, (click->y_px + 0.5) / mouse.height_px);
  s_.desk.point = at ? std::optional(Probe{Probe::Frame::kWorld, at->position_m, at->normal}) : std::nullopt;
  fresh_ = true;
}

/// Where the present picture is seen from; nothing: from the free eye.
std::optional<FreeEye> Loop::seen_from() const {
  if (s_.desk.camera == CameraKind::kFree || !newest_) return std::nullopt;
  Camera camera = input_.camera;
  camera.seen_from_01 = 0.0, camera.seen_to_01 = 1.0;
  return free_eye_at(camera, newest_->car.pose);
}

/// A key moves the free eye, which takes the place of another first.
void Loop::move_eye(KeyAction key) {
  constexpr double kStep_m = 0.5, kStep_deg = 2.0;
  struct Step {
    KeyAction key;
    glm::dvec3 by_m{0.0};
    double left_deg = 0.0;
  };
  using enum KeyAction;
  const Step steps[] = {{kEyeForward, {kStep_m, 0, 0}}, {kEyeBack, {-kStep_m, 0, 0}},   {kEyeLeft, {0, kStep_m, 0}},
                        {kEyeRight, {0, -kStep_m, 0}},  {kEyeUp, {0, 0, kStep_m}},      {kEyeDown, {0, 0, -kStep_m}},
                        {kEyeTurnLeft, {}, kStep_deg},  {kEyeTurnRight, {}, -kStep_deg}};
  const auto step = std::ranges::find(steps, key, &Step::key);
  if (step == std::end(steps)) return;
  if (const auto eye = seen_from())
    s_.desk.free_eye = *eye, s_.desk.camera = CameraKind::kFree, s_.desk.own_camera.clear();
  shift_eye(s_.desk.free_eye, step->left_deg, 0.0, step->by_m);
}

bool Loop::on_panel(double x_px, double y_px) const {
  return panel_ && s_.desk.panel && panel_->covers(x_px, y_px);
}

/// What the panel asked for in the newest frame, done as if it had come by key or bus.
void Loop::mind_the_panel() {
  for (const PanelCommand& asked : std::exchange(panel_asked_, {})) {
    if (const auto* command = std::get_if<RigControl>(&asked))
      panel_answer_ = verbs_(*command);
    else
      s_.window->keyboard().character(binding_of(std::get<KeyAction>(asked))->code, Clock::now());
  }
}

PanelFacts Loop::panel_facts(const FrameMoment& moment, double since_s) const {
  constexpr double kDegPerRad = 180.0 / std::numbers::pi;
  PanelFacts facts{.lit = s_.lamps.lit_text(),
                   .design = s_.lamps.design_index(),
                   .driven = s_.options.guide == "live",
                   .speed_kmh = std::abs(moment.car.pose.speed_mps) * 3.6,
                   .moves_lamps = s_.options.channel == 0,
                   .lamps = panel_lamps(s_.lamps),
                   .aim_deg = s_.lamps.aim_rad() * kDegPerRad,
                   .undo_steps = s_.lamps.undo_steps(),
                   .rig_file = s_.rig.file.filename().string(),
                   .desk = s_.desk,
                   .frame = s_.stats.newest,
                   .frames_per_s = since_s > 0.0 ? 1.0 / since_s : 0.0,
                   .messages = panel_messages(s_.bus.counters()),
                   .refused = s_.bus.counters().refused,
                   .answer_refused = panel_answer_.verdict == Verdict::kRefused};
  for (const DesignConfig& design : s_.lamps.designs()) facts.designs.push_back(design.name);
  facts.answer = facts.answer_refused ? panel_answer_.reason : panel_answer_.now;
  return facts;
}

/// Lays the panel out over this frame, where it is shown; what it asks for is done before the next.
void Loop::show_panel(const FrameMoment& moment) {
  input_.gui = nullptr;
  if (!s_.window || !s_.desk.panel) {
    if (panel_) panel_->hide();
    return;
  }
  const PictureSize size = s_.renderer.picture_size();
  if (!panel_) panel_ = std::make_unique<Panel>(size.height_px);
  const Clock::time_point now = Clock::now();
  const double since_s = std::chrono::duration<double>(now - std::exchange(panel_laid_out_, now)).count();
  panel_asked_ = panel_->lay_out(panel_facts(moment, since_s), size.width_px, size.height_px, since_s);
  input_.gui = &panel_->content();
  // Text and instruments stand beside it, over the mirrors if need be.
  input_.room = {.left_01 = panel_->right_px() / size.width_px};
}

}  // namespace phare
