// Datagrams no receiver may take: random bytes, valid ones cut short, valid ones with flipped bits. Seeded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace phare::test {

class Garbage {
 public:
  /// `templates`: encodings of valid datagrams.
  Garbage(std::vector<std::string> templates, std::uint64_t seed);

  /// The next one; the view is valid until the next call. Never equal to a template.
  std::span<const std::byte> next();

 private:
  std::vector<std::string> templates_;
  std::mt19937_64 random_;
  std::string bytes_;
};

}  // namespace phare::test
