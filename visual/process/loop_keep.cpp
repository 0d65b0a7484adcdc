#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "net/stats.h"
#include "visual/air_of_desk.h"
#include "visual/image/canvas.h"
#include "visual/process/loop.h"
#include "visual/process/report.h"

namespace phare {

namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kKeyframe_ns = 100'000'000;  // of the video
constexpr std::int64_t kEye_ns = 100'000'000;       // in real time: an eye adapts in seconds

/// Of the lamps that shine, from this place among the renderer's on.
void set_beams(Renderer& renderer, const Lamps& lamps, const VehicleState& pose, std::size_t first_beam) {
  for (const PlacedLamp& lamp : lamps.placed(pose)) renderer.set_beam(first_beam + lamp.beam, lamps.image(lamp.beam));
}

}  // namespace

void Loop::keep(const FrameMoment& moment) {
  const std::int64_t eye = moment.time.ns / kEye_ns;
  if (!s_.eye.fixed() && (s_.options.lockstep || eye != newest_eye_)) {
    s_.album.keep_eye(s_.eye.json());
    newest_eye_ = eye;
  }
  if (captured_) capture_ = {number_of(moment), moment, label(moment)};
  if (wants_stills(moment)) still_ = still_of(moment);
  // They take a second, which a drive in real time has when it is over.
  const bool there_is_time = s_.options.lockstep || ended_ || over_;
  const bool now = still_ && there_is_time && !s_.album.has_stills();
  if (now || s_.renderer.has_kept()) keep_capture();
  if (now) keep_stills();
}

void Loop::keep_stills() {
  const Still& still = *still_;
  const VehicleState& pose = still.moment.car.pose;
  const bool by_then_otherwise = newest_ && still.moment.time != newest_->time;
  if (by_then_otherwise) {
    set_beams(s_.renderer, still.lamps, pose, 0);
    if (still.versus.lamps() != nullptr) set_beams(s_.renderer, *still.versus.lamps(), pose, Versus::kFirstBeam);
  }
  s_.stills_design = still.lamps.design_index();
  // Before the stills, whose last picture says that all are there.
  if (still.versus.lamps() != nullptr) s_.album.keep_versus(s_.renderer, still.driver, still.versus, pose, still.label);
  s_.album.keep_stills(s_.renderer, still.driver, pose, still.lamps, s_.options.width_px, s_.options.height_px,
                       still.label);
  if (by_then_otherwise) {  // a window may stay, in which they shine as they do now
    s_.lamps.forget_shown();
    versus_.forget_shown();
  }
  progress_ = Clock::now();
  frame_end_ = {};  // not a frame interval
}

/// Where frames overlap that of a frame is there when the next one has been drawn.
void Loop::keep_capture() {
  if (!capture_) return;
  const auto& [number, moment, label] = *capture_;
  Image8 image = s_.renderer.read_image();
  if (moment.car.stale) draw_text(image, 12, 12, "pose held: no VehicleState", {255, 90, 60}, 2);
  if (moment.controls.fail_safe) draw_text(image, 12, 60, "FAIL-SAFE low beam", {255, 90, 60}, 2);
  if (!moment.controls.source_fault.empty()) draw_text(image, 12, 36, moment.controls.source_fault, {255, 90, 60}, 2);
  s_.album.keep_frame(number, std::move(image), label);
  capture_.reset();
}

/// The frame as stills have it, whatever camera and layout are shown: the driver's eye over the whole picture, by the
/// car's own light, with nothing over it.
Loop::Still Loop::still_of(const FrameMoment& moment) const {
  FrameInput still = input_;
  still.camera = driver_camera(s_.channel(), moment.car.pose);
  still.part = {};
  still.falling = falling_past({}, moment.car.pose, moment.time);
  still.lamps = s_.lamps.placed(moment.car.pose);
  still.moving.clear(), still.glare.clear(), still.pupils.clear(), still.spraying.clear();
  still.windscreen.reset(), still.more_views.clear();
  still.view = View::kPhoto;
  still.shapes = ShapesFrom::kPipeline;  // there is time
  still.overlay.clear(), still.instruments.clear(), still.panel = {}, still.marks = {}, still.gui = nullptr;
  return {std::move(still), moment, s_.lamps, versus_.copy(), label(moment)};
}

void Loop::finish() {
  s_.bus.on_datagram = nullptr;
  finish_audit();
  keep_capture();
  // A drive that was ended before its telling moment, or whose stills the process before has made: as it was last.
  if (!still_ && newest_ && s_.album.wanted()) still_ = still_of(*newest_);
  if (still_ && !s_.album.has_stills()) keep_stills();
  keep_other_designs();
  s_.album.finish();
  if (newest_ && s_.album.not_kept() > 0) report(*newest_);  // the stills too: the statistics may find no room either
  write_stats(newest_ ? newest_->time : SimTime{});
}

/// Glare of others at our driver's eyes, whatever camera is shown, and ours at theirs.
void Loop::mind_who_is_glared_at(DriveRow& row, const FrameMoment& moment) {
  const VehicleState& car = moment.car.pose;
  const Camera driver = driver_camera(s_.channel(), car);
  const glm::dvec3 ahead = driver.world_from_eye[0];
  const Viewer viewer{s_.desk.age_years, s_.desk.iris_pigment};
  row.glare =
      glare_figures(s_.traffic.glare_at(users_, driver.eye_m, world_, air_of(shown_)), driver.eye_m, ahead, viewer);
  row.others_glare =
      glare_at_oncoming_eyes(s_.lamps, car, Traffic::oncoming_eyes(users_, ahead), world_, air_of(shown_), viewer);
}

/// A row of drive.csv, and how long each design has shone.
void Loop::log_frame(const FrameMoment& moment) {
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
               .frame_ms = s_.stats.newest.wall_ms,
               .gpu_ms = s_.stats.newest.gpu_ms};
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
  if (!s_.traffic.empty()) mind_who_is_glared_at(row, moment);
  if (drive_log_.reach_is_due(moment.time) && versus_.lamps() != nullptr)
    row.versus_reach = reach_of(*versus_.lamps(), moment.car.pose, measuring_.road());
  if (drive_log_.reach_is_due(moment.time)) row.reach = reach_of(s_.lamps, moment.car.pose, measuring_.road());
  if (!drive_log_.write(row)) s_.album.missed("drive.csv");
}

/// Every design that has shone is on the page, in the moment of the stills and with low beam. By lamps of their own, so
/// that the counts are those of the drive.
void Loop::keep_other_designs() {
  if (!s_.album.wanted() || s_.stop.requested()) return;
  if (!still_) return;
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
    set_beams(s_.renderer, lamps, still_->moment.car.pose, 0);
    char label[160];
    std::snprintf(label, sizeof label, "%.1f s  low  %s", still_->moment.time.seconds(), lamps.design().name.c_str());
    s_.album.keep_design(s_.renderer, driver, still_->moment.car.pose, lamps, design, label);
  }
}

/// With --frames and --video every one; else one each tenth of a second of simulated time for the video, of other
/// channels one a second. In real time fewer, when they cannot be written as fast.
bool Loop::wants_picture(const FrameMoment& moment) {
  if (!s_.album.wanted() || over_) return false;
  if (s_.options.frames > 0) return (s_.options.lockstep ? moment.frame_index : drawn_frames_) < s_.options.frames;
  if (s_.album.busy()) return false;
  if (s_.options.video) return true;
  const std::int64_t every_ns = s_.options.channel == 0 ? kKeyframe_ns : 1'000'000'000;
  const std::int64_t picture = moment.time.ns / every_ns;
  return std::exchange(newest_picture_, picture) != picture;
}

/// Low beam at speed past the wanted time tells most; at the end whatever there is.
bool Loop::wants_stills(const FrameMoment& moment) const {
  constexpr double kTellingSpeed_mps = 8.0;
  if (!s_.album.wanted() || s_.album.has_stills() || still_) return false;
  if (ended_ || over_) return true;
  if (moment.time.seconds() < s_.options.still_at_s) return false;
  return moment.controls.light_switch == LightSwitch::kLow && !moment.controls.flash &&
         moment.car.pose.speed_mps > kTellingSpeed_mps;
}

std::string Loop::label(const FrameMoment& moment) const {
  char text[120];
  std::snprintf(text, sizeof text, "%.1f s  %.0f km/h  %s%s%s", moment.time.seconds(), moment.car.pose.speed_mps * 3.6,
                s_.lamps.lit_text().c_str(), s_.lamps.designs().size() > 1 ? "  " : "",
                s_.lamps.designs().size() > 1 ? s_.lamps.design().name.c_str() : "");
  return text;
}

void Loop::write_stats(SimTime now) {
  stats_written_ = Clock::now();
  if (s_.options.stats_file.empty()) return;
  if (!write_json(s_.options.stats_file, report_json(s_, now)))
    spdlog::warn("{}: cannot be written", s_.options.stats_file.string());
}

}  // namespace phare
