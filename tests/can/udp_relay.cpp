// Forwards UDP datagrams as they come: udp_relay FROM_ADDRESS:PORT=TO_ADDRESS:PORT …, until it is killed. The cockpit
// in the emulated machine speaks to its own loopback; this carries the bus to the host's and back.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace {

struct Leg {
  int fd = -1;
  sockaddr_in to{};
};

std::optional<sockaddr_in> address_of(const std::string& text) {
  sockaddr_in address{};
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::atoi(text.c_str() + colon + 1)));
  if (inet_pton(AF_INET, text.substr(0, colon).c_str(), &address.sin_addr) != 1) return std::nullopt;
  return address;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Leg> legs;
  std::vector<pollfd> waits;
  for (int i = 1; i < argc; ++i) {
    const std::string text = argv[i];
    const std::size_t equals = text.find('=');
    const auto from = address_of(text.substr(0, equals));
    const auto to = equals == std::string::npos ? std::nullopt : address_of(text.substr(equals + 1));
    const int fd = socket(AF_INET, SOCK_DGRAM, 0);
    if (!from || !to || fd < 0 || bind(fd, reinterpret_cast<const sockaddr*>(&*from), sizeof *from) != 0) {
      std::fprintf(stderr, "udp_relay: cannot serve %s\n", argv[i]);
      return 2;
    }
    legs.push_back({fd, *to});
    waits.push_back({fd, POLLIN, 0});
  }
  // One socket sends all, so that what goes out does not come from a port that is being served.
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  std::array<char, 65536> datagram{};
  while (poll(waits.data(), waits.size(), -1) > 0) {
    for (std::size_t i = 0; i < legs.size(); ++i) {
      if ((waits[i].revents & POLLIN) == 0) continue;
      const ssize_t size = recv(legs[i].fd, datagram.data(), datagram.size(), 0);
      if (size < 0) continue;
      sendto(out, datagram.data(), static_cast<std::size_t>(size), 0, reinterpret_cast<const sockaddr*>(&legs[i].to),
             sizeof legs[i].to);
    }
  }
  return 1;
}
