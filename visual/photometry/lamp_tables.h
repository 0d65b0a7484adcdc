// The photometry files of mounted sources, each read once.
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "config/rig.h"
#include "visual/photometry/beam_image.h"
#include "visual/photometry/read_lamp.h"

namespace phare {

class LampTables {
 public:
  /// Reads the file of a source unless it is here already, with the same settings. The error is the file's.
  Status add(const SourceConfig& source);
  /// Of a source that was added. Stays where it is, also when this moves.
  const IntensityTable& of(const SourceConfig& source) const { return tables_.at(key(source)); }
  /// The source as it shines: its table, aim, scale and colour.
  AimedSource aimed(const SourceConfig& source) const;

  auto begin() const { return tables_.begin(); }
  auto end() const { return tables_.end(); }

 private:
  using Key = std::tuple<std::string, GammaAxis, double, bool, std::size_t, std::size_t, double>;
  static Key key(const SourceConfig& source);

  std::map<Key, IntensityTable> tables_;
};

}  // namespace phare
