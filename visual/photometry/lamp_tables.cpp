#include "visual/photometry/lamp_tables.h"

#include <utility>

namespace phare {

LampTables::Key LampTables::key(const SourceConfig& source) {
  return {source.file.string(), source.axis, source.c0_turn_deg, source.mirror, source.lamp_set, source.emitter};
}

Status LampTables::add(const SourceConfig& source) {
  if (tables_.contains(key(source))) return Done{};
  LampReadSettings settings;
  settings.axis = source.axis;
  settings.c0_turn_deg = source.c0_turn_deg;
  settings.mirror_h = source.mirror;
  settings.lamp_set = source.lamp_set;
  settings.emitter = source.emitter;
  Result<IntensityTable> table = read_lamp(source.file, settings);
  if (!table) return table.error();
  tables_.emplace(key(source), std::move(*table));
  return Done{};
}

AimedSource LampTables::aimed(const SourceConfig& source) const {
  return {&of(source), aim_rotation(source.yaw_rad, source.pitch_rad, source.roll_rad), source.scale,
          source.colour_temperature_k, source.chromaticity_xy};
}

}  // namespace phare
