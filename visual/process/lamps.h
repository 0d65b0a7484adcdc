// The lamps of the rig as they shine now: which sources are lit, their beam images, where they stand in the world.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/rig.h"
#include "config/rig_edit.h"
#include "net/messages.h"
#include "visual/photometry/beam/lamp_tables.h"
#include "visual/photometry/beam/live_beam.h"
#include "visual/photometry/bench/lamp_aim.h"
#include "visual/photometry/bench/table_end.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/photometry/table/opening.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {

/// Functions that the controls light. Off lights nothing; flash adds high beam whatever the switch; high beam keeps low
/// beam where the rig says so; fog needs the position lights at least.
std::set<LampFunction> lit_functions(const CockpitState& controls, bool high_keeps_low);

/// Where a lamp stands on the car, and how it is turned there: R = Rz(yaw)·Ry(-pitch)·Rx(roll).
struct LampMount {
  glm::dvec3 position_m{0.0};                             ///< car frame
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;  ///< positive left, up, right side down

  friend bool operator==(const LampMount&, const LampMount&) = default;
};

/// A lamp as a point of the car or the world sees it, before anything that stands between them.
struct PointLight {
  std::string lamp;
  glm::dvec3 lamp_m{0.0};  ///< world
  bool lit = false;        ///< some source of it is
  double candela = 0.0;    ///< toward the point, all lit sources
  bool resampled = false;  ///< its beam image does not have its tables' nodes
  double surface_lx = 0.0;
  double h_deg = 0.0, v_deg = 0.0;  ///< right, up, from the axis of the first lit source as it is aimed
  bool behind = false;              ///< of every lit source
  bool out_of_table = false;        ///< of every lit source
  glm::vec3 colour{1.0f};           ///< linear sRGB of luminance 1
};

class Lamps {
 public:
  /// Reads every table of every design, and turns every lamp as its `aim` says. A file named twice is read once. Error:
  /// of the first bad file, or a design with more than kMostLampsOfDesign lamps, or a rig without designs.
  static Result<Lamps> load(const Rig& rig);

  /// A beam image that has to go to the renderer's slot `position` now.
  struct Change {
    std::size_t position = 0;
    const BeamImage* image = nullptr;   ///< valid as long as these Lamps
    std::span<const TexelRect> part{};  ///< what of it changed, until the next call; empty: another image than before
  };

  /// Adopts the controls. Sums a beam image again only where a source was switched or dimmed, and reports only slots
  /// whose image changed. A design index past the last means the last.
  std::vector<Change> set_controls(const CockpitState& controls);

  /// The renderer holds no image of these lamps: all are reported again.
  void forget_shown() { std::ranges::fill(shown_, std::nullopt); }

  /// Dims a source, counted from 1 (0: all), of a lamp of the design that shines; acts with the next controls. Error:
  /// no such lamp or source.
  Status dim(const RigControl::Dim& command);

  /// Has the pixel light of a lamp of the design that shines show a picture; acts with the next controls. Error: no
  /// such lamp, none with a pixel light, no readable picture, another size; then it shines on as before.
  Status frame(const RigControl::Frame& command);

  // ---- places and turns (lamp_mounts.cpp): each command that changes one can be taken back

  /// Where the lamps of a design stand and how they are turned there, besides the aim of their sources.
  struct Mounts {
    std::vector<LampMount> lamps;  ///< in the design's order
    double aim_rad = 0.0;          ///< of all lamps, positive up

    friend bool operator==(const Mounts&, const Mounts&) = default;
  };
  /// Of the design that shines, or of another.
  Mounts mounts() const { return mounts(design_); }
  Mounts mounts(std::size_t design) const;
  /// As the rig file has them.
  const Mounts& mounts_of_rig(std::size_t design) const { return of_rig_[design]; }
  /// Takes what another process or an earlier drive had. Error: not so many lamps.
  Status set_mounts(std::size_t design, const Mounts& mounts);
  /// Moves a lamp of the design that shines to another place of the car. Error: no such lamp.
  Status place(const RigControl::Place& command);
  /// Turns a whole lamp of the design that shines: no image is summed for it. Error: no such lamp.
  Status swivel(const RigControl::Swivel& command);

  /// What the control law wants of the lamps of this design, until it says otherwise; acts with the next controls, on
  /// top of commands. Error, and no lamp of the law's is turned or dimmed: no such lamp, another number of sources.
  Status follow(const LawAnswer& answer, std::uint32_t design_index);

  /// All lamps turned up (positive) together, rad.
  void set_aim(double pitch_rad);
  /// One quantity of a lamp, a pair or all lamps. Error: no such lamp or pair, a spacing of one lamp, out of range.
  Status mount(const RigControl::Mount& command);
  /// Takes back so many of the latest changes of the design that shines; how many there were.
  std::size_t undo(std::size_t steps);
  /// How many there are to take back.
  std::size_t undo_steps() const { return before_[design_].size(); }
  /// A lamp, a pair, or all lamps with their aim as the rig file has them. Error: no such lamp.
  Status reset(const std::string& lamp);
  /// The lamp of this name, or both of a pair, the left one first. Error: neither is there.
  Result<std::vector<std::size_t>> slots_of(const std::string& lamp) const;
  /// What the rig file has to say of every lamp that is not as it has it (config/rig_edit.h).
  std::vector<SavedMount> changed_mounts() const;
  /// The rig file says now what holds.
  void mounts_are_saved();

  /// How the sources of a lamp of the design that shines are dimmed, as commanded.
  std::span<const double> dimming_01(std::size_t slot) const { return positions_[design_][slot].dimming_01; }
  /// Of a lamp of the design that shines, as it shines now.
  const BeamImage& image(std::size_t slot) const { return positions_[design_][slot].beam.image(); }
  double aim_rad() const { return aim_pitch_rad_; }

  /// The positions that shine, in the world. The body's rotation is that of `pose`: Rz(yaw)·Ry(pitch)·Rx(roll); what
  /// levelling tilts the lamps by, is in the pose too.
  std::vector<PlacedLamp> placed(const VehicleState& pose) const;

  /// E in lx at a point of the world: float64 from the native tables, no beam image in between. The truth the GPU is
  /// held to.
  double illuminance_lx(const VehicleState& pose, const MeasurePoint& at) const;
  /// The same behind what stands or moves in the world, and what would be there besides without it.
  struct LightAt {
    double lx = 0.0, hidden_lx = 0.0;
    std::string hidden_by{};  ///< what hides most, by its node; empty: nothing does
  };
  LightAt light_at(const VehicleState& pose, const MeasurePoint& at, const World& world) const;
  /// Every lamp of the design at a point of the world: float64 from the native tables.
  std::vector<PointLight> lights_at(const VehicleState& pose, const MeasurePoint& at) const;
  /// Of each lamp of the design no more than this anywhere, cd: of all lit sources, each at its own peak. Looks at
  /// every node of their tables.
  std::vector<double> peaks_cd() const;
  /// The lamps that shine into an eye, the world and the air between them (nothing: clear).
  std::vector<GlaringLamp> glare_at(const VehicleState& pose, const glm::dvec3& eye_m, const World& world,
                                    const Air& air) const;
  /// What one set of functions of one design lights by, with the car's frame for the world: the wall. Not beyond the
  /// next change of these lamps. `tilt_rad`: of automatic levelling, positive up.
  std::vector<PlacedSource> sources_in_car(std::size_t design, const std::set<LampFunction>& lit,
                                           double tilt_rad = 0.0) const;

  /// Height of the low beam's cut-off, the mean of its lamps, above the car's ground on an upright wall `wall_m` ahead
  /// of them: with mounts, levelling and the body's pitch (lamp_cutoff.cpp). Nothing: low beam is dark, or has no
  /// cut-off.
  std::optional<double> cutoff_height_m(const VehicleState& pose, double wall_m) const;
  /// Of every design, on all processors: a lamp takes a tenth of a second, which a drive has no room for.
  void find_cutoffs() const { find_cutoffs(0, designs_.size()); }
  std::uint64_t cutoff_searches() const { return cutoff_searches_; }  ///< in the light of so many lamps

  /// Mean colour of the light of all sources that shine, weighted by flux, linear sRGB of luminance 1; nothing when all
  /// are dark.
  std::optional<glm::vec3> light() const;

  const std::vector<DesignConfig>& designs() const { return designs_; }
  const DesignConfig& design() const { return designs_[design_]; }
  std::size_t design_index() const { return design_; }
  const std::string& lit_text() const { return lit_text_; }  ///< "low high", for labels
  void begin_counting() { compositions_ = uploads_ = 0; }
  std::uint64_t compositions() const { return compositions_; }  ///< images that were summed, wholly or in part
  std::uint64_t summed_texels() const;
  std::uint64_t uploads() const { return uploads_; }
  std::uint64_t resampled_images() const;
  struct TableInfo {
    std::string name, content_hash;
    double peak_cd = 0.0, flux_lm = 0.0;
    std::vector<std::string> notes;
    std::string opening;  ///< its size, and whence
    std::string reading;  ///< how the file was read, where a rig says more than its name: "emitter 2, mirrored"
  };
  std::vector<TableInfo> tables() const;
  /// What came of every `aim` of the rig.
  const std::vector<LampAiming>& aimings() const { return aimings_; }
  /// Where the tables end on the road, in the rig's pictures.
  const std::vector<SourceEnd>& table_ends() const { return table_ends_; }
  /// The same for the overlay: one line for each that is lit now.
  std::vector<std::string> lit_table_ends() const;

 private:
  void find_cutoffs(std::size_t first_design, std::size_t count) const;
  /// Of one lamp of the design as it shines; the point in the car's frame.
  double lamp_lx(std::size_t slot, const MeasurePoint& at, double tilt_rad) const;
  void add_sources(std::vector<PlacedSource>& sources, std::size_t design, std::size_t slot,
                   const std::set<LampFunction>& lit, double tilt_rad) const;
  /// One lamp of a design as it is now.
  struct Position {
    LiveBeam beam;
    std::vector<double> dimming_01;  ///< of each source, as commanded
    LampMount mount;
    LampOpening opening{};           ///< the largest that the files of its sources state
    std::vector<double> law_01{};  ///< of each source, as the control law says; empty: full light
    double law_yaw_rad = 0.0, law_pitch_rad = 0.0;
    std::shared_ptr<PixelLight> pixels{};  ///< its own, once it was given a picture
    std::size_t pixel_source = 0;

    double dimmed_01(std::size_t source) const { return dimming_01[source] * (law_01.empty() ? 1.0 : law_01[source]); }
  };
  std::string text_of_lit() const;
  /// Before a change of mounts: what undo goes back to. `of`: changes of one name in a row are one step; empty: never.
  void remember(const std::string& of = {});
  Status show(std::size_t design, std::size_t slot, const std::string& file);
  /// A source as it is aimed, with the table it has now.
  AimedSource aimed(std::size_t design, std::size_t slot, std::size_t source) const;
  Result<std::size_t> find(const std::string& lamp, std::size_t design) const;
  Result<std::size_t> find(const std::string& lamp) const { return find(lamp, design_); }
  /// All that turns a lamp besides the aim of its sources; `tilt_rad`: of the car's levelling.
  glm::dmat3 turned(const Position& position, double tilt_rad) const;

  std::vector<DesignConfig> designs_;
  bool high_keeps_low_ = true;
  LampTables tables_;
  std::vector<LampAiming> aimings_;
  std::vector<SourceEnd> table_ends_;
  /// [design][lamp], of the low beam as mounted in the rig; found when first asked for.
  mutable std::map<std::size_t, std::vector<std::optional<double>>> cutoffs_deg_;
  mutable std::uint64_t cutoff_searches_ = 0;
  std::vector<std::vector<Position>> positions_;   ///< [design][lamp]
  std::vector<std::optional<std::size_t>> shown_;  ///< per slot, the design whose image it holds
  std::vector<Mounts> of_rig_;                     ///< of each design
  std::vector<std::vector<Mounts>> before_;        ///< of each design, the latest last
  std::string remembered_;                         ///< what the latest of them is of
  std::set<LampFunction> lit_;
  std::size_t design_ = 0;
  double aim_pitch_rad_ = 0.0;    // of the program's aim command
  double wheel_pitch_rad_ = 0.0;  // of the driver's aim wheel
  double law_pitch_rad_ = 0.0;    // of the control law's levelling
  std::string lit_text_;
  std::uint64_t compositions_ = 0;
  std::uint64_t uploads_ = 0;
};

}  // namespace phare
