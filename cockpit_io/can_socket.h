// A SocketCAN raw socket that hears only the ids it is asked for, with the kernel's time stamps.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cockpit_io/can_frame.h"
#include "config/base/result.h"
#include "net/sim_time.h"

namespace phare {

/// Whether this kernel has raw CAN sockets; the Error says what is missing and what gives it.
Status can_supported();

class CanSocket {
 public:
  struct Received {
    CanFrame frame;
    WallTime stamp;  ///< when the kernel took it from the controller, CLOCK_REALTIME
  };
  /// Why a socket gave nothing.
  enum class Nothing {
    kNoFrame,   ///< none waiting
    kLinkDown,  ///< ENETDOWN: the interface was set down; the socket reads on when it is up again
    kGone,      ///< ENODEV and all else: the interface was removed; open a new socket
  };

  /// Opens and binds; hears data and remote frames of `ids` and all error frames. Errors: no CAN in the kernel, no such
  /// interface, not allowed.
  static Result<CanSocket> open(const std::string& interface, std::span<const CanId> ids);

  /// The same, but hears every data and remote frame.
  static Result<CanSocket> open_to_all(const std::string& interface);

  CanSocket(CanSocket&& other) noexcept;
  CanSocket& operator=(CanSocket&& other) noexcept;
  ~CanSocket();

  /// The next frame, without blocking; nullopt when there is none, why() then tells why.
  std::optional<Received> receive();
  Nothing why() const { return why_; }

  /// Puts a frame onto the bus, without blocking; false when the kernel does not take it (queue full, link down). Other
  /// sockets of this machine hear it too, this one does not.
  bool send(const CanFrame& frame);

  /// Frames the kernel dropped since the socket was opened because it was full (SO_RXQ_OVFL).
  std::uint64_t dropped() const { return dropped_; }
  int fd() const { return fd_; }

 private:
  static Result<CanSocket> open_filtered(const std::string& interface, const std::vector<CanId>* ids);
  explicit CanSocket(int fd) : fd_(fd) {}

  int fd_ = -1;
  Nothing why_ = Nothing::kNoFrame;
  std::uint64_t dropped_ = 0;
};

}  // namespace phare
