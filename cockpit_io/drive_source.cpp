#include "cockpit_io/drive_source.h"

#include <algorithm>
#include <variant>

#include "net/drive_file.h"

namespace phare {

Result<std::unique_ptr<Source>> DriveSource::open(const std::filesystem::path& file) {
  Result<Drive> drive = read_drive(file);
  if (!drive) return drive.error();
  auto source = std::make_unique<DriveSource>();
  source->end_ = drive->duration;
  for (const Datagram& datagram : drive->datagrams) {
    if (const auto* state = std::get_if<CockpitState>(&datagram.payload))
      source->entries_.push_back({datagram.sim_time, *state});
  }
  // A recorder writes in order of arrival; a cockpit that was restarted may have gone back.
  std::stable_sort(source->entries_.begin(), source->entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.due < b.due; });
  if (source->entries_.empty()) {
    CockpitState low;
    low.light_switch = LightSwitch::kLow;
    source->entries_.push_back({SimTime{}, low});
  }
  return std::unique_ptr<Source>(std::move(source));
}

void DriveSource::advance(Moment now, const VehicleState*, ControlSink& cockpit) {
  for (; next_ < entries_.size() && entries_[next_].due <= now.sim; ++next_) {
    const Entry& entry = entries_[next_];
    ++counts_.frames_read;
    ++counts_.decoded;
    cockpit.take_recorded(entry.state, {entry.due, WallTime{now.wall.ns - (now.sim.ns - entry.due.ns)}});
  }
  ended_ = now.sim >= end_;
}

}  // namespace phare
