// The loop of the visual process, inside: what one turn of it does, verb by verb. run_loop.cpp has the loop itself and
// how a frame is chosen and drawn, loop_begin.cpp what comes before the first, loop_judge.cpp what is measured in
// pictures, loop_keep.cpp what is left of them, loop_panel.cpp the mouse and
// the panel, loop_change.cpp how the picture follows the desk, loop_lamps.cpp which lamps are in it.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "net/control_desk.h"
#include "visual/process/drive_log.h"
#include "visual/process/eyeshine_of_lamps.h"
#include "visual/process/lamp_keys.h"
#include "visual/process/notice.h"
#include "visual/process/panel.h"
#include "visual/process/picture_instruments.h"
#include "visual/process/pose_buffer.h"
#include "visual/process/screens.h"
#include "visual/process/session.h"
#include "visual/process/stall.h"
#include "visual/process/verbs.h"
#include "visual/process/versus.h"

namespace phare {

/// What one frame shows.
struct FrameMoment {
  std::int64_t frame_index = -1;  ///< real time: -1
  SimTime time;
  CockpitState controls;
  PoseBuffer::Drawn car;
};

class Loop {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Loop(Session& session);

  bool over();
  void receive() { s_.bus.poll(); }
  void answer_probes();
  std::optional<FrameMoment> next_moment();
  void draw(const FrameMoment& moment);
  void report(const FrameMoment& moment);
  void keep(const FrameMoment& moment);
  void take_audit();
  void mind_the_stats(const FrameMoment& moment);
  void finish();

 private:
  struct Still;
  void take(const Datagram& datagram);
  void mind_the_keys();
  void mind_the_mouse();
  std::optional<FreeEye> seen_from() const;
  void move_eye(KeyAction key);
  bool on_panel(double x_px, double y_px) const;
  void mind_the_panel();
  void show_panel(const FrameMoment& moment);
  PanelFacts panel_facts(const FrameMoment& moment, double since_s) const;
  void measure(const FrameMoment& moment);
  std::vector<GlaringLamp> add_views(const FrameMoment& moment, const Lamps& shining);
  Still still_of(const FrameMoment& moment) const;
  void keep_stills();
  void follow_desk(const FrameMoment& moment);
  bool is_ready(const FrameMoment& moment);
  void finish_change(const FrameMoment& moment);
  bool is_rehearsed(const FrameMoment& moment);
  /// What a picture of a kind may come to in the drive.
  struct Rehearsed {
    std::optional<std::size_t> others{};  ///< lamps of others; none: those that shine now
    std::optional<bool> glare{};          ///< none: what glares now
    bool shadows = true;
    bool above = false;                   ///< seen by parallel rays
    std::optional<CockpitState> light{};  ///< of one's own lamps; none: as they shine
  };
  /// By rehearsals so far.
  struct Making {
    std::uint64_t rehearsals = 0, pipelines = 0;  ///< that found something to make, and made
    std::size_t at_once = 1;                      ///< to draw with in the next one
  };
  bool is_rehearsed(const Rehearsed& as, const Desk& desk, Making& made, const FrameMoment& moment);
  CameraEye place_eye(const FrameMoment& moment);
  CockpitState light_to_show(const FrameMoment& moment);
  std::optional<FrameInput> without_new_lamps(const FrameMoment& moment);
  bool is_made(const Desk& desk) const;
  void give_up_change();
  std::vector<Rehearsed> rehearsals_now() const;
  std::vector<Rehearsed> rehearsals_by_this_light() const;
  std::vector<Rehearsed> rehearsals() const;
  std::vector<CockpitState> other_lights(const CockpitState& controls) const;
  std::vector<PlacedLamp> placed_by(const CockpitState& light, const VehicleState& pose);
  Rehearsal rehearse(const Rehearsed& as, const Desk& desk, std::size_t at_once, const FrameMoment& moment);
  void light_up(const CockpitState& controls);
  void upload(const std::vector<Lamps::Change>& changes);
  EffectChoices picked_effects() const;
  void govern(const FrameMoment& moment, double frame_ms);
  std::vector<double> lux_by_lamp(std::span<const PlacedLamp> lamps, const MeasurePoint& at);
  std::vector<GlaringLamp> glare_in(const ViewInput& view, const VehicleState& pose, const Lamps& lamps) const;
  void mind_the_lamps(SimTime now);
  void warm_up();
  void warm_up_weather(FrameInput input, Clock::time_point until);
  void warm_up_views(FrameInput input);
  void warm_up_lights(FrameInput input, Clock::time_point until);
  void announce();
  void repeat_when_stalled();
  void tell_of_stall();
  std::optional<FrameMoment> lockstep_moment();
  std::optional<FrameMoment> display_moment();
  bool follows_another();
  std::optional<FrameMoment> begun_moment();
  std::int64_t number_of(const FrameMoment& moment) const;
  bool wants_picture(const FrameMoment& moment);
  bool wants_stills(const FrameMoment& moment) const;
  std::string label(const FrameMoment& moment) const;
  /// What was picked for the budget or the tolerance, as it holds now.
  std::string picked_line() const;
  /// What a lockstep drive fails by.
  std::string audit_failure() const;
  void ask_audit(const FrameMoment& moment);
  void finish_audit();
  void mind_the_road(const FrameMoment& moment);
  std::vector<std::string> overlay(const FrameMoment& moment) const;
  void press_for_lamps(KeyAction press);
  void refuse_key(std::string reason);
  std::vector<std::string> moving_lines() const;
  void mind_who_is_glared_at(DriveRow& row, const FrameMoment& moment);
  void log_frame(const FrameMoment& moment);
  void keep_capture();
  void keep_other_designs();
  void write_stats(SimTime now);

  Session& s_;
  Verbs verbs_ = visual_verbs(s_.lamps, s_.rig, s_.desk, s_.options.channel, s_.renderer.no_reference().value_or(""),
                              [this] { return seen_from(); });
  LampKeys lamp_keys_;
  Notice notice_;
  LampNews lamp_news_{s_.lamps};
  World world_{s_.scene, s_.movers.meshes()};  // as it is in this frame
  Pupils pupils_{s_.scene, s_.movers.meshes()};
  PictureInstruments measuring_{s_.desk,
                                s_.lamps,
                                world_,
                                RoadLine(s_.lane, s_.rig.scene_file),
                                ProbeLog(s_.options.channel == 0 ? s_.options.out : "", s_.options.going_on),
                                s_.fixed_light->any() ? s_.fixed_light.get() : nullptr};
  DriveLog drive_log_{s_.options.channel == 0 ? s_.options.out : "",
                      s_.options.going_on,
                      {.versus = s_.desk.compare != Compare::kOff, .traffic = !s_.traffic.empty()}};
  Versus versus_;
  /// The moment of the stills, to draw it and the other designs in, and how the lamps shone then.
  struct Still {
    FrameInput driver;
    FrameMoment moment;
    Lamps lamps;
    Versus versus;
    std::string label;
  };
  std::optional<Still> still_;
  /// An audit that is drawn with a frame, and what that was of.
  struct AskedAudit {
    std::int64_t number;
    FrameMoment moment;
    ViewInput view;
    Lamps lamps;  ///< as they shone: by the time it is done they may shine otherwise
    PictureSize size;
  };
  std::unique_ptr<AskedAudit> audit_;
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
  std::int64_t newest_picture_ = -1, newest_eye_ = -1;  ///< which of their intervals of simulated time
  std::optional<Stall> stall_;                          ///< from when the picture is ready
  Clock::time_point progress_ = Clock::now(), stats_written_ = Clock::now(), frame_end_{};
  Screens screens_;
  RoadEnd road_end_{s_.scene, s_.lane};
  RoadPlace road_ = RoadPlace::kThere;
  Clock::time_point ready_;
  bool ended_ = false;
  bool over_ = false;      // the drive is, and the window stays
  bool fresh_ = false;     // the lines of the overlay are wanted with the next frame
  bool captured_ = false;  // the picture of this frame is read back
  /// A picture that is read back, and what it was of.
  struct Capture {
    std::int64_t number;
    FrameMoment moment;
    std::string label;
  };
  std::optional<Capture> capture_;
  FrameInput input_;
  Desk shown_ = s_.desk;  ///< as the picture shows it
  /// Lamps by which a picture is lit, as far as pipelines are made for them.
  struct LitWith {
    std::uint32_t design = 0;
    std::set<LampFunction> functions{};
    std::size_t others = 0;  ///< lamps of others
    bool glare = false;
    bool apart = false;  ///< one's own are two that are not aimed alike; known once they are placed

    friend auto operator<=>(const LitWith&, const LitWith&) = default;
  };
  /// The desk asks, or has asked, for a picture that the device was not ready for.
  struct Change {
    Desk to;
    Clock::time_point asked;
    LitWith now{};         ///< when it was asked for, or when one's own light changed since
    std::size_t done = 0;  ///< of rehearsals()
    Making made{};
    bool followed = false;  ///< by the picture; what is left is what the drive may come to
    std::vector<CockpitState> lights{};
    Clock::time_point rests_until{};
  };
  std::optional<Change> change_;
  bool half_made_ = false;             ///< a change was given up before all was made
  std::vector<Desk> made_;             ///< kinds of picture of which nothing is left to make
  std::unique_ptr<Lamps> other_light_;  ///< of a rehearsal
  bool rehearsed_ = false;              ///< in this frame
  using Kind = std::size_t;             ///< of picture: of kinds_
  Kind shown_kind();
  LitWith lit_with(const CockpitState& light, std::size_t others, bool glare) const;
  void is_ready_for(const Rehearsed& as);
  static std::vector<LitWith> comes_to(const LitWith& lit, std::size_t own);
  bool may_show(const LitWith& lit, Rehearsed as, std::size_t own, const FrameMoment& moment);
  std::optional<LitWith> nearest_ready(const LitWith& lit, std::size_t own);
  bool is_drawn(const LitWith& lit, const Rehearsed& as, const FrameMoment& moment);
  std::vector<Desk> kinds_;
  std::set<std::pair<Kind, LitWith>> ready_for_;
  LitWith lit_with_;    ///< in the newest frame
  CockpitState light_;  ///< the same, of one's own lamps: the controls that it shows
  std::vector<GlaringLamp> glare_before_;
  std::vector<glm::dmat3> car_from_image_;  ///< of one's own lamps, as the newest frame had them
  /// What the picture waits for.
  struct Awaited {
    std::pair<Kind, LitWith> what;
    Clock::time_point since;
    bool shadows = true;  ///< what is rehearsed next
    Making made{};
  };
  std::optional<Awaited> awaited_;
  std::vector<Traffic::There> users_;  // other road users in this frame
  std::unique_ptr<Panel> panel_;       // from when it is first shown
  std::vector<PanelCommand> panel_asked_;
  ControlReply panel_answer_;
  Clock::time_point panel_laid_out_{};
  bool eye_held_ = false;                       // by a button of the mouse that went down on the road
  std::size_t level_ = s_.options.begin_level;  // of options.levels, where the governor does not lead
  std::optional<FrameMoment> newest_;
};

}  // namespace phare
