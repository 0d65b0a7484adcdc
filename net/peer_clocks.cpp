#include "net/peer_clocks.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "net/places.h"

namespace phare {
namespace {

template <class Peers>
auto* find_peer(Peers& peers, Sender sender, std::uint32_t channel) {
  const auto found = std::ranges::find_if(
      peers, [&](const auto& peer) { return sender_of(peer.role) == sender && peer.channel == channel; });
  return found == peers.end() ? nullptr : &*found;
}

}  // namespace

PeerClocks::PeerClocks(const Rig& rig, Role role, std::uint32_t channel) {
  const auto add = [&](Role other, std::uint32_t of, std::string name) {
    if (other == role && of == channel) return;
    peers_.push_back(
        {.role = other, .channel = of, .name = std::move(name), .endpoint = endpoint_of(rig, other, of), .clock = {}});
  };
  add(Role::kCockpit, 0, "cockpit");
  add(Role::kDynamics, 0, "dynamics");
  for (std::uint32_t of = 0; of < rig.channels.size(); ++of) add(Role::kVisual, of, "visual-" + std::to_string(of));
}

std::vector<Endpoint> PeerClocks::due(Time now) {
  constexpr std::chrono::milliseconds kAtFirst(50), kThen(1000);
  constexpr std::uint64_t kFirstRounds = 10;
  if (now < next_) return {};
  next_ = now + (rounds_++ < kFirstRounds ? kAtFirst : kThen);
  std::vector<Endpoint> asked;
  for (const Peer& peer : peers_) asked.push_back(peer.endpoint);
  return asked;
}

ClockProbe PeerClocks::question(WallTime now) {
  for (Peer& peer : peers_) {
    peer.open[peer.next_open] = now;
    peer.next_open = (peer.next_open + 1) % peer.open.size();
    ++peer.asked_count;
  }
  return {now, WallTime{}};
}

const PeerClocks::Peer* PeerClocks::peer_of(Sender sender, std::uint32_t channel) const {
  return find_peer(peers_, sender, channel);
}

void PeerClocks::answered(const ClockProbe& answer, Sender sender, std::uint32_t channel, WallTime answered_there,
                          WallTime heard, Time now) {
  Peer* const peer = find_peer(peers_, sender, channel);
  if (peer == nullptr) return;
  const auto open = std::ranges::find(peer->open, answer.asked);
  if (open == peer->open.end()) return;
  *open = WallTime{};  // once
  peer->clock.add({answer.asked, answer.heard, answered_there, heard}, now);
  tell(*peer, now);
}

void PeerClocks::tell(Peer& peer, Time now) {
  const auto estimate = peer.clock.at(now);
  if (!estimate) return;
  const double ahead_ms = static_cast<double>(estimate->ahead_ns) * 1e-6;
  const bool enough = peer.clock.exchanges() >= 8;  // the first ones wait for programs that are starting
  if ((enough && !peer.told) || peer.clock.steps() != peer.steps_told) {
    const bool set = peer.clock.steps() != peer.steps_told;
    peer.told = true;
    peer.steps_told = peer.clock.steps();
    spdlog::info("the clock of {} {}is {:.3f} ms {} this one, to {:.3f} ms", peer.name, set ? "was set: it " : "",
                 std::abs(ahead_ms), ahead_ms < 0.0 ? "behind" : "ahead of",
                 static_cast<double>(estimate->within_ns) * 1e-6);
  }
  // Said once, when it is known: larger than what it is uncertain by.
  if (!peer.drift_told && std::abs(estimate->drift_ppm) > estimate->drift_within_ppm) {
    peer.drift_told = true;
    spdlog::info("the clock of {} drifts by {:.1f} ppm against this one, to {:.1f} ppm", peer.name, estimate->drift_ppm,
                 estimate->drift_within_ppm);
  }
}

std::int64_t PeerClocks::ahead_ns(Sender sender, std::uint32_t channel, Time now) const {
  const Peer* peer = peer_of(sender, channel);
  const auto estimate = peer == nullptr ? std::nullopt : peer->clock.at(now);
  return estimate ? estimate->ahead_ns : 0;
}

void to_our_clock(Datagram& datagram, std::int64_t ahead_ns) {
  const auto shift = [&](WallTime& stamp) {
    if (stamp.ns == 0 || __builtin_sub_overflow(stamp.ns, ahead_ns, &stamp.ns)) stamp.ns = 0;  // none
  };
  shift(datagram.sent);
  const auto shift_controls = [&](CockpitState& controls) {
    shift(controls.light_change_wall);
    shift(controls.source_stamp);
  };
  if (auto* cockpit = std::get_if<CockpitState>(&datagram.payload)) shift_controls(*cockpit);
  if (auto* start = std::get_if<FrameStart>(&datagram.payload))
    shift_controls(start->controls);  // by the sender's clock
}

}  // namespace phare
