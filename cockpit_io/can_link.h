// The CAN interface behind the socket: whether it is up, what it dropped, and a restart after bus-off.
#pragma once

#include <cstdint>
#include <string>

#include "config/base/result.h"

namespace phare {

/// Whether the interface is there and set up.
bool can_link_up(const std::string& interface);

/// Frames that were lost before any socket saw them (receive columns drop, fifo and frame of /proc/net/dev: a full
/// backlog of the kernel, an overrun of the controller); 0 when the interface is not there.
std::uint64_t can_link_dropped(const std::string& interface);

/// Takes a controller out of bus-off: a restart by netlink, else (drivers that cannot, such as slcan) down and up.
/// Needs CAP_NET_ADMIN. Error says what to do.
Status restart_can_link(const std::string& interface);

}  // namespace phare
