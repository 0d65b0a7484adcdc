#include "config/bus_key.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>

namespace phare {

Result<BusKey> read_bus_key(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string digits, more;
  if (!(stream >> digits))
    return Error{file.string(), "no such file, or it is empty; openssl rand -hex 32 makes a key"};
  BusKey key{};
  bool good = digits.size() == 2 * key.size() && !(stream >> more);
  for (std::size_t i = 0; good && i < key.size(); ++i) {
    const char* byte = digits.data() + 2 * i;
    good = std::from_chars(byte, byte + 2, key[i], 16).ptr == byte + 2;
  }
  if (!good) return Error{file.string() + ":1", "expected " + std::to_string(2 * key.size()) + " hexadecimal digits"};
  // Whoever can read the key speaks for the rig; whoever can write the file, for everyone.
  std::error_code failed;
  const auto mode = std::filesystem::status(file, failed).permissions();
  using enum std::filesystem::perms;
  if ((mode & (others_all | group_write)) != none)
    return Error{file.string(), "others may read or change it; chmod 600 keeps the key to its user"};
  if (std::ranges::all_of(key, [](std::uint8_t byte) { return byte == 0; }))
    return Error{file.string() + ":1", "all zero is no key; openssl rand -hex 32 makes one"};
  return key;
}

}  // namespace phare
