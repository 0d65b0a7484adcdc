#include "visual/photometry/beam/lamp_tables.h"

#include <utility>

#include "config/base/input_files.h"

namespace phare {

LampTables::Key LampTables::key(const SourceConfig& source) {
  return {source.file.string(),     source.axis,    source.c0_turn_deg, source.mirror,
          source.lamp_set,          source.emitter, source.distance_m,  source.pixels.string(),
          source.pixel_map.string()};
}

LampReadSettings read_settings(const SourceConfig& source) {
  LampReadSettings settings;
  settings.axis = source.axis;
  settings.c0_turn_deg = source.c0_turn_deg;
  settings.mirror_h = source.mirror;
  settings.lamp_set = source.lamp_set;
  settings.emitter = source.emitter;
  settings.distance_m = source.distance_m;
  return settings;
}

LampReadSettings read_settings(const LuminaireConfig& luminaire) {
  LampReadSettings settings;
  settings.c0_turn_deg = luminaire.c0_turn_deg;
  settings.mirror_h = luminaire.mirror;
  settings.lamp_set = luminaire.lamp_set;
  settings.emitter = luminaire.emitter;
  return settings;
}

Status LampTables::add(const SourceConfig& source) {
  if (tables_.contains(key(source))) return Done{};
  for (const auto& [other, unused] : tables_) {
    if (is_standard_input(source.file) && std::get<0>(other) == source.file.string())
      return Error{input_name(source.file),
                   "can be read only once: its lamps need the same axis, c0_deg, mirror, "
                   "lamp_set, emitter and distance_m"};
  }
  if (!open_ || open_->path() != source.file) {
    auto file = LampFile::open(source.file);
    if (!file) return file.error();
    open_ = std::make_shared<LampFile>(std::move(*file));
  }
  Result<IntensityTable> table = open_->table(read_settings(source));
  if (!table) return table.error();
  if (!source.pixels.empty()) return add_pixel_light(source, *table);
  tables_.emplace(key(source), std::make_shared<const IntensityTable>(std::move(*table)));
  return Done{};
}

Status LampTables::add_pixel_light(const SourceConfig& source, const IntensityTable& full) {
  const Result<PixelFrame> frame = read_pixel_frame(source.pixels);
  if (!frame) return frame.error();
  if (source.pixel_map.empty() && full.type != PhotometricType::kA)
    return Error{source.pixels.string(),
                 "its lamp " + full.name + " is no table of H and V: a pixel_map has to say where the pixels shine"};
  const Result<PixelMap> map =
      source.pixel_map.empty()
          ? Result<PixelMap>(even_map(frame->columns, frame->rows, {full.first_deg.front(), full.second_deg.front()},
                                      {full.first_deg.back(), full.second_deg.back()}))
          : read_pixel_map(source.pixel_map, frame->columns, frame->rows);
  if (!map) return map.error();
  auto light = std::make_shared<PixelLight>(full, *map, frame->columns, frame->rows);
  light->show(*frame);
  tables_.emplace(key(source), std::shared_ptr<const IntensityTable>(light, &light->table()));
  pixel_lights_.emplace(key(source), std::move(light));
  return Done{};
}

const PixelLight* LampTables::pixel_light(const SourceConfig& source) const {
  const auto found = pixel_lights_.find(key(source));
  return found == pixel_lights_.end() ? nullptr : found->second.get();
}

std::string LampTables::reading(const Key& key) {
  const auto& [file, axis, c0_deg, mirror, lamp_set, emitter, distance_m, pixels, pixel_map] = key;
  std::string text;
  const auto say = [&text](const std::string& word) { text += (text.empty() ? "" : ", ") + word; };
  if (emitter != 1) say("emitter " + std::to_string(emitter));
  if (lamp_set != 1) say("lamp set " + std::to_string(lamp_set));
  if (axis == GammaAxis::kGamma90) say("axis gamma90");
  if (c0_deg != 0.0) say("C 0 turned");
  if (mirror) say("mirrored");
  if (distance_m != 0.0) say("measured from " + std::to_string(distance_m) + " m");
  if (!pixels.empty()) say("pixels of " + pixels);
  return text;
}

AimedSource LampTables::aimed(const SourceConfig& source) const {
  return {&of(source),
          aim_rotation(source.yaw_rad, source.pitch_rad, source.roll_rad),
          source.scale,
          source.colour_temperature_k,
          source.chromaticity_xy,
          !source.pixels.empty()};
}

}  // namespace phare
