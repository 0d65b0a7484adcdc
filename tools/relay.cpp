#include "tools/relay.h"

#include <poll.h>

#include <algorithm>
#include <utility>

namespace phare {

Result<Relay> Relay::open(const std::string& listen, const std::string& to, std::uint16_t port_base,
                          std::uint16_t ports, const RelayFaults& faults) {
  Relay relay;
  const auto address = ipv4_address(to);
  if (!address) return Error{to, "is not an IPv4 address such as 127.0.0.1"};
  if (listen == to) return Error{to, "passes on to itself: --listen and --to are two addresses"};
  relay.behind_ = to.starts_with("127.") && listen.starts_with("127.") ? listen : "0.0.0.0";
  relay.to_ = *address;
  relay.faults_ = faults;
  relay.random_.seed(faults.seed);
  for (std::uint16_t port = 0; port < ports; ++port) {
    auto socket = UdpSocket::open(listen, static_cast<std::uint16_t>(port_base + port));
    if (!socket) return socket.error();
    relay.fronts_.push_back(std::move(*socket));
  }
  return relay;
}

bool Relay::chance(double share_01) {
  return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < share_01;
}

std::optional<std::size_t> Relay::way_of(const Endpoint& client, std::size_t front) {
  constexpr std::size_t kMostWays = 1024;
  for (std::size_t i = 0; i < ways_.size(); ++i)
    if (ways_[i].client == client && ways_[i].front == front) return i;
  if (ways_.size() == kMostWays) return std::nullopt;
  auto behind = UdpSocket::open(behind_, 0);
  if (!behind) return std::nullopt;
  ways_.push_back({client, front, std::move(*behind)});
  return ways_.size() - 1;
}

void Relay::take(std::size_t way, bool back, std::span<const std::byte> bytes) {
  ++counts_.received;
  if (chance(faults_.loss_01)) {
    ++counts_.lost;
    return;
  }
  const bool twice = chance(faults_.duplicate_01);
  counts_.duplicated += twice ? 1 : 0;
  for (int copy = 0; copy < (twice ? 2 : 1); ++copy) {
    const auto drawn = [&] {
      const auto jitter_ns = static_cast<double>(faults_.jitter.count());
      return faults_.delay + std::chrono::nanoseconds(static_cast<std::int64_t>(
                                 std::uniform_real_distribution<double>(0.0, 1.0)(random_) * jitter_ns));
    };
    auto due = Clock::now() + drawn();
    if (chance(faults_.reorder_01)) {
      ++counts_.held_back;
      due += drawn() + std::chrono::milliseconds(1);
    }
    held_.push({due, order_++, way, back, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())});
  }
}

void Relay::pass_on(const Held& held) {
  Way& way = ways_[held.way];
  const auto bytes = std::as_bytes(std::span(held.bytes));
  const bool taken = held.back ? fronts_[way.front].send_to(way.client, bytes)
                               : way.behind.send_to(Endpoint{to_, fronts_[way.front].port()}, bytes);
  ++(taken ? counts_.passed_on : counts_.not_taken);
}

void Relay::step(std::chrono::nanoseconds at_most) {
  std::vector<pollfd> waited;
  for (const UdpSocket& front : fronts_) waited.push_back({front.fd(), POLLIN, 0});
  for (const Way& way : ways_) waited.push_back({way.behind.fd(), POLLIN, 0});
  if (!held_.empty()) at_most = std::min<std::chrono::nanoseconds>(at_most, held_.top().due - Clock::now());
  const std::int64_t ns = std::max<std::int64_t>(at_most.count(), 0);
  const timespec limit{static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
  ppoll(waited.data(), waited.size(), &limit, nullptr);

  for (std::size_t front = 0; front < fronts_.size(); ++front) {
    while (const auto bytes = fronts_[front].receive()) {
      const auto way = way_of(fronts_[front].from(), front);
      if (way) take(*way, false, *bytes);
      if (!way) ++counts_.received, ++counts_.not_taken;
    }
  }
  for (std::size_t way = 0; way < ways_.size(); ++way)
    while (const auto bytes = ways_[way].behind.receive()) take(way, true, *bytes);
  while (!held_.empty() && held_.top().due <= Clock::now()) {
    pass_on(held_.top());
    held_.pop();
  }
}

}  // namespace phare
