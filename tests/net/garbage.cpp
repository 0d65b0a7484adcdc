#include "tests/net/garbage.h"

#include <algorithm>
#include <cassert>

namespace phare::test {

Garbage::Garbage(std::vector<std::string> templates, std::uint64_t seed)
    : templates_(std::move(templates)), random_(seed) {
  assert(!templates_.empty());
}

std::span<const std::byte> Garbage::next() {
  const std::string& valid = templates_[random_() % templates_.size()];
  switch (random_() % 4) {
    case 0: {  // random bytes, mostly short
      const std::size_t size = random_() % 16 == 0 ? random_() % 1500 : random_() % 200;
      bytes_.resize(size);
      for (char& byte : bytes_) byte = static_cast<char>(random_());
      break;
    }
    case 1:  // cut short
      bytes_.assign(valid, 0, random_() % valid.size());
      break;
    case 2: {  // one to eight different bits flipped
      bytes_ = valid;
      const std::size_t bits = valid.size() * 8;
      const std::size_t first = random_() % bits;
      const std::size_t count = 1 + random_() % 8;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t bit = (first + i * (1 + random_() % 3) * 7) % bits;
        bytes_[bit / 8] = static_cast<char>(bytes_[bit / 8] ^ (1 << (bit % 8)));
      }
      if (bytes_ == valid) bytes_[0] = static_cast<char>(bytes_[0] ^ 1);
      break;
    }
    default: {  // begins like a valid one and goes on at random
      bytes_ = valid;
      const std::size_t from = std::min<std::size_t>(4 + random_() % 40, valid.size() - 1);
      for (std::size_t i = from; i < bytes_.size(); ++i) bytes_[i] = static_cast<char>(random_());
      if (bytes_ == valid) bytes_[0] = static_cast<char>(bytes_[0] ^ 1);
      break;
    }
  }
  return std::as_bytes(std::span(bytes_.data(), bytes_.size()));
}

}  // namespace phare::test
