#include "net/bus.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <ctime>
#include <random>
#include <thread>
#include <utility>

#include "config/port_base.h"
#include "net/places.h"

namespace phare {
namespace {

constexpr std::size_t kMaxDatagramsPerPoll = 4096;
constexpr std::size_t kDatagramsPerTimeCheck = 64;
constexpr std::int64_t kMaxPollCpu_ns = 2'000'000;
constexpr std::chrono::seconds kLogInterval{1};

/// Processor time of this thread: on a loaded machine the wall clock would end a poll before it has done anything.
std::int64_t cpu_now_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

/// Two starts never share one, and 0 means none.
std::uint64_t draw_start_id() {
  std::random_device random;
  std::uint64_t id = 0;
  while (id == 0) id = (static_cast<std::uint64_t>(random()) << 32) | random();
  return id;
}

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace

namespace {

static_assert(kHighestPortBase + kMaxPortOffset <= 65535);

/// What keeps a rig from having a bus.
Status check_rig(const Rig& rig) {
  const std::string place = rig.file.string();
  const std::size_t channels = std::max<std::size_t>(rig.channels.size(), 1);
  if (channels > kMaxChannels) {
    return Error{place, std::to_string(channels) + " channels, at most " + std::to_string(kMaxChannels)};
  }
  for (const std::string& address : bus_addresses(rig)) {
    if (!is_ipv4(address)) return Error{place, address + " is not an IPv4 address such as 127.0.0.1"};
    if (!address.starts_with("127.") && !rig.bus_key)
      return Error{place, address + " lies off loopback: a key_file is required there"};
  }
  if (rig.port_base > 65535 - kMaxPortOffset) {
    return Error{place, "port base " + std::to_string(rig.port_base) + " leaves no room for " +
                            std::to_string(kMaxPortOffset + 1) + " ports"};
  }
  return Done{};
}

}  // namespace

Result<Bus> Bus::open(const Rig& rig, Role role, std::uint32_t channel) {
  const std::size_t channels = std::max<std::size_t>(rig.channels.size(), 1);
  if (role == Role::kVisual ? channel >= channels : channel != 0) {
    return Error{rig.file.string(), "has no channel " + std::to_string(channel) +
                                        " (channels count from 0, there are " + std::to_string(channels) + ")"};
  }
  if (const Status fine = check_rig(rig); !fine) return fine.error();
  const auto port = static_cast<std::uint16_t>(rig.port_base + port_offset(role, channel));
  Result<UdpSocket> socket = UdpSocket::open(address_to_bind(rig, role, channel), port);
  if (!socket) return socket.error();
  if (!socket->filter_in_kernel(Seal(rig.bus_key).tag_bytes()))
    spdlog::debug("no socket filter in this kernel: garbage is refused by the process itself");
  return Bus(std::move(*socket), rig, role, channel);
}

Result<Bus> Bus::open_to_send(const Rig& rig, Role role) {
  if (const Status fine = check_rig(rig); !fine) return fine.error();
  // Answers go to where the question came from: the kernel chooses the address that leads there.
  Result<UdpSocket> socket = UdpSocket::open(off_loopback(rig) ? "0.0.0.0" : address_to_bind(rig, role), 0);
  if (!socket) return socket.error();
  return Bus(std::move(*socket), rig, role, 0);
}

Bus::Bus(UdpSocket socket, const Rig& rig, Role role, std::uint32_t channel)
    : socket_(std::move(socket)),
      seal_(rig.bus_key),
      role_(role),
      channel_(channel),
      channels_(static_cast<std::uint32_t>(std::max<std::size_t>(rig.channels.size(), 1))),
      start_id_(draw_start_id()),
      next_log_(std::chrono::steady_clock::now()) {
  if (rig.bus_key) replays_.emplace(off_loopback(rig) ? Replays::kClocksApart : Replays::kOneClock);
  for (const Role each : kAllRoles)
    for (std::uint32_t of = 0; of < (each == Role::kVisual ? channels_ : 1); ++of)
      endpoints_[static_cast<std::size_t>(each)].push_back(endpoint_of(rig, each, of));
  if (has_places(rig) && channel_of<ClockProbe>().receivers.has(role)) clocks_.emplace(rig, role, channel);
  std::get<std::vector<Inbox<CockpitState>>>(inboxes_).resize(1);
  std::get<std::vector<Inbox<VehicleState>>>(inboxes_).resize(1);
  std::get<std::vector<Inbox<FrameReport>>>(inboxes_).resize(channels_);
  std::get<std::vector<Inbox<RigControl>>>(inboxes_).resize(1);
  std::get<std::vector<Inbox<ProbeRequest>>>(inboxes_).resize(1);
  std::get<std::vector<Inbox<ProbeReply>>>(inboxes_).resize(channels_);
  std::get<std::vector<Inbox<KeyInput>>>(inboxes_).resize(channels_);
  std::get<std::vector<Inbox<ControlReply>>>(inboxes_).resize(channels_);
  std::get<std::vector<Inbox<LawAnswer>>>(inboxes_).resize(1);
  std::get<std::vector<Inbox<LampState>>>(inboxes_).resize(channels_);
  std::get<std::vector<Inbox<FrameStart>>>(inboxes_).resize(channels_);
}

void Bus::send(SimTime now, const Payload& payload) {
  if (encode_next(now, payload)) transmit(payload.index());
}

void Bus::answer(SimTime now, const Payload& payload) {
  if (!encode_next(now, payload)) return;
  if (!socket_.send_to(socket_.from(), bytes_of(last_bytes_[payload.index()]))) ++counters_.send_failures;
}

/// Numbers, stamps and encodes into last_bytes_; false, counted and logged, when no receiver would take it.
bool Bus::encode_next(SimTime now, const Payload& payload) {
  const std::size_t index = payload.index();
  Datagram datagram{sender_of(role_), channel_, start_id_, counters_.sent[index] + 1, now, wall_now(), payload};
  if (const Refusal refusal = check(datagram); refusal != Refusal::kNone) {
    ++counters_.not_sent;
    const auto wall = std::chrono::steady_clock::now();
    if (wall >= next_log_) {
      next_log_ = wall + kLogInterval;
      spdlog::error("{} not sent: {} ({} so far)", kChannels[index].message, refusal_text(refusal), counters_.not_sent);
    }
    return false;
  }
  ++counters_.sent[index];
  encode_into(datagram, last_bytes_[index]);
  seal_.close(last_bytes_[index]);
  last_sent_[index] = std::move(datagram);
  return true;
}

void Bus::send_again(std::size_t payload_index) {
  if (payload_index >= last_sent_.size() || !last_sent_[payload_index]) return;
  Datagram& datagram = *last_sent_[payload_index];
  datagram.sent = wall_now();
  encode_into(datagram, last_bytes_[payload_index]);
  seal_.close(last_bytes_[payload_index]);
  transmit(payload_index);
}

void Bus::transmit(std::size_t payload_index) {
  const Channel& row = kChannels[payload_index];
  const auto send_to = [&](Role role, std::uint32_t channel) {
    const Endpoint& to = endpoints_[static_cast<std::size_t>(role)][channel];
    if (!socket_.send_to(to, bytes_of(last_bytes_[payload_index]))) ++counters_.send_failures;
  };
  // The recorder first: on one machine its record then has every cause before its effects.
  for (const Role role : {Role::kRecorder, Role::kCockpit, Role::kDynamics, Role::kControl, Role::kLaw}) {
    if (row.receivers.has(role)) send_to(role, 0);
  }
  if (row.receivers.has(Role::kVisual)) {
    const std::uint32_t count = row.first_visual_only ? 1 : channels_;
    for (std::uint32_t channel = 0; channel < count; ++channel)
      if (role_ != Role::kVisual || channel != channel_) send_to(Role::kVisual, channel);
  }
}

std::size_t Bus::poll() {
  if (alive_) alive_->beat();
  if (clocks_) ask_clocks();
  std::size_t news = 0;
  const std::int64_t give_up_ns = cpu_now_ns() + kMaxPollCpu_ns;
  for (std::size_t count = 1; count <= kMaxDatagramsPerPoll; ++count) {
    const auto bytes = socket_.receive();
    if (!bytes) break;
    if (accept(*bytes)) ++news;
    if (count % kDatagramsPerTimeCheck == 0 && cpu_now_ns() >= give_up_ns) break;
  }

  const auto dropped = static_cast<std::uint32_t>(socket_.dropped_in_kernel());
  const std::uint32_t more =
      dropped - static_cast<std::uint32_t>(counters_.refused_in_kernel);  // wraps as the kernel's count
  counters_.refused_in_kernel += more;
  counters_.refused += more;
  if (counters_.refused != refused_logged_) log_refusals();
  return news;
}

/// Decodes into incoming_; what it is refused for, if anything.
Refusal Bus::judge(std::span<const std::byte> sealed, std::span<const std::byte>& bytes) {
  const auto opened = seal_.open(sealed);
  if (!opened) return Refusal::kKey;
  bytes = *opened;
  if (const Refusal refusal = decode_into(bytes, incoming_); refusal != Refusal::kNone) return refusal;
  const Channel& row = kChannels[incoming_.payload.index()];
  const bool for_us =
      row.receivers.has(role_) && !(row.first_visual_only && channel_ != 0) && incoming_.sender_channel < channels_;
  return for_us ? Refusal::kNone : Refusal::kNotForUs;
}

/// Answers a question; of an answer learns how the sender's clock stands. Of whatever age: a question costs an answer,
/// and an answer is taken once, to a question of ours.
void Bus::take_clock(const ClockProbe& probe, const ArrivalTime& arrived) {
  ++counters_.received[kPayloadIndex<ClockProbe>].received;
  if (probe.heard.ns == 0) {
    answer(incoming_.sim_time, ClockProbe{probe.asked, arrived.wall});
  } else if (clocks_) {
    clocks_->answered(probe, incoming_.sender, incoming_.sender_channel, incoming_.sent, arrived.wall, arrived.steady);
  }
}

void Bus::ask_clocks() {
  const std::vector<Endpoint> asked = clocks_->due(std::chrono::steady_clock::now());
  if (asked.empty() || !encode_next(SimTime{}, clocks_->question(wall_now()))) return;
  for (const Endpoint& endpoint : asked)
    if (!socket_.send_to(endpoint, bytes_of(last_bytes_[kPayloadIndex<ClockProbe>]))) ++counters_.send_failures;
}

bool Bus::accept(std::span<const std::byte> sealed) {
  std::span<const std::byte> bytes;
  if (const Refusal refusal = judge(sealed, bytes); refusal != Refusal::kNone) {
    refuse(refusal);
    return false;
  }
  const ArrivalTime arrived = socket_.arrived();
  if (const auto* probe = std::get_if<ClockProbe>(&incoming_.payload)) {
    take_clock(*probe, arrived);
    return false;
  }
  const std::int64_t ahead_ns =
      clocks_ ? clocks_->ahead_ns(incoming_.sender, incoming_.sender_channel, arrived.steady) : 0;
  if (replays_ && replays_->is_replay(incoming_, WallTime{arrived.wall.ns + ahead_ns})) {
    refuse(Refusal::kReplay);
    return false;
  }
  const WallTime sent_there = incoming_.sent;
  if (ahead_ns != 0) to_our_clock(incoming_, ahead_ns);
  const std::size_t index = incoming_.payload.index();
  const Channel& row = kChannels[index];

  const Arrival arrival = std::visit(
      [&](const auto& payload) {
        using T = std::decay_t<decltype(payload)>;
        if constexpr (std::is_same_v<T, ClockProbe>) {
          return Arrival::kLate;  // never comes here
        } else {
          auto& inbox = std::get<std::vector<Inbox<T>>>(inboxes_)[incoming_.sender_channel];
          InboxCounters& sum = counters_.received[index];
          const InboxCounters before = inbox.counters();
          const Arrival judged = inbox.deliver(incoming_, payload, arrived, socket_.from(), row.repeat_is_news);
          sum += inbox.counters();
          sum -= before;
          return judged;
        }
      },
      incoming_.payload);
  if (arrival == Arrival::kSecond) {
    second_ = {index, socket_.from()};
    refuse(Refusal::kSecond);
    return false;
  }
  if (replays_) replays_->taken(incoming_, sent_there);
  if (arrival == Arrival::kNewest) {
    if (on_datagram) on_datagram(incoming_, bytes);
    return true;
  }
  if (arrival == Arrival::kNewestAgain) {
    if (on_repeat) on_repeat(incoming_);
    return row.repeat_is_news;
  }
  return false;
}

void Bus::refuse(Refusal refusal) {
  ++counters_.refused;
  ++counters_.refused_because[static_cast<std::size_t>(refusal)];
}

void Bus::log_refusals() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_log_) return;
  next_log_ = now + kLogInterval;
  std::size_t main_reason = 0;
  for (std::size_t i = 1; i < kRefusals; ++i) {
    if (counters_.refused_because[i] > counters_.refused_because[main_reason]) main_reason = i;
  }
  const std::string others =
      main_reason == 0 ? "" : std::string("; most of the others: ") + refusal_text(static_cast<Refusal>(main_reason));
  spdlog::warn("refused {} datagrams, {} in all ({} by the kernel{})", counters_.refused - refused_logged_,
               counters_.refused, counters_.refused_in_kernel, others);
  refused_logged_ = counters_.refused;
  const std::uint64_t seconds = counters_.refused_because[static_cast<std::size_t>(Refusal::kSecond)];
  if (seconds != seconds_logged_)
    spdlog::warn("a second sender of {} speaks from {}: {} datagrams refused until the first is silent for {} ms",
                 kChannels[second_.payload_index].message, text_of(second_.from), seconds - seconds_logged_,
                 taken_over_after(kChannels[second_.payload_index]).count() / 1'000'000);
  seconds_logged_ = seconds;
}

Status Bus::ready_with_the_others(const std::filesystem::path& alive_file, const std::function<bool()>& stop) {
  if (alive_file.empty()) return Done{};
  Result<AliveFile> alive = AliveFile::open(alive_file);
  if (!alive) return alive.error();
  alive_.emplace(std::move(*alive));
  for (alive_->beat(); !alive_->is_let_go() && !stop(); alive_->beat())
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return Done{};
}

void Bus::leaves_as_told() {
  if (alive_) alive_->leaves_as_told();
}

bool Bus::wait(std::chrono::nanoseconds at_most) {
  return socket_.wait(at_most);
}

}  // namespace phare
