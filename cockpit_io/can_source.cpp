#include "cockpit_io/can_source.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace phare {

namespace {

constexpr std::int64_t kReopenEvery_ns = 500'000'000;
constexpr int kMostFramesPerCall = 10'000;  // more than a bus carries in a second: a flood cannot hold up the cockpit

/// The point of simulated time at which a wall stamp of the recent past lay.
Moment at_stamp(WallTime stamp, Moment now) {
  const std::int64_t age_ns = std::max<std::int64_t>(now.wall.ns - stamp.ns, 0);
  return {SimTime{std::max<std::int64_t>(now.sim.ns - age_ns, 0)}, stamp};
}

}  // namespace

Result<std::unique_ptr<Source>> CanSource::open(const std::string& interface, SignalMap map) {
  if (const Status supported = can_supported(); !supported) return Error{interface, supported.error().reason};
  std::unique_ptr<CanSource> source(new CanSource(interface, std::move(map)));
  source->reopen(wall_now());
  return std::unique_ptr<Source>(std::move(source));
}

void CanSource::reopen(WallTime now) {
  if (now.ns < next_open_ns_) return;
  next_open_ns_ = now.ns + kReopenEvery_ns;
  const auto ids = map_.ids();
  auto opened = CanSocket::open(interface_, ids);
  if (!opened) return lose(opened.error().reason);
  socket_.emplace(std::move(*opened));
  link_up_ = true;
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
}

void CanSource::take(const CanSocket::Received& received, Moment now, Cockpit& cockpit) {
  ++counts_.frames_read;
  if (!link_up_) {
    link_up_ = true;
    ++counts_.reconnects;
    spdlog::info("{}: link up again", interface_);
  }
  if (received.frame.error) {
    ++counts_.error_frames;
    return;
  }
  switch (map_.take(received.frame, received.stamp.ns, input_)) {
    case SignalMap::Taken::kNotMapped:
      return;
    case SignalMap::Taken::kIncomplete:
      ++counts_.incomplete;
      break;
    case SignalMap::Taken::kDecoded:
      ++counts_.decoded;
      break;
  }
  if (on_frame) on_frame(received.stamp);
  // Silent until every message is back: the others' controls may still be wrong.
  cockpit.take(input_, now.wall.ns >= map_.silent_at_ns(), at_stamp(received.stamp, now));
}

void CanSource::advance(Moment now, const VehicleState*, Cockpit& cockpit) {
  if (!socket_) reopen(now.wall);
  for (int i = 0; socket_ && i < kMostFramesPerCall; ++i) {
    if (const auto received = socket_->receive()) {
      take(*received, now, cockpit);
      continue;
    }
    if (socket_->why() == CanSocket::Nothing::kLinkDown) {
      if (link_up_) spdlog::warn("{}: link down", interface_);
      link_up_ = false;
    } else if (socket_->why() == CanSocket::Nothing::kGone) {
      lose("interface gone");
      next_open_ns_ = now.wall.ns + kReopenEvery_ns;
    }
    break;
  }
  counts_.dropped = dropped_before_ + (socket_ ? socket_->dropped() : 0);

  const bool silent = now.wall.ns >= map_.silent_at_ns();
  if (silent && !silent_) {
    ++counts_.fail_safes;
    spdlog::warn("{}: silent; low beam on", interface_);
  } else if (!silent && silent_) {
    spdlog::info("{}: speaks again", interface_);
  }
  silent_ = silent;
  cockpit.take(input_, silent, now);
}

std::string CanSource::status() const {
  if (!socket_ || !link_up_) return "down";
  return silent_ ? "silent" : "up";
}

}  // namespace phare
