#include "config/base/input_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

namespace phare {

bool is_standard_input(const std::filesystem::path& name) {
  return name == "-" || name == "/dev/stdin" || name == "/dev/fd/0" || name == "/proc/self/fd/0";
}

std::string input_name(const std::filesystem::path& name) {
  return is_standard_input(name) ? "standard input" : name.string();
}

std::string why_no_file(const std::filesystem::path& name) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(name, ignored);
  if (std::filesystem::is_regular_file(status)) return "";
  if (std::filesystem::is_directory(status)) return "is a folder";
  return std::filesystem::exists(status) ? "is not a regular file" : "no such file";
}

Result<std::string> read_input_bytes(const std::filesystem::path& name, std::uintmax_t limit) {
  // One reader looks what kind of file it is, another reads it: what came in stays for both.
  static std::optional<std::string> came_in;
  if (is_standard_input(name) && came_in && came_in->size() <= limit) return *came_in;
  const std::string place = input_name(name);
  if (place.empty()) return Error{"\"\"", "names no file"};
  const auto failed = [&](const std::string& why) { return Error{place, "cannot be read: " + why}; };
  std::error_code code;
  const bool standard = is_standard_input(name);
  if (!standard && std::filesystem::is_directory(name, code)) return Error{place, "is a folder"};
  const int descriptor = standard ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return failed(std::strerror(errno));
  std::string bytes;
  const std::uintmax_t size = standard ? 0 : std::filesystem::file_size(name, code);
  if (!standard && !code && size <= limit) bytes.reserve(static_cast<std::size_t>(size) + 1);
  int cause = 0;
  constexpr std::size_t kChunk = 1u << 16;
  while (bytes.size() <= limit) {
    const std::size_t had = bytes.size();
    bytes.resize(had + kChunk);
    const ssize_t count = ::read(descriptor, bytes.data() + had, kChunk);
    bytes.resize(had + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count == 0) break;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) cause = errno;
    if (cause != 0) break;
  }
  if (!standard) ::close(descriptor);
  if (cause != 0) return failed(std::strerror(cause));
  if (bytes.size() > limit) return Error{place, "is larger than " + std::to_string(limit >> 20) + " MiB"};
  if (standard) came_in = bytes;
  return bytes;
}

Result<std::string> read_file_or_input(const std::filesystem::path& name) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 32;
  if (is_standard_input(name)) return read_input_bytes(name, kMostBytes);
  if (const std::string why = why_no_file(name); !why.empty()) return Error{name.string(), why};
  std::ifstream stream(name, std::ios::binary);
  if (!stream) return Error{name.string(), "cannot be read"};
  return std::string{std::istreambuf_iterator<char>(stream), {}};
}

Status check_inputs(const std::vector<std::string>& inputs, const std::vector<std::string>& results) {
  bool standard = false;
  for (const std::string& input : inputs) {
    if (!is_standard_input(input)) continue;
    if (standard) return Error{input, "is standard input, which can be read only once; it is named twice"};
    standard = true;
  }
  for (const std::string& result : results) {
    for (const std::string& input : inputs) {
      std::error_code code;
      if (result.empty() || input.empty() || is_standard_input(input)) continue;
      if (!std::filesystem::is_regular_file(result, code) || !std::filesystem::equivalent(result, input, code))
        continue;
      return Error{result, (result == input ? std::string("is an input") : "is the input " + input) +
                               "; it would be overwritten"};
    }
  }
  return Done{};
}

}  // namespace phare
