// Other road users in the picture: their bodies, their lamps and what these throw into the driver's eye. Where they are
// is a function of simulated time (config/traffic/road_users.h), on the road that is drawn.
//
// A car's or lorry's headlamps are two, a motorcycle's or bicycle's one, with the tables of the files that it names,
// else those that the scene's own sample car has (a bicycle: generated/lamps/bicycle.ies): low beam, and high beam
// added to it where it is on, aimed down as kPlaces has it. Tail lamps, and the brake lamps of who brakes
// (config/traffic/road_users.h), are points that light nothing but spray: of the files that it names, else of
// kTailLamp_cd and kBrakeLamp_cd. Both of a side stand in one place and add up; a car has a third brake lamp above
// them, which does not light spray. Each lamp has the colour that it is given. Bodies cast shadows and hide lamps, but
// not those that they carry. Left out: a tail lamp's share that goes out as it brakes. Checked by
// tests/visual_process/traffic_test.cpp and traffic_lamps_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "config/traffic/road_users.h"
#include "visual/photometry/table/glare.h"
#include "visual/photometry/table/intensity_table.h"
#include "visual/process/lamps.h"
#include "visual/process/movers.h"
#include "visual/process/road_line.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {

/// What a driver's eye is adapted to, for threshold increment and de Boer's figure: chosen, about what the road 30 m
/// ahead has under a low beam (0.8 cd/m², docs/light.md).
inline constexpr double kAdaptation_cdm2 = 1.0;
/// Rear position lamps: 4 to 17 cd along the axis (UN R148, R1); chosen in the middle.
inline constexpr double kTailLamp_cd = 8.0;
/// Stop lamps: 60 to 260 cd along the axis (UN R148, S1); chosen in the middle, as many times the least as the most is
/// of it. Unconfirmed, as the tail lamps' figures: by memory of the rule.
inline constexpr double kBrakeLamp_cd = 125.0;
/// A car's third stop lamp: 25 to 110 cd along the axis (UN R148, S3); chosen and unconfirmed likewise.
inline constexpr double kThirdBrakeLamp_cd = 52.0;
/// White of a headlamp whose colour is not said: a halogen bulb's, and of a bicycle a white LED's (chosen).
inline constexpr double kHalogen_k = 3200.0, kBicycleLamp_k = 5000.0;

/// Light that goes one way, of one lamp or of several in one place.
struct LampShine {
  double cd = 0.0;
  glm::vec3 colour = kSignalRed;  ///< linear sRGB, luminance 1; of no light whatever it was
  void add(double more_cd, const glm::vec3& of_colour);
};

/// A lamp at a back. nullptr: the constant of what it is for, by the cosine.
struct RearLamp {
  const IntensityTable* table = nullptr;  ///< its x points backward
  glm::vec3 colour = kSignalRed;
};

/// What burns at a back, of each lamp there.
struct RearLight {
  bool tail_on = true, brake_on = false;
  RearLamp tail{}, brake{}, third_brake{};
  /// Toward `direction` (unit, in the vehicle's frame), tail and brake lamp of one side together.
  LampShine toward(const glm::dvec3& direction) const;
  LampShine third_toward(const glm::dvec3& direction) const;
};

class Traffic {
 public:
  /// Where the beams of their headlamps begin among the renderer's: behind those of two designs.
  static constexpr std::size_t kBeam = 2 * kMostLampsOfDesign;
  static bool is_theirs(const PlacedLamp& lamp) { return lamp.beam >= kBeam; }

  Traffic() = default;
  Traffic(Traffic&&) = default;  // not to be copied: what There has points into it
  Traffic& operator=(Traffic&&) = default;
  /// Reads road users and their lamps; `movers` has their meshes. Empty file name: no traffic, and nothing is read.
  /// Error, too: no lane.
  static Result<Traffic> read(const std::filesystem::path& file, const std::vector<LanePoint>& lane,
                              const Movers& movers);

  bool empty() const { return users_.empty(); }
  std::size_t beams() const { return headlamps_.size(); }  ///< different ones; the first is the sample car's low beam
  BeamImage beam(std::size_t number) const;                ///< for Renderer::set_beam(kBeam + number)
  /// Where in the renderer the beams lie that a warm-up draws: of all that shine one for each colour, and one of
  /// several colours, which take pipelines of their own; kBeam stands for all of kHalogen_k. At least one.
  std::vector<std::size_t> beams_to_meet() const;

  /// One of them where it is now.
  struct There {
    RoadUserClass kind = RoadUserClass::car;
    glm::dvec3 position_m{0.0};       ///< of its middle, on the road
    glm::dmat3 world_from_user{1.0};  ///< columns: forward, left, up of the road there
    bool lights = true;
    std::size_t number = 0;  ///< among those of the file
    double speed_mps = 0.0;
    std::size_t beam = 0;  ///< of its headlamps, among beams()
    RearLight rear{};      ///< its tables are the Traffic's
  };
  std::vector<There> at(double time_s, const RoadLine& road) const;

  std::vector<PlacedMesh> placed_meshes(std::span<const There> users) const;
  /// One of each kind that the file has, all at one place: what a warm-up draws.
  std::vector<PlacedMesh> one_of_each(const glm::dvec3& place_m) const;
  /// Those that throw up spray where the ground is wet: with motors, and fast enough. `users`: at `time_s`.
  std::vector<SprayingVehicle> spraying(std::span<const There> users, double time_s, const RoadLine& road) const;
  /// Headlamps that light the scene: those of the nearest, kMostLamps in all, so that with a car's own two none is
  /// lit by block (visual/lit_scene.h) and every pipeline is made before the drive; with front fog lamps besides they
  /// are made in it, beside the frames (loop_lamps.cpp). Who is behind
  /// `eye_m` lights nothing that is seen along `ahead`: most of a follower's light falls on the car, which has no body.
  /// All others only glare. `toward_first`: those come first who shine toward the eye, as on wet ground and in air that
  /// is not clear, for what shows most of them there is their light in the mirror and in the air.
  static constexpr std::size_t kMostLamps = 2;
  static std::vector<PlacedLamp> placed_lamps(std::span<const There> users, const glm::dvec3& eye_m,
                                              const glm::dvec3& ahead, bool toward_first = false);
  /// Where their drivers' eyes are, looking along their way; of those who come toward us, lit or not: nobody
  /// else counts as glared at.
  struct Eye {
    std::size_t user = 0;  ///< whose it is
    MeasurePoint at{};
  };
  static std::vector<Eye> oncoming_eyes(std::span<const There> users, const glm::dvec3& heading);
  /// Lamps that shine into an eye, the world and the air between them. `world`: with all of them in it, as
  /// placed_meshes() has them; the body that carries a lamp does not hide it.
  std::vector<GlaringLamp> glare_at(std::span<const There> users, const glm::dvec3& eye_m, const World& world,
                                    const Air& air) const;

 private:
  /// What one headlamp shines by: the table of its low beam, and of its high beam where that is on.
  struct Headlamp {
    std::vector<RoadUserLamp> lamps{};     ///< with file and colour
    std::vector<IntensityTable> tables{};  ///< of each
    LampShine toward(const glm::dvec3& direction) const;
  };
  /// Where it is among headlamps_; reads what is not there yet.
  Result<std::size_t> headlamp(std::vector<RoadUserLamp> lamps);
  /// Reads what is not there yet.
  Result<RearLamp> rear_lamp(const RoadUserLamp& lamp);

  std::optional<There> there_at(std::size_t number, double time_s, const RoadLine& road) const;

  std::vector<RoadUser> users_;
  std::optional<LaneLine> lane_;
  std::vector<std::size_t> mesh_of_kind_;
  std::vector<Headlamp> headlamps_;
  std::vector<std::size_t> headlamp_of_user_;
  std::map<std::filesystem::path, IntensityTable> rear_lamps_;  // their places stay as others come, and as it is moved
  std::vector<RearLight> rear_of_user_;                         // with what burns left open
};

/// Lamps at the back of a road user that stands there, as they shine into an eye; hidden by what is in `around`.
std::vector<GlaringLamp> rear_lamps_into(RoadUserClass kind, const RearLight& light, const glm::dvec3& position_m,
                                         const glm::dmat3& world_from_user, const glm::dvec3& eye_m,
                                         const World& around, const Air& air);

/// What lamps do to the eyes of a driver who looks along `ahead` (unit): lux across that line, veil, threshold
/// increment, de Boer (visual/photometry/table/glare.h).
Glare glare_figures(std::span<const GlaringLamp> lamps, const glm::dvec3& eye_m, const glm::dvec3& ahead,
                    const Viewer& viewer);

/// What our lamps do to the drivers whose eyes these are, as glare_figures() has it, the world and the air between: the
/// figures of the one eye that gets the most lux. A driver looks straight along his way, out of a body as if of glass;
/// he is adapted as ours is, and `viewer` is he, too: nobody says how old he is.
Glare glare_at_oncoming_eyes(const Lamps& lamps, const VehicleState& car, std::span<const Traffic::Eye> eyes,
                             const World& world, const Air& air, const Viewer& viewer);

}  // namespace phare
