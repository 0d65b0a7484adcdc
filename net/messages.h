// The messages of phare.proto as plain structs; models and renderers see these and never protobuf.
// Units, frames and meanings of the fields are written once, in phare.proto.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "config/control_levels.h"
#include "net/sim_time.h"

namespace phare {

enum class Sender { kUnknown = 0, kCockpit = 1, kDynamics = 2, kVisual = 3, kControl = 4, kLaw = 5 };

struct CockpitState {
  std::int64_t frame_index = -1;
  LightSwitch light_switch = LightSwitch::kOff;
  bool flash = false;
  bool fog_front = false;
  std::uint32_t design_index = 0;
  double steering_wheel_rad = 0.0;
  double accelerator_01 = 0.0;
  double brake_01 = 0.0;
  Gear gear = Gear::kDrive;
  bool fail_safe = false;
  std::uint64_t light_changes = 0;
  WallTime light_change_wall;
  SimTime light_change_sim;
  bool drive_ended = false;
  std::string source;
  bool fog_rear = false;
  TurnSignal turn = TurnSignal::kNone;
  bool hazard = false;
  bool high_beam_automatic = false;
  double lamp_aim_rad = 0.0;
  double clutch_01 = 0.0;
  double parking_brake_01 = 0.0;
  bool ignition_off = false;
  WallTime source_stamp;
  std::string source_fault;

  friend bool operator==(const CockpitState&, const CockpitState&) = default;
};

/// Most steps that one VehicleState names the hashes of.
inline constexpr std::size_t kMaxStepHashes = 64;

struct VehicleState {
  std::int64_t frame_index = -1;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;
  double vx_mps = 0.0, vy_mps = 0.0, vz_mps = 0.0;
  double roll_rate_radps = 0.0, pitch_rate_radps = 0.0, yaw_rate_radps = 0.0;
  double ax_mps2 = 0.0, ay_mps2 = 0.0;
  double speed_mps = 0.0;
  double steer_rad = 0.0;
  double suspension_pitch_rad = 0.0, suspension_roll_rad = 0.0, suspension_heave_m = 0.0;
  std::string level;
  std::uint64_t step = 0;
  std::uint64_t state_hash = 0;
  double lag_s = 0.0;
  bool high_beam_telltale = false;
  bool drive_ended = false;
  double lamp_tilt_rad = 0.0;
  std::vector<std::uint64_t> step_hash;

  friend bool operator==(const VehicleState&, const VehicleState&) = default;
};

struct FrameReport {
  std::int64_t frame_index = -1;
  std::uint32_t channel = 0;
  std::uint32_t channels = 1;
  double frame_ms = 0.0;
  double gpu_ms = 0.0;
  std::uint64_t light_changes_drawn = 0;
  VehicleState drawn;
  bool pose_stale = false;
  LightSwitch light_drawn = LightSwitch::kOff;
  bool flash_drawn = false;
  bool fail_safe_drawn = false;
  std::uint64_t pictures_not_kept = 0;
  std::string audit_failure{};
  std::uint64_t start = 0;

  friend bool operator==(const FrameReport&, const FrameReport&) = default;
};

// The commands of RigControl stand outside it because a nested struct with initialisers has no default constructor
// until the outer one is complete (CWG 1397).
namespace rig_command {
struct Pause {
  bool on = false;
  friend bool operator==(const Pause&, const Pause&) = default;
};
struct Seek {
  double to_s = 0.0;
  friend bool operator==(const Seek&, const Seek&) = default;
};
struct Design {
  std::uint32_t index = 0;
  friend bool operator==(const Design&, const Design&) = default;
};
struct Aim {
  double pitch_rad = 0.0;
  friend bool operator==(const Aim&, const Aim&) = default;
};
struct Quit {
  friend bool operator==(const Quit&, const Quit&) = default;
};
/// Source counted from 1; 0: every source of the lamp.
struct Dim {
  std::string lamp;
  std::uint32_t source = 0;
  double dimming_01 = 1.0;
  friend bool operator==(const Dim&, const Dim&) = default;
};
struct Swivel {
  std::string lamp;
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
  friend bool operator==(const Swivel&, const Swivel&) = default;
};
struct Place {
  std::string lamp;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  friend bool operator==(const Place&, const Place&) = default;
};
/// A setting of the picture (config/desk.h); no value: it is only asked for.
struct Set {
  std::string setting;
  std::string value;
  friend bool operator==(const Set&, const Set&) = default;
};
enum class MountQuantity { kForward, kLeft, kUp, kSpacing, kYaw, kPitch, kRoll };
/// Of a lamp, a pair ("headlamp"), or all lamps (no name).
struct Mount {
  std::string lamp;
  MountQuantity quantity = MountQuantity::kForward;
  double value = 0.0;  ///< m, rad
  bool by = false;     ///< added to what holds now
  friend bool operator==(const Mount&, const Mount&) = default;
};
struct Undo {
  std::uint32_t steps = 1;
  friend bool operator==(const Undo&, const Undo&) = default;
};
/// No name: all lamps, and their aim.
struct Reset {
  std::string lamp;
  friend bool operator==(const Reset&, const Reset&) = default;
};
/// No file: the rig's own.
struct Save {
  std::string file;
  friend bool operator==(const Save&, const Save&) = default;
};
/// The picture that the pixel light of a lamp shines.
struct Frame {
  std::string lamp;
  std::string file;  ///< PNG or PGM, as the visual sees it
  friend bool operator==(const Frame&, const Frame&) = default;
};
/// Changes nothing; the answers say what holds now.
struct Tell {
  friend bool operator==(const Tell&, const Tell&) = default;
};
}  // namespace rig_command

struct RigControl {
  using Pause = rig_command::Pause;
  using Seek = rig_command::Seek;
  using Design = rig_command::Design;
  using Aim = rig_command::Aim;
  using Quit = rig_command::Quit;
  using Dim = rig_command::Dim;
  using Swivel = rig_command::Swivel;
  using Place = rig_command::Place;
  using Tell = rig_command::Tell;
  using Set = rig_command::Set;
  using Mount = rig_command::Mount;
  using Undo = rig_command::Undo;
  using Reset = rig_command::Reset;
  using Save = rig_command::Save;
  using Frame = rig_command::Frame;
  std::variant<Pause, Seek, Design, Aim, Quit, Dim, Swivel, Place, Tell, Set, Mount, Undo, Reset, Save, Frame> command;
  std::uint64_t request_id = 0;
  std::uint64_t first_open = 0;

  friend bool operator==(const RigControl&, const RigControl&) = default;
};

struct ProbeRequest {
  std::uint64_t request_id = 0;
  std::vector<double> x_m, y_m, z_m, nx, ny, nz;

  friend bool operator==(const ProbeRequest&, const ProbeRequest&) = default;
};

struct ProbeReply {
  std::uint64_t request_id = 0;
  std::vector<double> illuminance_lx;
  std::string error;

  friend bool operator==(const ProbeReply&, const ProbeReply&) = default;
};

/// Most keys held, and most newest events, that one KeyInput names.
inline constexpr std::size_t kMostKeys = 16;

struct KeyInput {
  std::vector<std::uint32_t> held;
  std::vector<std::int32_t> event;
  std::uint64_t events = 0;

  friend bool operator==(const KeyInput&, const KeyInput&) = default;
};

enum class Verdict { kAccepted = 0, kRefused = 1, kPending = 2, kNotMine = 3 };

struct ControlReply {
  std::uint64_t to_start_id = 0;
  std::uint64_t request_id = 0;
  Verdict verdict = Verdict::kAccepted;
  std::string reason;
  std::string now;

  friend bool operator==(const ControlReply&, const ControlReply&) = default;
};

/// What a clock shows, asked and answered (net/peer_clock.h).
struct ClockProbe {
  WallTime asked;  ///< by the clock of who asks
  WallTime heard;  ///< by the clock of who answers, when the question came; 0: this is the question

  friend bool operator==(const ClockProbe&, const ClockProbe&) = default;
};

/// Most lamps that one LawAnswer names.
inline constexpr std::size_t kMostLawLamps = 16;

struct LampLight {
  std::string lamp;
  double yaw_rad = 0.0, pitch_rad = 0.0;
  std::vector<double> dimming_01;
  std::string frame{};  ///< of its pixel light; none: as it is

  friend bool operator==(const LampLight&, const LampLight&) = default;
};

struct LawAnswer {
  std::int64_t frame_index = -1;
  WallTime input;
  LightSwitch light_switch = LightSwitch::kOff;
  double levelling_rad = 0.0;
  std::vector<LampLight> lamps;

  friend bool operator==(const LawAnswer&, const LawAnswer&) = default;
};

/// Most lamps of a design that a LampState tells of.
inline constexpr std::size_t kMostLampStates = 16;

/// Arrays in the order of the design's lamps.
struct LampState {
  std::uint32_t design_index = 0;
  double aim_pitch_rad = 0.0;
  std::vector<double> x_m, y_m, z_m, yaw_rad, pitch_rad, roll_rad;

  friend bool operator==(const LampState&, const LampState&) = default;
};

struct FrameStart {
  std::uint64_t number = 1;
  CockpitState controls;
  VehicleState pose;
  bool pose_stale = false;

  friend bool operator==(const FrameStart&, const FrameStart&) = default;
};

using Payload = std::variant<CockpitState, VehicleState, FrameReport, RigControl, ProbeRequest, ProbeReply, KeyInput,
                             ControlReply, ClockProbe, LawAnswer, LampState, FrameStart>;

/// The envelope every payload travels in.
struct Datagram {
  Sender sender = Sender::kUnknown;
  std::uint32_t sender_channel = 0;
  std::uint64_t start_id = 0;
  std::uint64_t sequence = 0;
  SimTime sim_time;
  WallTime sent;
  Payload payload;
};

}  // namespace phare
