#include "cockpit_io/can_source.h"

#include <linux/can/error.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "cockpit_io/can_link.h"

namespace phare {

namespace {

constexpr std::int64_t kReopenEvery_ns = 500'000'000;
constexpr std::int64_t kLookEvery_ns = 250'000'000;       // at the link's state and counters
constexpr std::int64_t kRestartAfter_ns = 1'000'000'000;  // of bus-off: a kernel that restarts by itself is quicker
constexpr std::int64_t kShowRefused_ns = 2'000'000'000;
constexpr int kMostFramesPerCall = 10'000;  // more than a bus carries in a second: a flood cannot hold up the cockpit

/// The point of simulated time at which a wall stamp of the recent past lay.
Moment at_stamp(WallTime stamp, Moment now) {
  const std::int64_t age_ns = std::max<std::int64_t>(now.wall.ns - stamp.ns, 0);
  return {SimTime{std::max<std::int64_t>(now.sim.ns - age_ns, 0)}, stamp};
}

}  // namespace

CanSource::CanSource(std::string interface, SignalMap map, Feedback feedback)
    : interface_(std::move(interface)), map_(std::move(map)), feedback_(std::move(feedback)) {
  input_ = initial_input(map_.config());
}

Result<std::unique_ptr<Source>> CanSource::open(const std::string& interface, SignalMap map, Feedback feedback) {
  if (const Status supported = can_supported(); !supported) return Error{interface, supported.error().reason};
  std::unique_ptr<CanSource> source(new CanSource(interface, std::move(map), std::move(feedback)));
  source->reopen(wall_now());
  return std::unique_ptr<Source>(std::move(source));
}

// ---- the interface

void CanSource::reopen(WallTime now) {
  if (now.ns < next_open_ns_) return;
  next_open_ns_ = now.ns + kReopenEvery_ns;
  const auto ids = map_.ids();
  auto opened = CanSocket::open(interface_, ids);
  if (!opened) return lose(opened.error().reason);
  socket_.emplace(std::move(*opened));
  link_up_ = true;
  bus_ = BusState::kActive;
  link_dropped_before_ = counts_.link_dropped;
  link_dropped_now_ = can_link_dropped(interface_);
  if (said_lost_) {
    said_lost_ = false;
    ++counts_.reconnects;
    spdlog::info("{}: back", interface_);
  }
}

void CanSource::lose(const std::string& why) {
  if (socket_) dropped_before_ += socket_->dropped();
  socket_.reset();
  if (!said_lost_) spdlog::warn("{}: {}; trying again every 500 ms", interface_, why);
  said_lost_ = true;
  why_lost_ = why.substr(0, why.find(';'));
}

void CanSource::link_is_up() {
  if (link_up_) return;
  link_up_ = true;
  ++counts_.reconnects;
  spdlog::info("{}: link up again", interface_);
}

/// What the socket does not tell: that the link is up again, what the interface dropped, that bus-off lasts.
void CanSource::watch_link(WallTime now) {
  if (!socket_ || now.ns < next_look_ns_) return;
  next_look_ns_ = now.ns + kLookEvery_ns;
  if (!link_up_ && can_link_up(interface_)) link_is_up();
  const std::uint64_t dropped = can_link_dropped(interface_);
  if (dropped >= link_dropped_now_) counts_.link_dropped = link_dropped_before_ + (dropped - link_dropped_now_);
  if (bus_ != BusState::kOff || now.ns < next_restart_ns_) return;
  next_restart_ns_ = now.ns + kRestartAfter_ns;
  if (const Status restarted = restart_can_link(interface_); !restarted && !said_no_restart_) {
    said_no_restart_ = true;
    spdlog::warn("{}", restarted.error().text());
  }
}

// ---- frames

void CanSource::enter(BusState state, WallTime now) {
  if (state == bus_) return;
  if (state == BusState::kOff) {
    ++counts_.bus_offs;
    next_restart_ns_ = now.ns + kRestartAfter_ns;
    spdlog::warn("{}: bus-off: the controller has left the bus; low beam on", interface_);
  } else if (bus_ == BusState::kOff) {
    ++counts_.reconnects;
    spdlog::info("{}: on the bus again", interface_);
  } else if (state == BusState::kPassive) {
    spdlog::warn("{}: error-passive: wiring, termination or bit rate?", interface_);
  } else {
    spdlog::info("{}: error-active again", interface_);
  }
  bus_ = state;
}

void CanSource::take_error(const CanFrame& frame, WallTime now) {
  ++counts_.error_frames;
  if ((frame.id & CAN_ERR_RESTARTED) != 0) return enter(BusState::kActive, now);
  if ((frame.id & CAN_ERR_BUSOFF) != 0) return enter(BusState::kOff, now);
  if ((frame.id & CAN_ERR_CRTL) == 0 || bus_ == BusState::kOff) return;
  const unsigned detail = frame.data[1];
  if ((detail & CAN_ERR_CRTL_ACTIVE) != 0) enter(BusState::kActive, now);
  if ((detail & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) enter(BusState::kPassive, now);
}

void CanSource::take(const CanSocket::Received& received, Moment now, ControlSink& cockpit) {
  ++counts_.frames_read;
  link_is_up();
  if (received.frame.error) return take_error(received.frame, now.wall);
  const SignalMap::Taken taken = map_.take(received.frame, received.stamp.ns, input_);
  switch (taken) {
    case SignalMap::Taken::kNotMapped:
      return;
    case SignalMap::Taken::kBadCrc:
    case SignalMap::Taken::kBadCounter: {
      const bool crc = taken == SignalMap::Taken::kBadCrc;
      ++(crc ? counts_.bad_crc : counts_.bad_counter);
      refused_until_ns_ = now.wall.ns + kShowRefused_ns;
      refused_ = map_.dbc().find(received.frame.id, received.frame.extended)->name +
                 (crc ? " refused: its CRC is wrong" : " refused: its counter stands still or jumps");
      if (!said_refused_) spdlog::warn("{}: {}; such frames are counted from here on", interface_, refused_);
      said_refused_ = true;
      return;
    }
    case SignalMap::Taken::kIncomplete:
      ++counts_.incomplete;
      break;
    case SignalMap::Taken::kDecoded:
      ++counts_.decoded;
      break;
  }
  if (bus_ == BusState::kOff) enter(BusState::kActive, now.wall);  // drivers that do not report a restart
  counts_.lost_in_data = map_.lost();
  if (on_frame) on_frame(received.stamp);
  // Silent until every message is back: the others' controls may still be wrong.
  cockpit.take(input_, silent(now.wall), at_stamp(received.stamp, now));
}

bool CanSource::silent(WallTime now) const {
  return now.ns >= map_.silent_at_ns() || bus_ == BusState::kOff;
}

void CanSource::advance(Moment now, const VehicleState*, ControlSink& cockpit) {
  if (!socket_) reopen(now.wall);
  for (int i = 0; socket_ && i < kMostFramesPerCall; ++i) {
    if (const auto received = socket_->receive()) {
      take(*received, now, cockpit);
      continue;
    }
    if (socket_->why() == CanSocket::Nothing::kLinkDown) {
      if (link_up_) spdlog::warn("{}: link down", interface_);
      link_up_ = false;
      next_look_ns_ = now.wall.ns + kLookEvery_ns;
    } else if (socket_->why() == CanSocket::Nothing::kGone) {
      lose("interface gone");
      next_open_ns_ = now.wall.ns + kReopenEvery_ns;
    }
    break;
  }
  watch_link(now.wall);
  counts_.dropped = dropped_before_ + (socket_ ? socket_->dropped() : 0);

  const bool is_silent = silent(now.wall);
  if (is_silent && !silent_) {
    ++counts_.fail_safes;
    if (bus_ != BusState::kOff) spdlog::warn("{}: {} silent; low beam on", interface_, map_.most_silent());
  } else if (!is_silent && silent_) {
    spdlog::info("{}: speaks again", interface_);
  }
  silent_ = is_silent;
  cockpit.take(input_, is_silent, now);
}

void CanSource::remember(Memory& memory) {
  memory.field(input_);
  map_.remember(memory);
}

void CanSource::send_back(const FeedbackValues& values, WallTime now) {
  if (!socket_ || !link_up_ || bus_ == BusState::kOff) return;
  for (const CanFrame& frame : feedback_.due(values, now.ns))
    ++(socket_->send(frame) ? counts_.sent : counts_.not_sent);
}

std::vector<int> CanSource::wait_fds() const {
  // A link that is down reports so once; waiting for it would return at once for ever.
  if (!socket_ || !link_up_) return {};
  return {socket_->fd()};
}

std::string CanSource::status() const {
  if (!socket_ || !link_up_) return "down";
  if (bus_ == BusState::kOff) return "bus-off";
  return silent_ ? "silent" : "up";
}

std::string CanSource::fault() const {
  if (!socket_) return interface_ + ": " + why_lost_;
  if (!link_up_) return interface_ + ": link down";
  if (bus_ == BusState::kOff) return interface_ + ": bus-off";
  if (silent_) return interface_ + ": " + map_.most_silent() + " silent";
  if (wall_now().ns < refused_until_ns_) return interface_ + ": " + refused_;
  return bus_ == BusState::kPassive ? interface_ + ": error-passive" : std::string();
}

}  // namespace phare
