// Where the processes of a rig are when they are not all on one machine.
#pragma once

#include <string>

namespace phare {

class TomlTable;

/// Of one process: two IPv4 addresses, for it may be reached at another one than it binds (a relay, a translation).
struct BusPlace {
  std::string bind;     ///< what it binds on its machine, 0.0.0.0: every address of it; empty: send_to
  std::string send_to;  ///< where the others send to; empty: the rig's bus.address

  bool operator==(const BusPlace&) const = default;
};

/// Of those that are one in a rig; each channel of the picture has its own.
struct BusPlaces {
  BusPlace cockpit, dynamics, recorder, control;

  bool operator==(const BusPlaces&) const = default;
};

/// "10.0.0.2" and nothing else: no names, no ports.
bool is_ipv4(const std::string& text);

/// The keys `bind` and `send_to` of a table.
BusPlace read_bus_place(TomlTable& table);
/// The tables bus.cockpit, bus.dynamics, bus.recorder and bus.control.
BusPlaces read_bus_places(TomlTable& bus);

}  // namespace phare
