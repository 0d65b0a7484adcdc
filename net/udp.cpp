#include "net/udp.h"

#include <arpa/inet.h>
#include <linux/filter.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace phare {
namespace {

constexpr std::size_t kBatch = 32;            // datagrams per recvmmsg
constexpr std::size_t kSlotBytes = 65536;     // > kMaxDatagramBytes
constexpr int kReceiveBufferBytes = 4 << 20;  // some seconds of the whole bus while a process is busy drawing
// Offsets in a UDP socket's filter count from the UDP header.
constexpr std::uint32_t kUdpHeaderBytes = 8;

/// From the kernel's stamp in `message`, read at `read`, of a socket that was empty at `seen_empty`.
ArrivalTime arrival_of(msghdr& message, const ArrivalTime& read, std::chrono::steady_clock::time_point seen_empty) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec stamp{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    const std::int64_t waited_ns =
        std::clamp<std::int64_t>(read.wall.ns - wall_shift_ns() - (stamp.tv_sec * kNsPerSecond + stamp.tv_nsec), 0,
                                 std::chrono::nanoseconds(read.steady - seen_empty).count());
    return {read.steady - std::chrono::nanoseconds(waited_ns), WallTime{read.wall.ns - waited_ns}};
  }
  return read;
}

}  // namespace

struct UdpSocket::State {
  int fd = -1;
  sockaddr_in address{};
  std::uint16_t port = 0;

  // One batch of received datagrams and how far it has been handed out.
  std::unique_ptr<std::byte[]> slots{new std::byte[kBatch * kSlotBytes]};  // not zeroed: pages never used cost nothing
  std::array<iovec, kBatch> pieces{};
  std::array<mmsghdr, kBatch> messages{};
  std::array<sockaddr_in, kBatch> senders{};
  struct alignas(cmsghdr) Control {
    std::array<char, CMSG_SPACE(sizeof(timespec))> bytes;
  };
  std::array<Control, kBatch> controls{};
  std::size_t filled = 0;
  std::size_t next = 0;
  Endpoint from;
  ArrivalTime arrived, read;                                                            // of the one, and of its batch
  bool hears_refusals = false;
  std::chrono::steady_clock::time_point seen_empty = std::chrono::steady_clock::now();  // nothing in it came earlier

  State() {
    for (std::size_t i = 0; i < kBatch; ++i) {
      pieces[i] = {slots.get() + i * kSlotBytes, kSlotBytes};
      messages[i].msg_hdr.msg_iov = &pieces[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      messages[i].msg_hdr.msg_name = &senders[i];
      messages[i].msg_hdr.msg_control = controls[i].bytes.data();
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (fd >= 0) close(fd);
  }
};

std::optional<std::uint32_t> ipv4_address(const std::string& dotted) {
  in_addr address{};
  if (inet_pton(AF_INET, dotted.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

std::string text_of(const Endpoint& endpoint) {
  const in_addr address{htonl(endpoint.address)};
  char text[INET_ADDRSTRLEN] = "?";
  inet_ntop(AF_INET, &address, text, sizeof text);
  return std::string(text) + ":" + std::to_string(endpoint.port);
}

UdpSocket::UdpSocket(std::unique_ptr<State> state) : state_(std::move(state)) {}
UdpSocket::UdpSocket(UdpSocket&&) noexcept = default;
UdpSocket& UdpSocket::operator=(UdpSocket&&) noexcept = default;
UdpSocket::~UdpSocket() = default;

Result<UdpSocket> UdpSocket::open(const std::string& address, std::uint16_t port) {
  const std::string place = address + ":" + std::to_string(port);
  auto state = std::make_unique<State>();
  state->address.sin_family = AF_INET;
  state->address.sin_port = htons(port);
  if (inet_pton(AF_INET, address.c_str(), &state->address.sin_addr) != 1) {
    return Error{place, "is not an IPv4 address such as 127.0.0.1"};
  }
  state->fd = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (state->fd < 0) return Error{place, std::string("no socket: ") + std::strerror(errno)};

  // Beyond the system's limit where we may, else as much as it gives.
  if (setsockopt(state->fd, SOL_SOCKET, SO_RCVBUFFORCE, &kReceiveBufferBytes, sizeof kReceiveBufferBytes) != 0) {
    setsockopt(state->fd, SOL_SOCKET, SO_RCVBUF, &kReceiveBufferBytes, sizeof kReceiveBufferBytes);
  }

  // Where the kernel has no stamps, a datagram counts as arrived when it is read.
  const int on = 1;
  setsockopt(state->fd, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);

  if (bind(state->fd, reinterpret_cast<const sockaddr*>(&state->address), sizeof state->address) != 0) {
    if (errno == EADDRINUSE) return Error{place, "UDP port is taken; is another rig running? (--port-base)"};
    if (errno == EADDRNOTAVAIL) return Error{place, "is no address of this machine; `bind` under [bus] names one"};
    return Error{place, std::string("cannot bind: ") + std::strerror(errno)};
  }
  sockaddr_in bound{};
  socklen_t bound_size = sizeof bound;
  getsockname(state->fd, reinterpret_cast<sockaddr*>(&bound), &bound_size);
  state->port = ntohs(bound.sin_port);
  return UdpSocket(std::move(state));
}

bool UdpSocket::send_to(std::uint16_t port, std::span<const std::byte> bytes) {
  return send_to(Endpoint{ntohl(state_->address.sin_addr.s_addr), port}, bytes);
}

bool UdpSocket::send_to(const Endpoint& endpoint, std::span<const std::byte> bytes) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(endpoint.address);
  to.sin_port = htons(endpoint.port);
  const auto send = [&] {
    return sendto(state_->fd, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&to), sizeof to);
  };
  ssize_t sent = send();
  if (!state_->hears_refusals) return sent == static_cast<ssize_t>(bytes.size());
  const bool refused_before = sent < 0 && errno == ECONNREFUSED;  // word of an earlier one; this was not sent
  if (refused_before) sent = send();
  int refusal = 0;
  socklen_t size = sizeof refusal;
  getsockopt(state_->fd, SOL_SOCKET, SO_ERROR, &refusal, &size);
  return !refused_before && refusal == 0 && sent == static_cast<ssize_t>(bytes.size());
}

void UdpSocket::hear_refusals() {
  const int on = 1;
  state_->hears_refusals = setsockopt(state_->fd, IPPROTO_IP, IP_RECVERR, &on, sizeof on) == 0;
}

std::optional<std::span<const std::byte>> UdpSocket::receive() {
  State& s = *state_;
  if (s.next == s.filled) {
    s.next = s.filled = 0;
    for (mmsghdr& message : s.messages) {  // the kernel writes over it
      message.msg_hdr.msg_namelen = sizeof(sockaddr_in);
      message.msg_hdr.msg_controllen = sizeof(State::Control);
    }
    const auto before = std::chrono::steady_clock::now();
    const int count = recvmmsg(s.fd, s.messages.data(), kBatch, MSG_DONTWAIT, nullptr);
    if (count <= 0) {
      s.seen_empty = before;
      return std::nullopt;
    }
    s.filled = static_cast<std::size_t>(count);
    s.read = {std::chrono::steady_clock::now(), wall_now()};
  }
  const std::size_t i = s.next++;
  s.from = {ntohl(s.senders[i].sin_addr.s_addr), ntohs(s.senders[i].sin_port)};
  s.arrived = arrival_of(s.messages[i].msg_hdr, s.read, s.seen_empty);
  return std::span<const std::byte>(s.slots.get() + i * kSlotBytes, s.messages[i].msg_len);
}

bool UdpSocket::wait(std::chrono::nanoseconds at_most) {
  if (state_->next < state_->filled) return true;
  const std::int64_t ns = std::max<std::int64_t>(at_most.count(), 0);
  const timespec timeout{static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
  pollfd waited{state_->fd, POLLIN, 0};
  return ppoll(&waited, 1, &timeout, nullptr) > 0;
}

bool UdpSocket::filter_in_kernel(std::size_t tag_bytes) {
  const auto tag = static_cast<std::uint32_t>(tag_bytes);
  // Accepts what begins with 08 01 10 {01..05} and has 85 01 six bytes before its end, or before its tag.
  std::array<sock_filter, 11> program{{
      BPF_STMT(BPF_LD | BPF_W | BPF_LEN, 0),
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, kUdpHeaderBytes + 16 + tag, 0, 8),
      BPF_STMT(BPF_ALU | BPF_SUB | BPF_K, 6 + tag),
      BPF_STMT(BPF_MISC | BPF_TAX, 0),
      BPF_STMT(BPF_LD | BPF_H | BPF_IND, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0x8501, 0, 4),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kUdpHeaderBytes),
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x08011001, 0, 2),
      BPF_JUMP(BPF_JMP | BPF_JGT | BPF_K, 0x08011005, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, 0xffffffff),
      BPF_STMT(BPF_RET | BPF_K, 0),
  }};
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return setsockopt(state_->fd, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0;
}

std::uint64_t UdpSocket::dropped_in_kernel() const {
  std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
  socklen_t size = sizeof info;
  if (getsockopt(state_->fd, SOL_SOCKET, SO_MEMINFO, info.data(), &size) != 0) return 0;
  return info[SK_MEMINFO_DROPS];  // 32 bits: Bus adds up the differences
}

Endpoint UdpSocket::from() const {
  return state_->from;
}
ArrivalTime UdpSocket::arrived() const {
  return state_->arrived;
}
int UdpSocket::fd() const {
  return state_->fd;
}
std::uint16_t UdpSocket::port() const {
  return state_->port;
}

}  // namespace phare
