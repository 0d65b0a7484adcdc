// One bound UDP socket on IPv4, non-blocking, read in batches.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "config/base/result.h"
#include "net/sim_time.h"

namespace phare {

/// Largest payload of a UDP datagram over IPv4, bytes.
inline constexpr std::size_t kMaxDatagramBytes = 65507;

/// Where a datagram came from: IPv4 address and port, both in the machine's byte order.
struct Endpoint {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// Of dotted IPv4, in the machine's byte order; nullopt: it is none.
std::optional<std::uint32_t> ipv4_address(const std::string& dotted);

/// "127.0.0.1:47000"
std::string text_of(const Endpoint& endpoint);

/// When a datagram reached this machine, by the kernel's stamp, however long it waited for this process since.
struct ArrivalTime {
  std::chrono::steady_clock::time_point steady;
  WallTime wall;
};

class UdpSocket {
 public:
  /// Bound to `address` (dotted IPv4) and `port` (0: any free one). Error when the address is malformed or the port
  /// taken.
  static Result<UdpSocket> open(const std::string& address, std::uint16_t port);

  UdpSocket(UdpSocket&&) noexcept;
  UdpSocket& operator=(UdpSocket&&) noexcept;
  ~UdpSocket();

  /// False when the kernel refused; after hear_refusals() also where it says that nobody has that port.
  bool send_to(const Endpoint& to, std::span<const std::byte> bytes);
  /// To `port` at the socket's own address.
  bool send_to(std::uint16_t port, std::span<const std::byte> bytes);

  /// Has the kernel keep word of ports that nobody has: on this machine of what was just sent, from others of what was
  /// sent before. For sockets that only send, for receive() takes such word for an empty socket.
  void hear_refusals();

  /// The next datagram, nullopt when none waits. The view is valid until the next call.
  std::optional<std::span<const std::byte>> receive();

  /// Who sent the datagram that receive() gave last; port 0 before the first.
  Endpoint from() const;

  /// When it arrived. A step of the wall clock moves it by no more than the time since the socket was last found empty.
  ArrivalTime arrived() const;

  /// Sleeps until a datagram waits (true), or time is up or a signal came (false).
  bool wait(std::chrono::nanoseconds at_most);

  /// Lets the kernel drop what cannot be a Datagram (its first and last tag, see wire.h) before it takes room in the
  /// buffer and time of this process. False where the kernel has no socket filters; everything then arrives here.
  /// `tag_bytes` follow each datagram (net/seal.h).
  bool filter_in_kernel(std::size_t tag_bytes = 0);

  /// Datagrams the kernel has dropped since open(): by the filter, or because the buffer was full.
  std::uint64_t dropped_in_kernel() const;

  int fd() const;
  std::uint16_t port() const;

 private:
  struct State;
  explicit UdpSocket(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace phare
