// The photometry files of mounted sources, each read once.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "config/rig.h"
#include "config/street_lamps.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/beam/pixel_light.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {

/// How the file of a mounted source is to be read: everything its configuration says about that. Whoever reads a rig's
/// lamp reads it so.
LampReadSettings read_settings(const SourceConfig& source);
/// The same of a street lamp's file.
LampReadSettings read_settings(const LuminaireConfig& luminaire);

class LampTables {
 public:
  /// File and read_settings; of a pixel light its picture and map.
  using Key =
      std::tuple<std::string, GammaAxis, double, bool, std::size_t, std::size_t, double, std::string, std::string>;
  /// Reads the file of a source unless it is here already, with the same settings. The error is the file's. The file
  /// stays open for the sources that follow, until one has another or close().
  Status add(const SourceConfig& source);
  void close() { open_.reset(); }
  /// Of a source that was added. Stays where it is when this is moved or copied, as long as one of them is there.
  const IntensityTable& of(const SourceConfig& source) const { return *tables_.at(key(source)); }
  /// Of a source that was added: its pixel light with the picture it begins with, for a copy of one's own; nothing: it
  /// is none.
  const PixelLight* pixel_light(const SourceConfig& source) const;
  /// The source as it shines: its table, aim, scale and colour.
  AimedSource aimed(const SourceConfig& source) const;

  /// What a key says beside the file: "emitter 2, mirrored"; empty where it is what a file is by itself.
  static std::string reading(const Key& key);

  auto begin() const { return tables_.begin(); }
  auto end() const { return tables_.end(); }

 private:
  static Key key(const SourceConfig& source);
  Status add_pixel_light(const SourceConfig& source, const IntensityTable& full);

  std::map<Key, std::shared_ptr<const IntensityTable>> tables_;
  std::shared_ptr<LampFile> open_;
  std::map<Key, std::shared_ptr<const PixelLight>> pixel_lights_;  ///< own their tables
};

}  // namespace phare
