// Where the driver's controls come from: CAN, a log, keys, a recorded drive, a scripted driver.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cockpit_io/cockpit.h"
#include "cockpit_io/feedback.h"
#include "cockpit_io/memory.h"
#include "config/base/result.h"
#include "config/cockpit.h"
#include "net/messages.h"

namespace phare {

/// What a source has read so far, for the statistics.
struct SourceCounts {
  std::uint64_t frames_read = 0;   ///< CAN frames of socket or log; recorded states of a drive
  std::uint64_t decoded = 0;       ///< of them those that moved or held a mapped control
  std::uint64_t incomplete = 0;    ///< mapped, but too short or with a value that means nothing
  std::uint64_t unknown_ids = 0;   ///< frames that the DBC does not know
  std::uint64_t error_frames = 0;  ///< reports of the CAN controller
  std::uint64_t bad_crc = 0;       ///< mapped, but refused by their checksum
  std::uint64_t bad_counter = 0;   ///< mapped, but refused by their alive counter
  std::uint64_t lost_in_data = 0;  ///< frames missing by the alive counters that are checked
  std::uint64_t dropped = 0;       ///< frames the kernel dropped because the socket was full
  std::uint64_t link_dropped = 0;  ///< frames lost in the interface before any socket
  std::uint64_t bus_offs = 0;      ///< times the controller left the bus
  std::uint64_t sent = 0;          ///< frames put onto the bus
  std::uint64_t not_sent = 0;      ///< frames the kernel did not take
  std::uint64_t broken_lines = 0;  ///< of a log
  std::uint64_t reconnects = 0;    ///< times a lost interface came back
  std::uint64_t fail_safes = 0;    ///< times the source fell silent

  SourceCounts& operator+=(const SourceCounts& other);
};

class Source {
 public:
  virtual ~Source() = default;

  /// Reads everything up to `now` and hands it to the cockpit, each entry at its own time. Never blocks. `vehicle`:
  /// newest known state of the car, may be nullptr.
  virtual void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) = 0;

  /// The source has no more to give.
  virtual bool ended() const { return false; }

  /// One word for the statistics: "up", "down", "silent", "ended".
  virtual std::string status() const { return ended() ? "ended" : "up"; }

  /// Goes through everything again from the start of the drive by itself (a log, a drive, a script): nothing needs to
  /// be remembered of it.
  virtual bool plays_again() const { return false; }

  /// What is latched and what was said last, of a source that cannot be asked again: left with every datagram, taken up
  /// by the cockpit that takes the place of one that was killed. Always of the same size for the same cockpit file.
  virtual void remember(Memory&) {}

  /// What is wrong, for the driver's eye: "can0: link down"; empty when nothing is.
  virtual std::string fault() const { return {}; }

  /// Whether send_back() does anything.
  virtual bool sends_back() const { return false; }

  /// Tells the source's car what its telltales show. `now`: the wall clock.
  virtual void send_back(const FeedbackValues&, WallTime /*now*/) {}

  /// What came of the keyboard of a window; `start_id` and `channel`: of the visual process it belongs to.
  virtual void take_keys(std::uint32_t /*channel*/, std::uint64_t /*start_id*/, const KeyInput&,
                         WallTime /*received*/) {}

  /// Who drives, where it is not the source itself: "demo"; empty: the source.
  virtual std::string driver() const { return {}; }

  /// File descriptors that become readable when the source has something.
  virtual std::vector<int> wait_fds() const { return {}; }

  const SourceCounts& counts() const { return counts_; }

  /// Called for every frame that was decoded, with its wall stamp, for measuring latency. May be empty.
  std::function<void(WallTime)> on_frame;

 protected:
  SourceCounts counts_;
};

/// A cockpit file that another names beside itself (also). Error: it cannot be read, plays by itself, or names further
/// ones.
Result<CockpitConfig> read_source_beside(const std::filesystem::path& file);

/// Opens the source a cockpit file names, with those it names beside it (also). Errors: missing or malformed files, a
/// kernel without CAN.
Result<std::unique_ptr<Source>> open_source(const CockpitConfig& config);

}  // namespace phare
