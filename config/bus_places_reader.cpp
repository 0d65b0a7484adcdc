#include <optional>

#include "config/bus_places.h"
#include "config/formats/toml_table.h"

namespace phare {
namespace {

std::string read_address(TomlTable& table, const char* key) {
  std::string address = table.text_or(key, "");
  if (!address.empty() && !is_ipv4(address))
    table.fail(key, "\"" + address + "\" is not an IPv4 address such as 10.0.0.2");
  return address;
}

}  // namespace

BusPlace read_bus_place(TomlTable& table) {
  BusPlace place;
  place.bind = read_address(table, "bind");
  place.send_to = read_address(table, "send_to");
  if (place.send_to == "0.0.0.0")
    table.fail("send_to", "0.0.0.0 is for bind; the others need the address of a machine");
  return place;
}

BusPlaces read_bus_places(TomlTable& bus) {
  const auto of = [&](const char* role) {
    auto table = bus.table_if(role);
    return table ? read_bus_place(*table) : BusPlace{};
  };
  return {of("cockpit"), of("dynamics"), of("recorder"), of("control")};
}

}  // namespace phare
