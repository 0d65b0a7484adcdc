// The bus as one process sees it: its socket, the numbering of what it sends, an inbox for everything it receives.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "config/base/result.h"
#include "config/rig.h"
#include "net/alive.h"
#include "net/channels.h"
#include "net/inbox.h"
#include "net/messages.h"
#include "net/peer_clocks.h"
#include "net/seal.h"
#include "net/udp.h"
#include "net/wire.h"

namespace phare {

struct BusCounters {
  std::array<InboxCounters, kChannels.size()> received{};  ///< by payload index, all sender channels together
  std::array<std::uint64_t, kChannels.size()> sent{};      ///< datagrams numbered, by payload index
  std::array<std::uint64_t, kRefusals> refused_because{};  ///< by Refusal
  std::uint64_t refused = 0;                               ///< not taken, by this process or its socket filter
  std::uint64_t refused_in_kernel = 0;  ///< of them those that never reached the process: filtered, or no room
  std::uint64_t send_failures = 0;      ///< the kernel did not take a datagram
  std::uint64_t not_sent = 0;           ///< payloads of ours that no receiver would take
};

class Bus {
 public:
  template <class T>
  using Newest = phare::Newest<T>;

  /// Binds the port of `role` (and `channel`, for a visual process). Error when it is taken, when the rig has no such
  /// channel, or when an address of its bus lies off loopback and it has no key.
  static Result<Bus> open(const Rig& rig, Role role, std::uint32_t channel = 0);

  /// For one who speaks beside whoever holds the port of the role: bound to any free port, it hears only answers. Off
  /// loopback it may do so from any machine that has the key.
  static Result<Bus> open_to_send(const Rig& rig, Role role);

  /// Numbers, stamps and encodes the payload and sends it to every receiver of its row in kChannels. A payload that no
  /// receiver would take (NaN, out of range) is not sent but counted and logged, at most once a second.
  void send(SimTime now, const Payload& payload);

  /// Sends to the port alone that the datagram in hand came from: within on_datagram.
  void answer(SimTime now, const Payload& payload);

  /// The last datagram of a payload type (kPayloadIndex<T>) again, under its number and with the time of now as when
  /// it was sent; nothing when there was none.
  void send_again(std::size_t payload_index);

  /// Drains the socket into the inboxes: at most 4096 datagrams and two milliseconds of processor time per call,
  /// that a flood cannot hold up the caller. Returns how many are new to take().
  std::size_t poll();

  /// From now on every poll() leaves a sign of life in this file (net/alive.h). Returns when it says that all others
  /// are ready too, or `stop` does. Empty: at once, and none is left.
  Status ready_with_the_others(const std::filesystem::path& alive_file, const std::function<bool()>& stop);
  /// Tells whoever watches that file that this process ends by RigControl::Quit.
  void leaves_as_told();

  /// Sleeps until something waits (true), or time is up or a signal came (false).
  bool wait(std::chrono::nanoseconds at_most);

  /// The newest valid message, nullptr before the first. `channel`: of which visual process, for FrameReport,
  /// ProbeReply and KeyInput.
  template <class T>
  const Newest<T>* newest(std::uint32_t channel = 0) const {
    const auto& inboxes = std::get<std::vector<Inbox<T>>>(inboxes_);
    return channel < inboxes.size() ? inboxes[channel].newest() : nullptr;
  }

  /// The newest valid message if it has not been taken yet. A FrameReport that was repeated can be taken again.
  template <class T>
  std::optional<Newest<T>> take(std::uint32_t channel = 0) {
    auto& inboxes = std::get<std::vector<Inbox<T>>>(inboxes_);
    if (channel >= inboxes.size()) return std::nullopt;
    const Newest<T>* taken = inboxes[channel].take();
    return taken ? std::optional<Newest<T>>(*taken) : std::nullopt;
  }

  /// Called within poll() for every datagram that became the newest of its stream, in the order of arrival. For those
  /// who must not miss one (recorder, RigControl): take() gives only the newest.
  std::function<void(const Datagram&, std::span<const std::byte>)> on_datagram;

  /// Called within poll() when the newest datagram of a stream arrives once more.
  std::function<void(const Datagram&)> on_repeat;

  const BusCounters& counters() const { return counters_; }
  int fd() const { return socket_.fd(); }  ///< to wait for it beside others
  std::uint64_t start_id() const { return start_id_; }
  Role role() const { return role_; }
  std::uint32_t channel() const { return channel_; }
  std::uint32_t channels() const { return channels_; }                 ///< visual processes of the rig
  const std::optional<PeerClocks>& clocks() const { return clocks_; }  ///< where processes have places of their own

 private:
  Bus(UdpSocket socket, const Rig& rig, Role role, std::uint32_t channel);

  bool accept(std::span<const std::byte> bytes);
  Refusal judge(std::span<const std::byte> sealed, std::span<const std::byte>& bytes);
  void take_clock(const ClockProbe& probe, const ArrivalTime& arrived);
  void ask_clocks();
  void refuse(Refusal refusal);
  bool encode_next(SimTime now, const Payload& payload);
  void transmit(std::size_t payload_index);
  void log_refusals();

  UdpSocket socket_;
  std::optional<AliveFile> alive_;
  Seal seal_;
  std::optional<Replays> replays_;  // where there is a key
  Role role_;
  std::uint32_t channel_;
  std::uint32_t channels_;
  std::array<std::vector<Endpoint>, kAllRoles.size()> endpoints_;  // by role and channel
  std::optional<PeerClocks> clocks_;
  std::uint64_t start_id_;

  std::tuple<std::vector<Inbox<CockpitState>>, std::vector<Inbox<VehicleState>>, std::vector<Inbox<FrameReport>>,
             std::vector<Inbox<RigControl>>, std::vector<Inbox<ProbeRequest>>, std::vector<Inbox<ProbeReply>>,
             std::vector<Inbox<KeyInput>>, std::vector<Inbox<ControlReply>>, std::vector<Inbox<LawAnswer>>,
             std::vector<Inbox<LampState>>, std::vector<Inbox<FrameStart>>>
      inboxes_;                                           // one per sender channel
  std::array<std::string, kChannels.size()> last_bytes_;  // sealed
  std::array<std::optional<Datagram>, kChannels.size()> last_sent_;
  BusCounters counters_;
  Datagram incoming_;  // reused
  struct Second {
    std::size_t payload_index = 0;
    Endpoint from;
  };
  Second second_;  // who was refused last because another speaks
  std::chrono::steady_clock::time_point next_log_;
  std::uint64_t refused_logged_ = 0, seconds_logged_ = 0;
};

}  // namespace phare
