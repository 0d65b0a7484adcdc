// The driver's controls from a CAN interface. The interface may go down, be unplugged and come back.
#pragma once

#include <optional>
#include <string>

#include "cockpit_io/can_socket.h"
#include "cockpit_io/signal_map.h"
#include "cockpit_io/source.h"

namespace phare {

class CanSource : public Source {
 public:
  /// Error when the kernel has no CAN. An interface that is not there (yet) is waited for.
  static Result<std::unique_ptr<Source>> open(const std::string& interface, SignalMap map);

  void advance(Moment now, const VehicleState* vehicle, Cockpit& cockpit) override;
  std::string status() const override;

 private:
  CanSource(std::string interface, SignalMap map) : interface_(std::move(interface)), map_(std::move(map)) {}
  void reopen(WallTime now);
  void lose(const std::string& why);
  void take(const CanSocket::Received& received, Moment now, Cockpit& cockpit);

  std::string interface_;
  SignalMap map_;
  std::optional<CanSocket> socket_;
  bool link_up_ = true;     // of an open socket
  bool said_lost_ = false;  // each loss is said once
  bool silent_ = false;
  std::int64_t next_open_ns_ = 0;
  std::uint64_t dropped_before_ = 0;  // by sockets that are gone
  DriverInput input_;
};

}  // namespace phare
