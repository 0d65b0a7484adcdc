#include "config/base/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

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

}  // namespace

bool is_standard_output(const std::filesystem::path& path) {
  return named_descriptor(path.string()) == STDOUT_FILENO;
}

Result<WholeFile> WholeFile::create(const std::filesystem::path& path) {
  WholeFile file;
  file.path_ = path;
  if (const auto descriptor = named_descriptor(path.string())) {
    file.descriptor_ = *descriptor;
    return file;
  }
  // Through links to what they point at, there or not yet.
  std::filesystem::path target = path;
  std::error_code code;
  for (int links = 0; std::filesystem::is_symlink(target, code); ++links) {
    if (links == 40) return file.failed(ELOOP);
    const std::filesystem::path to = std::filesystem::read_symlink(target, code);
    if (code) return file.failed(code.value());
    target = to.is_absolute() ? to : target.parent_path() / to;
  }
  const std::filesystem::file_status status = std::filesystem::status(target, code);
  if (std::filesystem::is_directory(status)) return file.failed(EISDIR);
  file.ours_ = true;
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    file.descriptor_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return file.failed(errno);
    return file;
  }
  if (std::filesystem::exists(status)) file.mode_ = status.permissions();
  file.beside_ = target.string() + ".part" + std::to_string(::getpid());
  file.target_ = std::move(target);
  file.descriptor_ = ::open(file.beside_.c_str(), O_WRONLY | O_CLOEXEC | O_CREAT | O_TRUNC, 0666);
  if (file.descriptor_ < 0) return file.failed(errno);
  return file;
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      beside_(std::move(other.beside_)),
      mode_(other.mode_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      cause_(other.cause_),
      ours_(other.ours_) {}

WholeFile::~WholeFile() {
  if (descriptor_ < 0) return;
  if (ours_) ::close(descriptor_);
  std::error_code ignored;
  if (!beside_.empty()) std::filesystem::remove(beside_, ignored);
}

Error WholeFile::failed(int cause) {
  if (cause_ == 0) cause_ = cause;
  return Error{path_.string(), std::string("cannot be written: ") + std::strerror(cause_)};
}

Status WholeFile::write(std::string_view content) {
  if (cause_ == 0) cause_ = write_all(descriptor_, content);
  if (cause_ != 0) return failed(cause_);
  return Done{};
}

Status WholeFile::finish() {
  const int descriptor = std::exchange(descriptor_, -1);
  if (ours_ && ::close(descriptor) != 0 && cause_ == 0) cause_ = errno;
  std::error_code code;
  if (!beside_.empty() && cause_ == 0) {
    if (mode_ != std::filesystem::perms::unknown) std::filesystem::permissions(beside_, mode_, code);
    std::filesystem::rename(beside_, target_, code);
    if (code) cause_ = code.value();
  }
  if (cause_ == 0) return Done{};
  if (!beside_.empty()) std::filesystem::remove(beside_, code);
  return failed(cause_);
}

Status write_whole_file(const std::filesystem::path& path, std::string_view content) {
  Result<WholeFile> file = WholeFile::create(path);
  if (!file) return file.error();
  if (const Status written = file->write(content); !written) return written;
  return file->finish();
}

}  // namespace phare
