#include "visual/process/lamps.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "config/base/conventions.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

glm::dvec3 position_of(const VehicleState& pose) {
  return {pose.x_m, pose.y_m, pose.z_m};
}
glm::dmat3 rotation_of(const VehicleState& pose) {
  return world_from_car(pose.roll_rad, pose.pitch_rad, pose.yaw_rad);
}

/// A headlamp stands at the edge of the bonnet, which hides from the driver what it lights within some decimetres: a
/// glaring spot in fog, where the picture shows no bonnet. Chosen.
constexpr double kBodyAboutLamp_m = 0.6;

}  // namespace

std::set<LampFunction> lit_functions(const CockpitState& controls, bool high_keeps_low) {
  std::set<LampFunction> lit;
  if (controls.light_switch >= LightSwitch::kPosition) {
    lit.insert(LampFunction::kPosition);
    if (controls.fog_front) lit.insert(LampFunction::kFog);
  }
  const bool high = controls.light_switch == LightSwitch::kHigh || controls.flash;
  if (controls.light_switch >= LightSwitch::kLow && (!high || high_keeps_low)) lit.insert(LampFunction::kLow);
  if (high) lit.insert(LampFunction::kHigh);
  return lit;
}

Result<Lamps> Lamps::load(const Rig& rig) {
  Lamps lamps;
  lamps.designs_ = rig.designs;
  lamps.high_keeps_low_ = rig.high_keeps_low;
  if (rig.designs.empty()) return Error{rig.file.string(), "the rig has no lamp design"};
  std::size_t most_positions = 0;
  for (const DesignConfig& design : rig.designs) {
    if (design.lamps.size() > kMostLampsOfDesign) {
      return Error{rig.file.string(), "design '" + design.name + "' has " + std::to_string(design.lamps.size()) +
                                          " lamp positions, at most " + std::to_string(kMostLampsOfDesign) +
                                          " are drawn"};
    }
    most_positions = std::max(most_positions, design.lamps.size());
    for (const LampConfig& lamp : design.lamps) {
      for (const SourceConfig& source : lamp.sources) {
        if (const Status read = lamps.tables_.add(source); !read) return read.error();
      }
    }
  }
  lamps.tables_.close();
  lamps.aimings_ = aim_lamps(lamps.designs_, lamps.tables_);
  lamps.table_ends_ = phare::table_ends(lamps.designs_, lamps.tables_, rig.channels);
  for (const DesignConfig& design : lamps.designs_) {
    std::vector<Position>& positions = lamps.positions_.emplace_back();
    for (const LampConfig& lamp : design.lamps) {
      std::vector<AimedSource> sources;
      std::optional<LampOpening> largest;
      for (const SourceConfig& source : lamp.sources) {
        sources.push_back(lamps.tables_.aimed(source));
        const std::optional<LampOpening> stated = stated_opening(*sources.back().table);
        if (stated && (!largest || stated->width_m * stated->height_m > largest->width_m * largest->height_m))
          largest = stated;
      }
      positions.push_back({LiveBeam(std::move(sources)),
                           std::vector<double>(lamp.sources.size(), 1.0),
                           {.position_m = lamp.position_m},
                           largest.value_or(LampOpening{})});
    }
  }
  lamps.shown_.resize(most_positions);
  lamps.before_.resize(lamps.designs_.size());
  for (std::size_t design = 0; design < lamps.designs_.size(); ++design) lamps.of_rig_.push_back(lamps.mounts(design));
  return lamps;
}

std::vector<Lamps::Change> Lamps::set_controls(const CockpitState& controls) {
  design_ = std::min<std::size_t>(controls.design_index, designs_.size() - 1);
  lit_ = lit_functions(controls, high_keeps_low_);
  wheel_pitch_rad_ = controls.lamp_aim_rad;
  lit_text_ = text_of_lit();

  std::vector<Change> changes;
  for (std::size_t slot = 0; slot < positions_[design_].size(); ++slot) {
    Position& position = positions_[design_][slot];
    const std::vector<SourceConfig>& sources = designs_[design_].lamps[slot].sources;
    for (std::size_t k = 0; k < sources.size(); ++k)
      position.beam.set_dimming(k, lit_.contains(sources[k].function) ? position.dimmed_01(k) : 0.0);
    const LiveBeam::Change change = position.beam.update();
    const BeamImage& image = position.beam.image();
    if (!position.beam.changed().empty()) ++compositions_;
    if (image.dark) continue;  // not drawn, so nothing to upload
    const bool another = shown_[slot] != design_ || change == LiveBeam::Change::kWhole;
    if (!another && position.beam.changed().empty()) continue;
    shown_[slot] = design_;
    changes.push_back({slot, &image, another ? std::span<const TexelRect>{} : position.beam.changed()});
    ++uploads_;
  }
  return changes;
}

Result<std::size_t> Lamps::find(const std::string& lamp, std::size_t design) const {
  std::string names;
  for (std::size_t slot = 0; slot < designs_[design].lamps.size(); ++slot) {
    const std::string& name = designs_[design].lamps[slot].name;
    if (name == lamp) return slot;
    names += (names.empty() ? "" : ", ") + name;
  }
  return Error{"lamp \"" + lamp + "\"", "design \"" + designs_[design].name + "\" has " + names};
}

Status Lamps::dim(const RigControl::Dim& command) {
  const Result<std::size_t> slot = find(command.lamp, design_);
  if (!slot) return slot.error();
  std::vector<double>& dimming_01 = positions_[design_][*slot].dimming_01;
  if (command.source > dimming_01.size())
    return Error{"lamp \"" + command.lamp + "\"",
                 "has " + std::to_string(dimming_01.size()) + " sources, no number " + std::to_string(command.source)};
  if (command.source == 0)
    std::ranges::fill(dimming_01, command.dimming_01);
  else
    dimming_01[command.source - 1] = command.dimming_01;
  return Done{};
}

Status Lamps::frame(const RigControl::Frame& command) {
  const Result<std::size_t> slot = find(command.lamp, design_);
  if (!slot) return slot.error();
  return show(design_, *slot, command.file);
}

Status Lamps::show(std::size_t design, std::size_t slot, const std::string& file) {
  const LampConfig& lamp = designs_[design].lamps[slot];
  Position& position = positions_[design][slot];
  if (!position.pixels) {
    const auto found = std::ranges::find_if(lamp.sources, [](const SourceConfig& s) { return !s.pixels.empty(); });
    if (found == lamp.sources.end())
      return Error{"lamp \"" + lamp.name + "\"", "has no pixel light (\"pixels\" of a source in the rig file)"};
    position.pixel_source = static_cast<std::size_t>(found - lamp.sources.begin());
  }
  const Result<PixelFrame> picture = read_pixel_frame(file);
  if (!picture) return picture.error();
  const SourceConfig& source = lamp.sources[position.pixel_source];
  const PixelLight& raster = position.pixels ? *position.pixels : *tables_.pixel_light(source);
  if (picture->columns != raster.columns() || picture->rows != raster.rows())
    return Error{file, std::to_string(picture->columns) + " × " + std::to_string(picture->rows) +
                           " pixels; the light of lamp \"" + lamp.name + "\" has " + std::to_string(raster.columns()) +
                           " × " + std::to_string(raster.rows())};
  if (!position.pixels) {
    position.pixels = std::make_shared<PixelLight>(raster);
    position.beam.set_table(position.pixel_source, position.pixels->table());
  }
  const std::vector<TexelRect> changed = position.pixels->show(*picture);
  position.beam.table_changed(position.pixel_source, changed, position.pixels->flux_lm());
  return Done{};
}

AimedSource Lamps::aimed(std::size_t design, std::size_t slot, std::size_t source) const {
  const Position& position = positions_[design][slot];
  AimedSource light = tables_.aimed(designs_[design].lamps[slot].sources[source]);
  if (position.pixels && source == position.pixel_source) light.table = &position.pixels->table();
  return light;
}

Status Lamps::follow(const LawAnswer& answer, std::uint32_t design_index) {
  law_pitch_rad_ = 0.0;
  for (std::vector<Position>& design : positions_) {
    for (Position& position : design) {
      position.law_01.clear();
      position.law_yaw_rad = position.law_pitch_rad = 0.0;
    }
  }
  const std::size_t design = std::min<std::size_t>(design_index, designs_.size() - 1);
  std::vector<std::size_t> slots;
  for (const LampLight& light : answer.lamps) {
    const Result<std::size_t> slot = find(light.lamp, design);
    if (!slot) return slot.error();
    const std::size_t given = light.dimming_01.size(), sources = positions_[design][*slot].dimming_01.size();
    if (given > 1 && given != sources)
      return Error{"lamp \"" + light.lamp + "\"",
                   "has " + std::to_string(sources) + " sources, not " + std::to_string(given)};
    slots.push_back(*slot);
    if (light.frame.empty()) continue;
    if (const Status shown = show(design, *slot, light.frame); !shown) return shown.error();
  }
  law_pitch_rad_ = answer.levelling_rad;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const LampLight& light = answer.lamps[i];
    Position& position = positions_[design][slots[i]];
    position.law_yaw_rad = light.yaw_rad;
    position.law_pitch_rad = light.pitch_rad;
    position.law_01 = light.dimming_01;
    if (light.dimming_01.size() == 1) position.law_01.assign(position.dimming_01.size(), light.dimming_01[0]);
  }
  return Done{};
}

glm::dmat3 Lamps::turned(const Position& position, double tilt_rad) const {
  const LampMount& mount = position.mount;
  const double up_rad =
      aim_pitch_rad_ + wheel_pitch_rad_ + law_pitch_rad_ + tilt_rad + mount.pitch_rad + position.law_pitch_rad;
  return aim_rotation(mount.yaw_rad + position.law_yaw_rad, up_rad, mount.roll_rad);
}

std::vector<PlacedLamp> Lamps::placed(const VehicleState& pose) const {
  const glm::dmat3 rotation = rotation_of(pose);
  std::vector<PlacedLamp> placed;
  for (std::size_t slot = 0; slot < positions_[design_].size(); ++slot) {
    const Position& position = positions_[design_][slot];
    const BeamImage& image = position.beam.image();
    if (image.dark) continue;
    placed.push_back({position_of(pose) + rotation * position.mount.position_m,
                      rotation * turned(position, pose.lamp_tilt_rad) * image.car_from_image, slot});
    placed.back().opening = position.opening;
    placed.back().body_m = kBodyAboutLamp_m;
  }
  return placed;
}

double Lamps::illuminance_lx(const VehicleState& pose, const MeasurePoint& at) const {
  const glm::dmat3 car_from_world = glm::transpose(rotation_of(pose));
  const MeasurePoint in_car{car_from_world * (at.position_m - position_of(pose)), car_from_world * at.normal};
  return phare::illuminance_lx(sources_in_car(design_, lit_, pose.lamp_tilt_rad), in_car.position_m, in_car.normal);
}

void Lamps::add_sources(std::vector<PlacedSource>& sources, std::size_t design, std::size_t slot,
                        const std::set<LampFunction>& lit, double tilt_rad) const {
  const LampConfig& lamp = designs_[design].lamps[slot];
  const Position& position = positions_[design][slot];
  const glm::dmat3 turn = turned(position, tilt_rad);
  for (std::size_t k = 0; k < lamp.sources.size(); ++k) {
    if (!lit.contains(lamp.sources[k].function)) continue;
    const AimedSource light = aimed(design, slot, k);
    sources.push_back({.table = light.table,
                       .position_m = position.mount.position_m,
                       .world_from_lamp = turn * light.car_from_lamp,
                       .scale = light.scale * position.dimmed_01(k),
                       .lamp = slot});
  }
}

std::vector<PlacedSource> Lamps::sources_in_car(std::size_t design, const std::set<LampFunction>& lit,
                                                double tilt_rad) const {
  std::vector<PlacedSource> sources;
  for (std::size_t slot = 0; slot < designs_[design].lamps.size(); ++slot)
    add_sources(sources, design, slot, lit, tilt_rad);
  return sources;
}

double Lamps::lamp_lx(std::size_t slot, const MeasurePoint& at, double tilt_rad) const {
  std::vector<PlacedSource> sources;
  add_sources(sources, design_, slot, lit_, tilt_rad);
  return phare::illuminance_lx(sources, at.position_m, at.normal);
}

Lamps::LightAt Lamps::light_at(const VehicleState& pose, const MeasurePoint& at, const World& world) const {
  const glm::dmat3 world_from_car = rotation_of(pose), car_from_world = glm::transpose(world_from_car);
  const MeasurePoint in_car{car_from_world * (at.position_m - position_of(pose)), car_from_world * at.normal};
  LightAt light;
  double most_lx = 0.0;
  for (std::size_t slot = 0; slot < designs_[design_].lamps.size(); ++slot) {
    const double lx = lamp_lx(slot, in_car, pose.lamp_tilt_rad);
    if (lx <= 0.0) continue;
    const glm::dvec3 lamp_m = position_of(pose) + world_from_car * positions_[design_][slot].mount.position_m;
    const SceneChunk* by = occluder(world, lamp_m, at.position_m);
    (by ? light.hidden_lx : light.lx) += lx;
    if (!by || lx <= most_lx) continue;
    most_lx = lx;
    light.hidden_by = name_of(*by);
  }
  return light;
}

std::vector<GlaringLamp> Lamps::glare_at(const VehicleState& pose, const glm::dvec3& eye_m, const World& world,
                                         const Air& air) const {
  std::vector<GlaringLamp> sources;
  for (const PointLight& light : lights_at(pose, {.position_m = eye_m})) {
    if (light.candela <= 0.0 || light.lamp_m == eye_m || occluder(world, light.lamp_m, eye_m)) continue;
    sources.push_back(glaring_lamp(light.lamp_m, light.candela, light.colour, eye_m, air));
  }
  return sources;
}

std::vector<PointLight> Lamps::lights_at(const VehicleState& pose, const MeasurePoint& at) const {
  const glm::dmat3 world_from_car = rotation_of(pose), car_from_world = glm::transpose(world_from_car);
  const MeasurePoint in_car{car_from_world * (at.position_m - position_of(pose)), car_from_world * at.normal};
  std::vector<PointLight> lights;
  for (std::size_t slot = 0; slot < designs_[design_].lamps.size(); ++slot) {
    const LampConfig& lamp = designs_[design_].lamps[slot];
    const Position& position = positions_[design_][slot];
    const glm::dmat3 turn = turned(position, pose.lamp_tilt_rad);
    const glm::dvec3 way = in_car.position_m - position.mount.position_m;
    PointLight light;
    light.lamp = lamp.name;
    light.lamp_m = position_of(pose) + world_from_car * position.mount.position_m;
    light.surface_lx = lamp_lx(slot, in_car, pose.lamp_tilt_rad);
    light.resampled = position.beam.image().resampled;
    light.behind = light.out_of_table = true;
    if (!position.beam.image().dark) light.colour = position.beam.image().colour;
    for (std::size_t k = 0; k < lamp.sources.size(); ++k) {
      if (!lit_.contains(lamp.sources[k].function) || position.dimmed_01(k) <= 0.0) continue;
      const AimedSource source = aimed(design_, slot, k);
      const glm::dvec3 direction = glm::transpose(turn * source.car_from_lamp) * way;
      light.candela += source.scale * position.dimmed_01(k) * source.table->intensity_cd(direction);
      const TableAngles angles = source.table->angles_of(direction);
      const auto within = [](const std::vector<double>& nodes, double deg) {
        return deg >= nodes.front() && deg <= nodes.back();
      };
      light.behind = light.behind && direction.x <= 0.0;
      light.out_of_table = light.out_of_table && !(within(source.table->first_deg, angles.first_deg) &&
                                                   within(source.table->second_deg, angles.second_deg));
      if (!std::exchange(light.lit, true)) {
        light.h_deg = glm::degrees(std::atan2(-direction.y, direction.x));
        light.v_deg = glm::degrees(std::atan2(direction.z, std::hypot(direction.x, direction.y)));
      }
    }
    lights.push_back(std::move(light));
  }
  return lights;
}

std::vector<double> Lamps::peaks_cd() const {
  std::vector<double> peaks;
  for (std::size_t slot = 0; slot < designs_[design_].lamps.size(); ++slot) {
    const Position& position = positions_[design_][slot];
    double& peak_cd = peaks.emplace_back(0.0);
    for (std::size_t k = 0; k < position.dimming_01.size(); ++k) {
      if (!lit_.contains(designs_[design_].lamps[slot].sources[k].function) || position.dimmed_01(k) <= 0.0) continue;
      const AimedSource source = aimed(design_, slot, k);
      peak_cd += source.scale * position.dimmed_01(k) * source.table->peak_cd();
    }
  }
  return peaks;
}

std::optional<glm::vec3> Lamps::light() const {
  glm::dvec3 sum{0.0};
  double lumens = 0.0;
  for (const Position& position : positions_[design_]) {
    if (position.beam.image().dark) continue;
    sum += position.beam.lumens() * glm::dvec3(position.beam.image().colour);
    lumens += position.beam.lumens();
  }
  return lumens > 0.0 ? std::optional(glm::vec3(sum / lumens)) : std::nullopt;
}

/// Only functions that a lamp of the design has.
std::string Lamps::text_of_lit() const {
  std::string text;
  for (const LampFunction function : lit_) {
    const bool present = std::ranges::any_of(designs_[design_].lamps, [&](const LampConfig& lamp) {
      return std::ranges::any_of(lamp.sources, [&](const SourceConfig& source) { return source.function == function; });
    });
    if (present)
      text += (text.empty() ? "" : " ") + std::string(kLampFunctionNames[static_cast<std::size_t>(function)]);
  }
  return text.empty() ? "off" : text;
}

std::vector<std::string> Lamps::lit_table_ends() const {
  std::vector<std::string> lines;
  for (const SourceEnd& end : table_ends_) {
    if (end.design == design().name && lit_.contains(end.function)) lines.push_back(end.text());
  }
  return lines;
}

std::uint64_t Lamps::resampled_images() const {
  std::uint64_t count = 0;
  for (const std::vector<Position>& design : positions_)
    count += static_cast<std::uint64_t>(
        std::ranges::count_if(design, [](const Position& p) { return p.beam.image().resampled; }));
  return count;
}

std::uint64_t Lamps::summed_texels() const {
  std::uint64_t texels = 0;
  for (const std::vector<Position>& design : positions_)
    for (const Position& position : design) texels += position.beam.summed_texels();
  return texels;
}

std::vector<Lamps::TableInfo> Lamps::tables() const {
  std::vector<TableInfo> infos;
  for (const auto& [key, table] : tables_) {
    infos.push_back(
        {table->name, table->content_hash, table->peak_cd(), table->flux_lm(), table->notes, opening_text(*table),
         LampTables::reading(key)});
  }
  return infos;
}

}  // namespace phare
