// The driver's controls from a candump log, played at the pace of simulated time or a multiple of it.
#pragma once

#include "cockpit_io/candump.h"
#include "cockpit_io/signal_map.h"
#include "cockpit_io/source.h"

namespace phare {

class LogSource : public Source {
 public:
  /// Takes ownership of a log that was read; stamps count from its first entry. `map`: bound with start_ns 0; its
  /// timeouts count in the log's time. The log plays config().log_speed times as fast as it was recorded.
  LogSource(CandumpLog log, SignalMap map);

  void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) override;
  bool plays_again() const override { return true; }
  bool ended() const override { return next_ == log_.entries.size(); }
  std::string status() const override;
  std::string fault() const override;

 private:
  std::int64_t sim_ns(std::int64_t log_ns) const;
  std::int64_t log_ns(std::int64_t sim_ns) const;

  CandumpLog log_;
  SignalMap map_;
  std::size_t next_ = 0;
  std::int64_t due_ns_ = 0;  // of the newest entry taken; a stamp that goes back is due at once
  bool silent_ = false;
  std::string refused_;                // the newest frame that a check refused
  std::int64_t refused_until_ns_ = 0;  // and how long it is shown, in the log's time
  std::int64_t now_ns_ = 0;            // the log's time
  DriverInput input_;
};

}  // namespace phare
