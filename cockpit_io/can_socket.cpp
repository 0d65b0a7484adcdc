#include "cockpit_io/can_socket.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

namespace phare {

namespace {

constexpr int kReceiveBuffer_bytes =
    4 << 20;  // a full 1 Mbit/s bus for seconds; 208 KiB, the default, lost 494 of 20000

std::string reason(int error) {
  return std::strerror(error);
}

Error no_can(int error) {
  if (error == EAFNOSUPPORT || error == EPROTONOSUPPORT) {
    return Error{"CAN", "this kernel has no raw CAN sockets (" + reason(error) +
                            "); load them with \"modprobe can-raw\", or use a kernel built with CONFIG_CAN_RAW, "
                            "as linux-image-amd64 is; candump logs, keyboard and drives work without"};
  }
  return Error{"CAN", "no raw CAN socket: " + reason(error)};
}

template <typename T>
bool set_option(int fd, int level, int option, const T& value) {
  return setsockopt(fd, level, option, &value, sizeof value) == 0;
}

bool set_filters(int fd, std::span<const CanId> ids) {
  std::vector<can_filter> filters;
  for (const CanId& id : ids) {
    can_filter filter{};
    filter.can_id = id.extended ? id.id | CAN_EFF_FLAG : id.id;
    filter.can_mask = CAN_EFF_FLAG | (id.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    filters.push_back(filter);
  }
  return setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                    static_cast<socklen_t>(filters.size() * sizeof(can_filter))) == 0;
}

/// The kernel's frame as ours. `size` tells classic from FD.
std::optional<CanFrame> frame_from(const canfd_frame& raw, std::size_t size) {
  if (size != CAN_MTU && size != CANFD_MTU) return std::nullopt;
  CanFrame frame;
  frame.fd = size == CANFD_MTU;
  frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0 && !frame.fd;
  frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
  frame.id = raw.can_id & (frame.extended || frame.error ? CAN_EFF_MASK : CAN_SFF_MASK);
  if (frame.error) frame.extended = false;
  frame.fd_flags = frame.fd ? static_cast<std::uint8_t>(raw.flags & (CANFD_BRS | CANFD_ESI)) : std::uint8_t{0};
  frame.length = std::min<std::uint8_t>(raw.len, frame.fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN);
  if (!frame.remote) std::copy_n(raw.data, frame.length, frame.data.begin());
  return frame;
}

}  // namespace

Status can_supported() {
  const int fd = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  if (fd < 0) return no_can(errno);
  close(fd);
  return Done{};
}

Result<CanSocket> CanSocket::open(const std::string& interface, std::span<const CanId> ids) {
  const std::vector<CanId> wanted(ids.begin(), ids.end());
  return open_filtered(interface, &wanted);
}

Result<CanSocket> CanSocket::open_to_all(const std::string& interface) {
  return open_filtered(interface, nullptr);
}

Result<CanSocket> CanSocket::open_filtered(const std::string& interface, const std::vector<CanId>* ids) {
  const int fd = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (fd < 0) return no_can(errno);
  CanSocket can(fd);

  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
  if (address.can_ifindex == 0) {
    return Error{interface,
                 "there is no such interface; \"ip link\" shows those there are, and a CAN adapter is switched on with "
                 "\"ip link set " +
                     interface + " up type can bitrate 500000\""};
  }
  const can_err_mask_t errors = CAN_ERR_MASK;
  const int on = 1;
  // Stamps and counts are wished for, filters and error frames are needed.
  set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, on);
  set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, on);
  set_option(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, on);
  if (!set_option(fd, SOL_SOCKET, SO_RCVBUFFORCE, kReceiveBuffer_bytes))
    set_option(fd, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer_bytes);
  if ((ids != nullptr && !set_filters(fd, *ids)) || !set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors)) {
    return Error{interface, "the CAN socket takes no filters: " + reason(errno)};
  }
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return Error{interface,
                 errno == ENODEV ? std::string("is not a CAN interface") : "cannot be bound: " + reason(errno)};
  }
  return can;
}

CanSocket::CanSocket(CanSocket&& other) noexcept {
  *this = std::move(other);
}

CanSocket& CanSocket::operator=(CanSocket&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(why_, other.why_);
  std::swap(dropped_, other.dropped_);
  return *this;
}

CanSocket::~CanSocket() {
  if (fd_ >= 0) close(fd_);
}

bool CanSocket::send(const CanFrame& frame) {
  canfd_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0u) | (frame.remote ? CAN_RTR_FLAG : 0u);
  raw.len = frame.length;
  if (frame.fd) raw.flags = frame.fd_flags;
  std::copy_n(frame.data.begin(), std::min<std::size_t>(frame.length, sizeof raw.data), raw.data);
  const auto size = static_cast<ssize_t>(frame.fd ? CANFD_MTU : CAN_MTU);
  return write(fd_, &raw, static_cast<std::size_t>(size)) == size;
}

std::optional<CanSocket::Received> CanSocket::receive() {
  canfd_frame raw{};
  iovec part{&raw, sizeof raw};
  alignas(cmsghdr) std::array<char, 256> control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  ssize_t size = -1;
  do {
    size = recvmsg(fd_, &message, 0);
  } while (size < 0 && errno == EINTR);
  if (size < 0) {
    why_ = errno == EAGAIN || errno == EWOULDBLOCK ? Nothing::kNoFrame
           : errno == ENETDOWN                     ? Nothing::kLinkDown
                                                   : Nothing::kGone;
    return std::nullopt;
  }

  Received received{{}, wall_now()};
  for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level != SOL_SOCKET) continue;
    if (header->cmsg_type == SCM_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(header), sizeof stamp);
      if (stamp.tv_sec > 0) received.stamp.ns = std::int64_t{stamp.tv_sec} * 1'000'000'000 + stamp.tv_nsec;  // 0: none
    } else if (header->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t dropped = 0;
      std::memcpy(&dropped, CMSG_DATA(header), sizeof dropped);
      dropped_ = dropped;
    }
  }
  auto frame = frame_from(raw, static_cast<std::size_t>(size));
  if (!frame) {
    why_ = Nothing::kNoFrame;
    return std::nullopt;
  }
  received.frame = *frame;
  return received;
}

}  // namespace phare
