#include "net/places.h"

#include <algorithm>

namespace phare {
namespace {

BusPlace place_of(const Rig& rig, Role role, std::uint32_t channel) {
  switch (role) {
    case Role::kCockpit:
      return rig.places.cockpit;
    case Role::kDynamics:
      return rig.places.dynamics;
    case Role::kRecorder:
      return rig.places.recorder;
    case Role::kControl:
    case Role::kLaw:  // beside the phare program
      return rig.places.control;
    case Role::kVisual:
      break;
  }
  return channel < rig.channels.size() ? rig.channels[channel].place : BusPlace{};
}

}  // namespace

std::string address_to_send_to(const Rig& rig, Role role, std::uint32_t channel) {
  const BusPlace place = place_of(rig, role, channel);
  return place.send_to.empty() ? rig.bind_address : place.send_to;
}

std::string address_to_bind(const Rig& rig, Role role, std::uint32_t channel) {
  const BusPlace place = place_of(rig, role, channel);
  return place.bind.empty() ? address_to_send_to(rig, role, channel) : place.bind;
}

Endpoint endpoint_of(const Rig& rig, Role role, std::uint32_t channel) {
  return {ipv4_address(address_to_send_to(rig, role, channel)).value_or(0),
          static_cast<std::uint16_t>(rig.port_base + port_offset(role, channel))};
}

bool has_places(const Rig& rig) {
  return rig.places != BusPlaces{} ||
         std::ranges::any_of(rig.channels, [](const ChannelConfig& channel) { return channel.place != BusPlace{}; });
}

}  // namespace phare
