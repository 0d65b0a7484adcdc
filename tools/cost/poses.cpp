// The ladder of pose messages: how often the car tells where it is, and what the picture does until the next one.
#include <time.h>

#include <cmath>
#include <span>

#include "config/vehicle.h"
#include "net/wire.h"
#include "tools/cost/measure_ladders.h"
#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/road_laid.h"
#include "visual/process/pose_buffer.h"

namespace phare::cost {
namespace {

constexpr double kDegPerRad = 57.29577951308232, kSeconds = 10.0, kFrames_hz = 60.0;
constexpr int kTruth_hz = 3000;  // a multiple of every rate below and of the frames'

double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

/// Rough road at 80 km/h, a step of the wheel after a second, braking after four.
batch::Inputs a_drive() {
  batch::Inputs inputs;
  for (int i = 0; i <= 100; ++i) {
    const double time_s = 0.1 * i;
    inputs.time_s.push_back(time_s);
    inputs.steer_rad.push_back(time_s < 1.0 ? 0.0 : 0.010);
    inputs.accelerator_01.push_back(time_s < 4.0 ? 0.15 : 0.0);
    inputs.brake_01.push_back(time_s < 4.0 ? 0.0 : 0.3);
  }
  return inputs;
}

VehicleState state_of(const batch::Row& row) {
  VehicleState state;
  state.x_m = row.x_m, state.y_m = row.y_m, state.z_m = row.z_m;
  state.roll_rad = row.roll_rad, state.pitch_rad = row.pitch_rad, state.yaw_rad = row.yaw_rad;
  const double c = std::cos(row.yaw_rad), s = std::sin(row.yaw_rad);
  state.vx_mps = c * row.vx_mps - s * row.vy_mps, state.vy_mps = s * row.vx_mps + c * row.vy_mps;
  state.roll_rate_radps = row.roll_rate_radps, state.pitch_rate_radps = row.pitch_rate_radps;
  state.yaw_rate_radps = row.yaw_rate_radps;
  state.ax_mps2 = row.ax_mps2, state.ay_mps2 = row.ay_mps2;
  state.speed_mps = row.vx_mps;
  state.level = "full";
  return state;
}

Result<std::vector<VehicleState>> truth(const std::string& vehicle_file) {
  const Result<VehicleParams> vehicle = read_vehicle(vehicle_file);
  if (!vehicle) return vehicle.error();
  Road road;
  if (const Status laid = lay({.roughness = "C"}, {}, road); !laid) return laid.error();
  batch::Options options;
  options.vehicle = *vehicle;
  options.vehicle_place = vehicle_file;
  options.step_s = 1.0 / kTruth_hz;
  options.output_hz = kTruth_hz;
  options.speed_mps = 80.0 / 3.6;
  options.road = &road;
  std::vector<VehicleState> states;
  const auto ran = batch::run(options, a_drive(), [&](const batch::Row& row) { states.push_back(state_of(row)); });
  if (!ran) return ran.error();
  return states;
}

SimTime time_of(std::size_t sample) {
  return {static_cast<std::int64_t>(sample) * 1'000'000'000 / kTruth_hz};
}

/// One level: `hz` messages a second over the wire; each picture shows the newest pose, or carries it on to its own
/// time.
struct PoseLevel {
  int hz = 0;
  bool carried_on = false;
  std::vector<double> differences_deg{};  ///< of pitch, the same in every round
  std::vector<double> times_ms{};         ///< of processor a second driven, of each round
};

void drive(const std::vector<VehicleState>& states, PoseLevel& level) {
  const std::size_t between = static_cast<std::size_t>(kTruth_hz / level.hz);
  const auto per_frame = static_cast<std::size_t>(kTruth_hz / kFrames_hz);
  PoseBuffer buffer;
  Datagram sent, received;
  sent.sender = Sender::kDynamics;
  sent.start_id = sent.sequence = 1;
  std::string bytes;
  level.differences_deg.clear();
  double busy_ms = 0.0;
  // Pictures fall between messages in a new place each time: 7 is prime to every rate.
  std::size_t next_frame = per_frame;
  VehicleState newest;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i % between == 0) {
      const double begin = thread_ms();
      sent.sim_time = time_of(i);
      sent.payload = states[i];
      encode_into(sent, bytes);
      if (decode_into(std::as_bytes(std::span(bytes)), received) == Refusal::kNone) {
        newest = std::get<VehicleState>(received.payload);
        if (level.carried_on) buffer.push(received.sim_time, newest);
      }
      ++sent.sequence;
      busy_ms += thread_ms() - begin;
    }
    if (i < next_frame) continue;
    next_frame = i + per_frame + 7;
    const double begin = thread_ms();
    const VehicleState shown = level.carried_on ? buffer.at(time_of(i))->pose : newest;
    busy_ms += thread_ms() - begin;
    level.differences_deg.push_back(kDegPerRad * (shown.pitch_rad - states[i].pitch_rad));
  }
  level.times_ms.push_back(busy_ms / kSeconds);
}

}  // namespace

Result<Ladder> pose_ladder(const Plan& plan) {
  plan.progress("pose messages", 0.0);
  const Result<std::vector<VehicleState>> states = truth(plan.vehicle_file);
  if (!states) return states.error();
  Ladder ladder{.name = "poses",
                .what =
                    "pitch of the picture by the rate of the car's messages, ten seconds of rough road at 80 km/h, "
                    "a step of the wheel and braking",
                .reference = "the car's own pitch at the time of each picture",
                .error_unit = "deg",
                .time_unit = "ms of processor a second driven"};
  std::vector<PoseLevel> levels;
  for (const int hz : {20, 50, 100, 250, 500, 1000})
    for (const bool carried_on : {false, true}) levels.push_back({hz, carried_on});
  for (int round = 0; round < (plan.quick ? 7 : 25); ++round)
    for (PoseLevel& level : levels) drive(*states, level);
  for (PoseLevel& level : levels) {
    Level& row = ladder.levels.emplace_back();
    row.name = std::to_string(level.hz) + " Hz, " + (level.carried_on ? "carried on by its rates" : "held");
    row.error = errors_of(std::move(level.differences_deg));
    row.time = times_of(std::move(level.times_ms));
  }
  return ladder;
}

}  // namespace phare::cost
