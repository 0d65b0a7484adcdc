#include "config/content_hash.h"

#include <sodium.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace phare {
namespace {

using Digest = std::array<unsigned char, crypto_hash_sha256_BYTES>;

std::string text_of(const Digest& digest) {
  std::array<char, 2 * crypto_hash_sha256_BYTES + 1> hex{};
  sodium_bin2hex(hex.data(), hex.size(), digest.data(), digest.size());
  return std::string("sha256:") + hex.data();
}

}  // namespace

std::string content_hash(std::span<const std::byte> bytes) {
  Digest digest{};
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return text_of(digest);
}

Result<std::string> content_hash_of_file(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return Error{path.string(), std::string("cannot be opened: ") + std::strerror(errno)};
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  std::array<unsigned char, 65536> piece{};
  while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), file.get())) {
    crypto_hash_sha256_update(&state, piece.data(), count);
  }
  if (std::ferror(file.get()) != 0) return Error{path.string(), "cannot be read"};
  Digest digest{};
  crypto_hash_sha256_final(&state, digest.data());
  return text_of(digest);
}

}  // namespace phare
