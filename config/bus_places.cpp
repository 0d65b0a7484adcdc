#include "config/bus_places.h"

#include <arpa/inet.h>

#include <algorithm>

#include "config/rig.h"

namespace phare {

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

std::vector<std::string> bus_addresses(const Rig& rig) {
  std::vector<std::string> all{rig.bind_address};
  const auto add = [&](const BusPlace& place) {
    for (const std::string* address : {&place.bind, &place.send_to})
      if (!address->empty()) all.push_back(*address);
  };
  for (const BusPlace* place : {&rig.places.cockpit, &rig.places.dynamics, &rig.places.recorder, &rig.places.control})
    add(*place);
  for (const ChannelConfig& channel : rig.channels) add(channel.place);
  return all;
}

bool off_loopback(const Rig& rig) {
  return std::ranges::any_of(bus_addresses(rig), [](const std::string& a) { return !a.starts_with("127."); });
}

}  // namespace phare
