#include "tools/import_cockpit.h"

#include <algorithm>
#include <utility>

#include "cockpit_io/cockpit.h"
#include "cockpit_io/signal_map.h"

namespace phare {

const CockpitState& RecordedControls::at(double t_s) const {
  const auto after =
      std::upper_bound(states.begin(), states.end(), t_s, [](double time, const At& at) { return time < at.t_s; });
  return (after == states.begin() ? after : after - 1)->state;
}

Result<RecordedControls> recorded_controls(const CockpitConfig& config, const Dbc& dbc, const CandumpLog& log) {
  const ControlMapping* steering = config.find(Control::kSteering);
  if (steering == nullptr) return Error{config.file.string(), "maps no steering: an import needs [control.steering]"};
  const std::int64_t begin_ns = log.entries.front().stamp_ns;
  auto map = SignalMap::bind(config, dbc, 0);
  if (!map) return map.error();
  const DbcMessage& steering_message = *dbc.find(steering->message);
  RecordedControls recorded;
  recorded.has_accelerator = config.find(Control::kAccelerator) != nullptr;
  recorded.has_brake = config.find(Control::kBrake) != nullptr;
  Cockpit cockpit(switch_params(config, 1), "import");
  DriverInput input = initial_input(config);
  std::int64_t newest_ns = 0;
  for (const CandumpEntry& entry : log.entries) {
    const std::int64_t since_ns = entry.stamp_ns - begin_ns;
    if (since_ns < newest_ns) continue;  // stamped backwards
    newest_ns = since_ns;
    const SignalMap::Taken taken = map->take(entry.frame, since_ns, input);
    if (taken == SignalMap::Taken::kNotMapped) continue;
    const bool refused = taken == SignalMap::Taken::kBadCrc || taken == SignalMap::Taken::kBadCounter;
    if (refused) ++recorded.refused;
    if (!refused) ++(taken == SignalMap::Taken::kDecoded ? recorded.used : recorded.undecodable);
    const bool silent = since_ns >= map->silent_at_ns();
    cockpit.take(input, silent, {SimTime{since_ns}, WallTime{entry.stamp_ns}});
    const double t_s = static_cast<double>(entry.stamp_ns) * 1e-9;
    recorded.states.push_back({t_s, cockpit.state(-1, false)});
    const bool of_steering =
        !refused && steering_message.id == entry.frame.id && steering_message.extended == entry.frame.extended;
    if (!of_steering || (!recorded.steering_t_s.empty() && t_s <= recorded.steering_t_s.back())) continue;
    recorded.steering_t_s.push_back(t_s);
    recorded.steering_rad.push_back(input.steering_wheel_rad);
  }
  if (recorded.states.empty())
    return Error{log.file.string(), "holds no frame that " + config.file.filename().string() + " maps"};
  return recorded;
}

}  // namespace phare
