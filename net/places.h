// Where the processes of a rig bind, and where the others reach them.
#pragma once

#include "config/rig.h"
#include "net/channels.h"
#include "net/udp.h"

namespace phare {

/// The address a process binds on its machine: dotted IPv4.
std::string address_to_bind(const Rig& rig, Role role, std::uint32_t channel = 0);

/// The address the others send to, and with the port; address 0 where it is not dotted IPv4.
std::string address_to_send_to(const Rig& rig, Role role, std::uint32_t channel = 0);
Endpoint endpoint_of(const Rig& rig, Role role, std::uint32_t channel = 0);

/// Some process has a place of its own: clocks may differ, and are compared (net/peer_clock.h).
bool has_places(const Rig& rig);

}  // namespace phare
