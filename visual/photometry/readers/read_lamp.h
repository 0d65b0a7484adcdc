// The one door for photometry files: finds the format, reads it into an IntensityTable, notes what it repaired.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "visual/photometry/table/intensity_table.h"

namespace pugi {
class xml_document;
}

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
  std::filesystem::path folder;  ///< where a TILT file is looked for; that of a file that was opened
};

/// A photometry file from which several tables are taken (a matrix has one emitter a segment): its bytes are read and
/// hashed, and its XML is parsed, once for all of them. Memory: the file, and of TM-33 its tree beside it.
class LampFile {
 public:
  static Result<LampFile> open(const std::filesystem::path& file);
  /// Of bytes that outlive this; `name` stands for the file in messages.
  LampFile(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  const std::filesystem::path& path() const { return path_; }
  /// What read_lamp reads, and the same errors.
  Result<IntensityTable> table(LampReadSettings settings);

 private:
  Result<IntensityTable> read(LampFormat format, std::string_view text, const LampReadSettings& settings);

  std::filesystem::path path_;               ///< of open()
  std::shared_ptr<const std::string> read_;  ///< of open(): what bytes_ sees
  std::string_view bytes_;
  std::string name_;
  std::string hash_;                          ///< of the bytes, once a table was taken
  std::shared_ptr<pugi::xml_document> tree_;  ///< of TM-33, once a table was taken
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
/// `tree` is the text as XML where it was parsed before, and is put there where it was not.
Result<IntensityTable> parse_tm33(std::string_view text, const std::string& name, const LampReadSettings& settings,
                                  std::shared_ptr<pugi::xml_document>& tree);
Result<IntensityTable> parse_lamp_csv(std::string_view text, const std::string& name, const LampReadSettings& settings);

/// Left and right turned round: type A and B in H, type C about the plane through the optical axis and up.
void mirror_left_right(IntensityTable& table);

}  // namespace phare
