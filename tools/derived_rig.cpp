#include "tools/derived_rig.h"

#include <unistd.h>

#include <fstream>
#include <utility>

#include "config/rig_writer.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWrittenByDrive = "Written by `phare drive`";

bool written_by_a_drive(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  return std::getline(stream, line) && line.starts_with(std::string("# ") + kWrittenByDrive);
}

}  // namespace

Result<DerivedRig> DerivedRig::for_drive(const fs::path& out) {
  DerivedRig rig;
  std::error_code ignored, failed;
  if (out.empty()) {
    rig.file_ = fs::temp_directory_path(failed) / ("phare-rig-" + std::to_string(getpid()) + ".toml");
    if (failed) return Error{"TMPDIR", "names no folder; the rig with a lamp of one's own is kept there"};
    rig.temporary_ = true;
    return rig;
  }
  rig.file_ = out / "rig.toml";
  if (fs::exists(rig.file_, ignored) && !written_by_a_drive(rig.file_))
    return Error{rig.file_.string(),
                 "is there, and no drive has written it; the drive's rig goes by this name: choose "
                 "another --out"};
  return rig;
}

DerivedRig::DerivedRig(DerivedRig&& other) noexcept
    : file_(std::exchange(other.file_, {})), temporary_(std::exchange(other.temporary_, false)) {}

DerivedRig::~DerivedRig() {
  if (temporary_) remove();
}

void DerivedRig::remove() const {
  std::error_code ignored;
  if (!file_.empty()) fs::remove(file_, ignored);
}

Status DerivedRig::write(const Rig& rig, const std::string& says) const {
  RigWords words;
  words.path = paths_from(temporary_ ? fs::path("/nonexistent") : file_.parent_path());
  words.heading = std::string(kWrittenByDrive) + ": the rig that was driven. To drive it again: phare drive --rig " +
                  file_.filename().string() + "\nWhat each key means: docs/rig-file.md.";
  words.of_designs = {says};
  const fs::path beside = file_.string() + ".part";
  std::error_code failed;
  {
    std::ofstream stream(beside, std::ios::binary);
    stream << rig_text(rig, words);
    if (!stream.flush()) return Error{file_.string(), "cannot be written"};
  }
  fs::rename(beside, file_, failed);
  if (failed) return Error{file_.string(), failed.message()};
  return Done{};
}

void remove_earlier_rig(const fs::path& out, const fs::path& driven) {
  std::error_code ignored;
  const fs::path file = out / "rig.toml";
  if (fs::equivalent(file, driven, ignored) || !written_by_a_drive(file)) return;
  fs::remove(file, ignored);
}

}  // namespace phare
