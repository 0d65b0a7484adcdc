// Writes every datagram the recorder's port accepts into a drive file.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "config/base/result.h"
#include "config/rig.h"
#include "net/bus.h"
#include "net/drive_file.h"

namespace phare {

/// Error where a drive file with anything in it is: what was recorded is not lost to what comes next.
Status no_recording_at(const std::filesystem::path& out);

class Recorder {
 public:
  /// Binds the recorder's port: what comes from now on waits there.
  static Result<std::unique_ptr<Recorder>> open(const Rig& rig);
  /// Creates the file, over one that is there.
  Status create(const std::filesystem::path& out);

  /// Takes what has come. Error once the disk does not take it.
  Status poll();
  bool wait(std::chrono::nanoseconds at_most) { return bus_.wait(at_most); }
  /// The dynamics process has said that the drive is over.
  bool drive_ended() const { return drive_ended_; }
  std::uint64_t written() const { return written_; }
  const Bus& bus() const { return bus_; }

 private:
  Recorder(Bus bus, std::uint16_t port_base);

  Bus bus_;
  std::uint16_t port_base_;
  std::optional<DriveWriter> writer_;
  std::uint64_t written_ = 0;
  bool drive_ended_ = false;
  std::optional<Error> failed_;
};

}  // namespace phare
