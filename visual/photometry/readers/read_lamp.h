// The one door for photometry files: finds the format, reads it into an IntensityTable, notes what it repaired.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

enum class LampFormat { kFind, kLm63, kEulumdat, kTm33, kCsv };

/// What a file leaves open. Values that a file states itself win over these, but for `distance_m`.
struct LampReadSettings {
  LampFormat format = LampFormat::kFind;
  GammaAxis axis = GammaAxis::kGamma0;  ///< type C, EULUMDAT: where the optical axis lies
  /// Type C, EULUMDAT: direction of the file's plane C 0 as an angle of ours (gamma 0: 0 right, 90 up; gamma 90: 0
  /// ahead, 90 left), degrees. fog lamps are found with C 0 up.
  double c0_turn_deg = 0.0;
  std::size_t lamp_set = 1;      ///< EULUMDAT: which of the file's lamp sets, from 1; others have only the first
  std::size_t emitter = 1;       ///< TM-33: which of the file's emitters with luminous data, from 1; the same
  bool mirror_h = false;         ///< the file is clockwise or mirrored: turn left and right round
  double distance_m = 0.0;       ///< CSV in lux without a distance
  std::filesystem::path folder;  ///< where a TILT file is looked for; read_lamp sets it
};

/// Reads any of the formats. The error has file:line and reason. Memory stays below a small multiple of the file.
Result<IntensityTable> read_lamp(const std::filesystem::path& file, const LampReadSettings& settings = {});

/// The same from bytes; `name` stands for the file in messages.
Result<IntensityTable> parse_lamp(std::string_view bytes, const std::string& name,
                                  const LampReadSettings& settings = {});

/// What the bytes look like: by their own marks, then by the name's ending. kFind: like none.
LampFormat find_format(std::string_view bytes, std::string_view name);

// The readers behind the door; text without marks and with '\n' as line end.
Result<IntensityTable> parse_lm63(std::string_view text, const std::string& name, const LampReadSettings& settings);
Result<IntensityTable> parse_eulumdat(std::string_view text, const std::string& name, const LampReadSettings& settings);
Result<IntensityTable> parse_tm33(std::string_view text, const std::string& name, const LampReadSettings& settings);
Result<IntensityTable> parse_lamp_csv(std::string_view text, const std::string& name, const LampReadSettings& settings);

/// Left and right turned round: type A and B in H, type C about the plane through the optical axis and up.
void mirror_left_right(IntensityTable& table);

}  // namespace phare
