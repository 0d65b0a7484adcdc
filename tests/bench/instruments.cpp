#include "tests/bench/instruments.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "config/base/paths.h"
#include "config/rig.h"
#include "config/road/lane.h"
#include "visual/process/cameras.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/picture_instruments.h"
#include "visual/process/props.h"
#include "visual/process/versus.h"

namespace phare::bench {
namespace {

template <typename Value>
Value value_of(Result<Value> read) {
  if (!read) throw std::runtime_error(read.error().text());
  return std::move(*read);
}

CockpitState low_beam() {
  CockpitState controls;
  controls.light_switch = LightSwitch::kLow;
  return controls;
}

}  // namespace

struct Instruments::Parts {
  Rig rig = value_of(read_rig(config_dir() / "rigs/country_road.toml"));
  Lamps lamps = value_of(Lamps::load(rig));
  Scene scene = value_of(read_scene(rig.scene_file));
  Movers movers = value_of(Movers::read());
  Props props = value_of(Props::of(movers));
  std::vector<LanePoint> lane = value_of(read_lane(lane_file_of(rig.scene_file)));
  Desk desk;
  World world{scene, movers.meshes()};
  PictureInstruments measuring{desk, lamps, world, RoadLine(lane, rig.scene_file), ProbeLog()};
  Versus versus;

  /// A car that drives along the lane, 0.1 m a round.
  VehicleState car(int round) const {
    const double s_m = 150.0 + 0.1 * (round % 64);
    const RoadLine& road = measuring.road();
    const glm::dvec3 here = road.at({s_m, 0.0}).position_m, on = road.at({s_m + 1.0, 0.0}).position_m;
    VehicleState car;
    car.x_m = here.x, car.y_m = here.y, car.z_m = here.z;
    car.yaw_rad = std::atan2(on.y - here.y, on.x - here.x);
    car.pitch_rad = -std::atan(on.z - here.z);
    return car;
  }

  /// A frame as the visual process puts it together, by what a desk has.
  FrameInput frame(const Desk& wanted, int round) {
    desk = wanted;
    const VehicleState pose = car(round);
    const ChannelConfig& channel = rig.channels[0];
    FrameInput input;
    set_by_desk(input, desk);
    const CameraEye eye = first_eye(desk), second = eye_named(desk, desk.second_camera);
    input.camera = camera_of(eye, seen_by(eye, channel, lamps, pose, &measuring.road()));
    input.lamps = lamps.placed(pose);
    if (desk.mirrors) input.more_views = mirror_views(input, channel, pose);
    lay_out(input, desk.layout, camera_of(second, seen_by(second, channel, lamps, pose)), desk.second_camera);
    props.add_to(input, eye.kind, lamps, pose, false, world);
    if (desk.layout != Layout::kFull) props.add_to(input.more_views.back(), second.kind, lamps, pose, false, world);
    const bool wall = desk.camera == CameraKind::kWall;
    measuring.see({.time = SimTime{round * 16'666'667LL},
                   .car = pose,
                   .picture = &input,
                   .aspect = 16.0 / 9.0,
                   .wall = wall ? std::optional(wall_before(lamps, pose)) : std::nullopt});
    input.marks = measuring.marks(round % 6 == 0);  // as in a drive: isolux lines are found ten times a second
    if (round % 6 == 0) input.overlay = measuring.lines();
    (void)versus.follow(desk, lamps, low_beam());
    if (versus.lamps() != nullptr) versus.show(input, desk.compare, pose, {}, {});
    return input;
  }
};

Instruments::Instruments() : parts_(std::make_unique<Parts>()) {}
Instruments::~Instruments() = default;

void Instruments::load_into(Renderer& renderer) {
  if (const Status loaded = renderer.load_scene(parts_->scene, parts_->movers.meshes()); !loaded)
    throw std::runtime_error(loaded.error().text());
  const auto upload = [&](const std::vector<Lamps::Change>& changes) {
    for (const Lamps::Change& change : changes) renderer.set_beam(change.position, *change.image);
  };
  upload(parts_->lamps.set_controls(low_beam()));
  Desk compared;
  compared.compare = Compare::kSplit;
  upload(parts_->versus.follow(compared, parts_->lamps, low_beam()));
}

void Instruments::add_to(const std::function<void(const std::string& name, const View& view)>& add) {
  struct Case {
    const char* name;
    std::vector<const char*> words;
  };
  const Case cases[] = {
      {"none", {}},
      {"false colour, with its scale", {"view false-colour"}},
      {"clipping", {"view clipping"}},
      {"grid", {"grid_m 10"}},
      {"isolux lines", {"road_isolux on"}},
      {"reach", {"reach on"}},
      {"a point, lamp by lamp", {"point car 30 0 0"}},
      {"plot of four probes", {"plot on", "probes car 20 0 0; car 40 -1.75 0; car 40 1.75 0; road 300 0"}},
      {"mirrors", {"mirrors on"}},
      {"camera chase, with the car", {"camera chase"}},
      {"camera wall", {"camera wall"}},
      {"second camera in a corner", {"layout inset"}},
      {"two cameras in halves", {"layout split"}},
      {"two designs in halves", {"compare split"}},
      {"two designs by difference", {"compare difference"}},
      {"two designs by ratio", {"compare ratio"}}};
  for (const Case& one : cases) {
    Desk desk;
    for (const char* words : one.words)
      if (const auto done = apply(desk, desk_command(words), {.designs = 2}); !done)
        throw std::runtime_error(done.error().text());
    add(one.name, [this, desk](int round) { return parts_->frame(desk, round); });
  }
  Desk desk;
  desk.mirrors = true;
  add("mirrors, each a quarter of the pixels", [this, desk](int round) {
    FrameInput input = parts_->frame(desk, round);
    for (ViewInput& mirror : input.more_views) mirror.part = {}, mirror.own_picture = PictureSize{640, 360};
    return input;
  });
}

}  // namespace phare::bench
