#include "visual/photometry/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>

namespace phare {
namespace {

/// The descriptor that a name stands for; opening the name instead would cut short what `>>` had begun.
std::optional<int> named_descriptor(const std::string& path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    int descriptor = 0;
    const char* const end = path.data() + path.size();
    const auto [stop, code] = std::from_chars(path.data() + folder.size(), end, descriptor);
    if (code == std::errc{} && stop == end && descriptor >= 0) return descriptor;
  }
  return std::nullopt;
}

/// 0, or the errno of what went wrong.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t count = ::write(descriptor, content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

/// Writes and closes; a full disk may be told only when the file is closed.
int write_to(const std::string& path, int flags, std::string_view content) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
  if (descriptor < 0) return errno;
  const int cause = write_all(descriptor, content);
  const bool closed = ::close(descriptor) == 0;
  return cause != 0 ? cause : closed ? 0 : errno;
}

}  // namespace

bool is_standard_output(const std::filesystem::path& path) {
  return named_descriptor(path.string()) == STDOUT_FILENO;
}

Status write_whole_file(const std::filesystem::path& path, std::string_view content) {
  const auto failed = [&path](int cause) {
    return Error{path.string(), std::string("cannot be written: ") + std::strerror(cause)};
  };
  if (const auto descriptor = named_descriptor(path.string())) {
    const int cause = write_all(*descriptor, content);
    return cause == 0 ? Status(Done{}) : Status(failed(cause));
  }
  // Through links to what they point at, there or not yet.
  std::filesystem::path target = path;
  std::error_code code;
  for (int links = 0; std::filesystem::is_symlink(target, code); ++links) {
    if (links == 40) return failed(ELOOP);
    const std::filesystem::path to = std::filesystem::read_symlink(target, code);
    if (code) return failed(code.value());
    target = to.is_absolute() ? to : target.parent_path() / to;
  }
  const std::filesystem::file_status status = std::filesystem::status(target, code);
  if (std::filesystem::is_directory(status)) return failed(EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    const int cause = write_to(target.string(), 0, content);
    return cause == 0 ? Status(Done{}) : Status(failed(cause));
  }
  const std::string beside = target.string() + ".part" + std::to_string(::getpid());
  const int cause = write_to(beside, O_CREAT | O_TRUNC, content);
  if (cause == 0) {
    code.clear();
    if (std::filesystem::exists(status)) std::filesystem::permissions(beside, status.permissions(), code);
    std::filesystem::rename(beside, target, code);
    if (!code) return Done{};
  }
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  return failed(cause != 0 ? cause : code.value());
}

}  // namespace phare
