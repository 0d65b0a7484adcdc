#include "cockpit_io/can_link.h"

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace phare {

namespace {

ifreq request_for(const std::string& interface) {
  ifreq request{};
  interface.copy(request.ifr_name, sizeof request.ifr_name - 1);
  return request;
}

/// Interface flags; 0 when it is not there.
short flags_of(const std::string& interface) {
  ifreq request = request_for(interface);
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return 0;
  const bool there = ioctl(fd, SIOCGIFFLAGS, &request) == 0;
  close(fd);
  return there ? request.ifr_flags : short{0};
}

/// 0 or errno.
int set_up(const std::string& interface, bool up) {
  ifreq request = request_for(interface);
  const short flags = flags_of(interface);
  request.ifr_flags = static_cast<short>(up ? flags | IFF_UP : flags & ~IFF_UP);
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return errno;
  const int error = ioctl(fd, SIOCSIFFLAGS, &request) == 0 ? 0 : errno;
  close(fd);
  return error;
}

/// A netlink request that grows by attributes, nested as rtnetlink wants them.
struct LinkRequest {
  nlmsghdr header{};
  ifinfomsg link{};
  std::array<char, 128> attributes{};
  std::size_t used = 0;

  rtattr* begin(unsigned short type) {
    auto* attribute = reinterpret_cast<rtattr*>(attributes.data() + used);
    attribute->rta_type = type;
    used += RTA_LENGTH(0);
    return attribute;
  }
  void end(rtattr* attribute) {
    const auto length = static_cast<std::size_t>(attributes.data() + used - reinterpret_cast<char*>(attribute));
    attribute->rta_len = static_cast<unsigned short>(length);
    used = static_cast<std::size_t>(reinterpret_cast<char*>(attribute) - attributes.data()) + RTA_ALIGN(length);
  }
  void add(unsigned short type, const void* data, std::size_t size) {
    rtattr* attribute = begin(type);
    std::memcpy(RTA_DATA(attribute), data, size);
    used += size;
    end(attribute);
  }
};

/// "ip link set IF type can restart". 0 or errno.
int restart_by_netlink(unsigned index) {
  LinkRequest request;
  request.link.ifi_index = static_cast<int>(index);
  rtattr* info = request.begin(IFLA_LINKINFO);
  request.add(IFLA_INFO_KIND, "can", 4);
  rtattr* data = request.begin(IFLA_INFO_DATA);
  const std::uint32_t one = 1;
  request.add(IFLA_CAN_RESTART, &one, sizeof one);
  request.end(data);
  request.end(info);
  request.header.nlmsg_type = RTM_NEWLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST | NLM_F_ACK;
  request.header.nlmsg_len = static_cast<std::uint32_t>(offsetof(LinkRequest, attributes) + request.used);

  const int fd = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
  if (fd < 0) return errno;
  const timeval patience{1, 0};
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  alignas(nlmsghdr) std::array<char, 1024> answer{};
  int error = EIO;
  if (send(fd, &request, request.header.nlmsg_len, 0) >= 0) {
    const ssize_t size = recv(fd, answer.data(), answer.size(), 0);
    const auto* reply = reinterpret_cast<const nlmsghdr*>(answer.data());
    if (size >= static_cast<ssize_t>(NLMSG_LENGTH(sizeof(nlmsgerr))) && reply->nlmsg_type == NLMSG_ERROR) {
      error = -static_cast<const nlmsgerr*>(NLMSG_DATA(reply))->error;
    }
  }
  close(fd);
  return error;
}

}  // namespace

bool can_link_up(const std::string& interface) {
  return (flags_of(interface) & IFF_UP) != 0;
}

std::uint64_t can_link_dropped(const std::string& interface) {
  // Not /sys/class/net: that shows the namespace it was mounted in. Receive columns: bytes packets errs drop fifo
  // frame.
  std::ifstream stream("/proc/self/net/dev");
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string name;
    std::uint64_t bytes = 0, packets = 0, errors = 0, dropped = 0, fifo = 0, overruns = 0;
    std::getline(words >> std::ws, name, ':');
    if (name == interface && words >> bytes >> packets >> errors >> dropped >> fifo >> overruns)
      return dropped + fifo + overruns;
  }
  return 0;
}

Status restart_can_link(const std::string& interface) {
  const unsigned index = if_nametoindex(interface.c_str());
  if (index == 0) return Error{interface, "there is no such interface"};
  int error = restart_by_netlink(index);
  if (error == 0) return Done{};
  if (error == EOPNOTSUPP) {
    error = set_up(interface, false);
    if (error == 0) error = set_up(interface, true);
    if (error == 0) return Done{};
  }
  return Error{interface, "cannot be restarted (" + std::string(std::strerror(error)) +
                              "); let the kernel do it: ip link set " + interface + " down; ip link set " + interface +
                              " up type can bitrate 500000 restart-ms 100"};
}

}  // namespace phare
