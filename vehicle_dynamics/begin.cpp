#include "vehicle_dynamics/begin.h"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <utility>

#include "config/road/lane.h"
#include "net/drive_file.h"
#include "vehicle_dynamics/start_pose.h"

namespace phare {

Result<Begin> begin_of(const Rig& rig, const BeginOptions& options) {
  const std::string named = options.level.empty() ? rig.dynamics_level : options.level;
  const Result<Level> level = parse_level(named, options.level.empty() ? rig.file.string() : "--level");
  if (!level) return level.error();
  Begin begin;
  begin.setup.level = *level;
  begin.setup.step.ns = static_cast<std::int64_t>(rig.dynamics_step_s * 1e9 + 0.5);
  if (begin.setup.step.ns <= 0) return Error{rig.file.string(), "the step of the dynamics is not positive"};

  if (!options.drive_file.empty()) {
    const Result<Drive> drive = read_drive(options.drive_file);
    if (!drive) return drive.error();
    begin.setup.track = PoseTrack::from_drive(drive->datagrams);
    if (drive->cut) spdlog::warn("{}: cut off, read up to its last whole record", options.drive_file);
  }
  if (*level == Level::kPose) {
    if (options.drive_file.empty()) return Error{"--level", "pose replays a drive: give --drive FILE"};
    if (begin.setup.track.empty()) return Error{options.drive_file, "holds no VehicleState to replay"};
    const Conditions& c = options.conditions;
    if (c.friction || !c.roughness.empty() || !c.csv_file.empty())
      return Error{c.friction             ? "--friction"
                   : !c.roughness.empty() ? "--roughness"
                                          : "--road",
                   "means nothing to recorded poses, which level pose replays"};
    return begin;
  }

  Result<VehicleParams> vehicle = read_vehicle(rig.vehicle_file);
  if (!vehicle) return vehicle.error();
  begin.setup.vehicle = std::move(*vehicle);
  begin.setup.levelling = options.levelling.value_or(levelling::kind_of(begin.setup.vehicle.levelling.system));
  if (begin.setup.levelling == levelling::Kind::kManual)
    return Error{"--levelling", "manual: the cockpit's wheel turns the lamps of a live run"};
  if (begin.setup.levelling != levelling::Kind::kNone && begin.setup.vehicle.levelling.lamp_height_m <= 0.0)
    return Error{rig.vehicle_file.string(), "has no table [levelling]: there are no lamps to level"};
  if (*level != Level::kKinematic) {
    Result<SprungParams> sprung = SprungParams::of(begin.setup.vehicle, rig.vehicle_file.string());
    if (!sprung) return sprung.error();
    begin.setup.sprung = std::move(*sprung);
  }
  if (!rig.scene_file.empty()) {
    Result<RoadSurface> road = RoadSurface::read(rig.scene_file);
    if (!road) return road.error();
    begin.setup.road = std::move(*road);
  }

  if (const Status laid = lay(options.conditions, rig.scene_file, begin.setup.on_top); !laid) return laid.error();
  const std::string said = text(begin.setup.on_top);
  if (!said.empty()) spdlog::info("road: {}", said);
  if (!said.empty() && *level == Level::kKinematic)
    spdlog::warn(
        "level kinematic has no tyres: friction changes nothing, and roughness its plane only; --level auto does");

  if (!begin.setup.track.empty()) {
    begin.state = from_message(begin.setup.track.at(begin.setup.track.begin()), begin.setup.vehicle.wheelbase_m,
                               begin.setup.vehicle.track_m, begin.setup.vehicle.rest);
    return begin;
  }
  if (const auto lane = lane_file_of(rig.scene_file); std::filesystem::exists(lane)) {
    Result<CarState> start = start_of_lane(lane);
    if (!start) return start.error();
    begin.state = *start;
  } else {
    spdlog::info("no lane file {}; the car starts at the origin", lane.string());
  }
  const std::string nowhere =
      rig.scene_file.empty() ? "" : no_ground_below(begin.setup.road, begin.state.x_m, begin.state.y_m);
  if (!nowhere.empty()) spdlog::warn("{}: {}", rig.scene_file.string(), nowhere);
  return begin;
}

}  // namespace phare
