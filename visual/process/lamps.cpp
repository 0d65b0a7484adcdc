#include "visual/process/lamps.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "config/conventions.h"
#include "visual/photometry/illuminance.h"
#include "visual/photometry/read_lamp.h"

namespace phare {
namespace {

const char* name_of(LampFunction function) {
  switch (function) {
    case LampFunction::kPosition:
      return "position";
    case LampFunction::kLow:
      return "low";
    case LampFunction::kHigh:
      return "high";
    case LampFunction::kFog:
      return "fog";
    case LampFunction::kDaytime:
      return "daytime";
    case LampFunction::kCornering:
      return "cornering";
  }
  return "?";
}

glm::dvec3 position_of(const VehicleState& pose) {
  return {pose.x_m, pose.y_m, pose.z_m};
}
glm::dmat3 rotation_of(const VehicleState& pose) {
  return world_from_car(pose.roll_rad, pose.pitch_rad, pose.yaw_rad);
}

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
    if (design.lamps.size() > kMostPositions) {
      return Error{rig.file.string(), "design '" + design.name + "' has " + std::to_string(design.lamps.size()) +
                                          " lamp positions, at most " + std::to_string(kMostPositions) + " are drawn"};
    }
    most_positions = std::max(most_positions, design.lamps.size());
    for (const LampConfig& lamp : design.lamps) {
      if (lamp.sources.size() > 64)
        return Error{rig.file.string(), "lamp '" + lamp.name + "' has more than 64 sources"};
      for (const SourceConfig& source : lamp.sources) {
        const std::pair key{source.file.string(), source.axis};
        if (lamps.tables_.contains(key)) continue;
        Result<IntensityTable> table = read_lamp(source.file, {.axis = source.axis, .folder = {}});
        if (!table) return table.error();
        lamps.tables_.emplace(key, std::move(*table));
      }
    }
  }
  lamps.shown_.assign(most_positions, nullptr);
  return lamps;
}

std::vector<Lamps::Change> Lamps::set_controls(const CockpitState& controls) {
  design_ = std::min<std::size_t>(controls.design_index, designs_.size() - 1);
  lit_ = lit_functions(controls, high_keeps_low_);
  wheel_pitch_rad_ = controls.lamp_aim_rad;
  lit_text_ = text_of_lit();

  std::vector<Change> changes;
  for (std::size_t position = 0; position < designs_[design_].lamps.size(); ++position) {
    const BeamImage& image = image_of(design_, position, lit_mask(designs_[design_].lamps[position], lit_));
    if (shown_[position] == &image) continue;
    shown_[position] = &image;
    if (image.dark) continue;  // not drawn, so nothing to upload
    changes.push_back({position, &image});
    ++uploads_;
  }
  return changes;
}

std::vector<PlacedLamp> Lamps::placed(const VehicleState& pose) const {
  const glm::dmat3 rotation = rotation_of(pose);
  const glm::dmat3 aim = aim_rotation(0.0, aim_pitch_rad_ + wheel_pitch_rad_ + pose.lamp_tilt_rad, 0.0);
  const std::vector<LampConfig>& lamps = designs_[design_].lamps;
  std::vector<PlacedLamp> placed;
  for (std::size_t position = 0; position < lamps.size(); ++position) {
    const BeamImage* image = shown_[position];
    if (image == nullptr || image->dark) continue;
    placed.push_back(
        {position_of(pose) + rotation * lamps[position].position_m, rotation * aim * image->car_from_image, position});
  }
  return placed;
}

double Lamps::illuminance_lx(const VehicleState& pose, const MeasurePoint& at) const {
  const glm::dmat3 car_from_world = glm::transpose(rotation_of(pose));
  const MeasurePoint in_car{car_from_world * (at.position_m - position_of(pose)), car_from_world * at.normal};
  return illuminance_in_car_lx(design_, lit_, in_car, pose.lamp_tilt_rad);
}

double Lamps::illuminance_in_car_lx(std::size_t design, const std::set<LampFunction>& lit, const MeasurePoint& at,
                                    double tilt_rad) const {
  const glm::dmat3 aim = aim_rotation(0.0, aim_pitch_rad_ + wheel_pitch_rad_ + tilt_rad, 0.0);
  double total_lx = 0.0;
  for (const LampConfig& lamp : designs_[design].lamps) {
    for (const SourceConfig& source : lamp.sources) {
      if (!lit.contains(source.function)) continue;
      const AimedSource light = aimed(source);
      total_lx += phare::illuminance_lx(lamp.position_m, aim * light.car_from_lamp, *light.table, light.scale,
                                        at.position_m, at.normal);
    }
  }
  return total_lx;
}

/// Only functions that a lamp of the design has.
std::string Lamps::text_of_lit() const {
  std::string text;
  for (const LampFunction function : lit_) {
    const bool present = std::ranges::any_of(designs_[design_].lamps, [&](const LampConfig& lamp) {
      return std::ranges::any_of(lamp.sources, [&](const SourceConfig& source) { return source.function == function; });
    });
    if (present) text += (text.empty() ? "" : " ") + std::string(name_of(function));
  }
  return text.empty() ? "off" : text;
}

std::uint64_t Lamps::resampled_images() const {
  return static_cast<std::uint64_t>(
      std::count_if(images_.begin(), images_.end(), [](const auto& entry) { return entry.second->resampled; }));
}

std::vector<Lamps::TableInfo> Lamps::tables() const {
  std::vector<TableInfo> infos;
  for (const auto& [key, table] : tables_) {
    infos.push_back({table.name, table.content_hash, table.peak_cd(), table.flux_lm(), table.notes});
  }
  return infos;
}

Lamps::SourceMask Lamps::lit_mask(const LampConfig& lamp, const std::set<LampFunction>& lit) const {
  SourceMask mask = 0;
  for (std::size_t i = 0; i < lamp.sources.size(); ++i) {
    if (lit.contains(lamp.sources[i].function)) mask |= SourceMask{1} << i;
  }
  return mask;
}

const BeamImage& Lamps::image_of(std::size_t design, std::size_t position, SourceMask mask) {
  std::unique_ptr<BeamImage>& image = images_[{design, position, mask}];
  if (!image) {
    std::vector<AimedSource> sources;
    const std::vector<SourceConfig>& all = designs_[design].lamps[position].sources;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((mask >> i & 1u) != 0) sources.push_back(aimed(all[i]));
    }
    image = std::make_unique<BeamImage>(compose_beam_image(sources));
    ++compositions_;
  }
  return *image;
}

AimedSource Lamps::aimed(const SourceConfig& source) const {
  return {&tables_.at({source.file.string(), source.axis}),
          aim_rotation(source.yaw_rad, source.pitch_rad, source.roll_rad), source.scale, source.colour_temperature_k};
}

}  // namespace phare
