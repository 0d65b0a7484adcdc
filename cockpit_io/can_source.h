// The driver's controls from a CAN interface. The interface may go down, be unplugged and come back, the controller may
// leave the bus: each is said once, counted, and survived.
#pragma once

#include <optional>
#include <string>

#include "cockpit_io/can_socket.h"
#include "cockpit_io/feedback.h"
#include "cockpit_io/signal_map.h"
#include "cockpit_io/source.h"

namespace phare {

class CanSource : public Source {
 public:
  /// Error when the kernel has no CAN. An interface that is not there (yet) is waited for.
  static Result<std::unique_ptr<Source>> open(const std::string& interface, SignalMap map, Feedback feedback);

  void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) override;
  std::string status() const override;
  std::string fault() const override;
  bool sends_back() const override { return !feedback_.empty(); }
  void remember(Memory& memory) override;
  void send_back(const FeedbackValues& values, WallTime now) override;
  std::vector<int> wait_fds() const override;

 private:
  enum class BusState { kActive, kPassive, kOff };

  CanSource(std::string interface, SignalMap map, Feedback feedback);
  void reopen(WallTime now);
  void lose(const std::string& why);
  void watch_link(WallTime now);
  void link_is_up();
  void take(const CanSocket::Received& received, Moment now, ControlSink& cockpit);
  void take_error(const CanFrame& frame, WallTime now);
  void enter(BusState state, WallTime now);
  bool silent(WallTime now) const;

  std::string interface_;
  SignalMap map_;
  Feedback feedback_;
  std::optional<CanSocket> socket_;
  bool link_up_ = true;     // of an open socket
  bool said_lost_ = false;  // each loss is said once
  bool said_refused_ = false;
  bool said_no_restart_ = false;
  bool silent_ = false;
  BusState bus_ = BusState::kActive;
  std::int64_t next_open_ns_ = 0, next_look_ns_ = 0, next_restart_ns_ = 0;
  std::int64_t refused_until_ns_ = 0;      // a refused frame is shown so long
  std::uint64_t dropped_before_ = 0;       // by sockets that are gone
  std::uint64_t link_dropped_before_ = 0;  // by interfaces that are gone, or before this one was opened
  std::uint64_t link_dropped_now_ = 0;
  std::string why_lost_, refused_;
  DriverInput input_;
};

}  // namespace phare
