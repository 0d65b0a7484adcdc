// The rig of a drive with lamps of one's own: a file that all processes read, kept in the drive's folder so that the
// drive can be repeated, or beside the system's temporary files and gone at the end.
#pragma once

#include <filesystem>
#include <string>

#include "config/rig.h"

namespace phare {

class DerivedRig {
 public:
  /// `out`: the drive's folder; empty: none is kept. Error: OUT/rig.toml is there and no drive has written it.
  static Result<DerivedRig> for_drive(const std::filesystem::path& out);
  DerivedRig(DerivedRig&& other) noexcept;
  DerivedRig& operator=(DerivedRig&&) = delete;
  ~DerivedRig();  ///< removes a temporary file

  const std::filesystem::path& file() const { return file_; }
  /// Writes it whole or not at all. `says`: comment lines above the first design.
  Status write(const Rig& rig, const std::string& says) const;
  /// After bad input.
  void remove() const;

 private:
  DerivedRig() = default;
  std::filesystem::path file_;
  bool temporary_ = false;
};

/// OUT/rig.toml of an earlier drive, unless it is `driven`.
void remove_earlier_rig(const std::filesystem::path& out, const std::filesystem::path& driven);

}  // namespace phare
