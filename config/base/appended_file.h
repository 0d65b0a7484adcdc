// A file that grows by whole pieces: a row that the disk does not take leaves no half of itself behind.
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

namespace phare {

class AppendedFile {
 public:
  AppendedFile() = default;
  AppendedFile(AppendedFile&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  AppendedFile& operator=(AppendedFile&&) = delete;
  ~AppendedFile();

  bool is_open() const { return file_ >= 0; }
  /// Opens it empty, or at the end of what there is; false: it cannot be opened.
  bool open(const std::filesystem::path& path, bool keep_content);
  /// All of `piece` behind the rest, handed to the kernel; false: the disk did not take it, and the file ends where it
  /// ended before.
  bool append(std::string_view piece);

 private:
  int file_ = -1;
};

}  // namespace phare
