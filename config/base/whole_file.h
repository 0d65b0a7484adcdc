// Writing results to where the user pointed: a file that appears whole or not at all, a pipe, a device, standard
// output.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "config/base/result.h"

namespace phare {

/// Written piece by piece. A regular file (one to be made, or behind symbolic links) is written beside and renamed by
/// finish(), so a reader sees the old file or the whole new one, links stay links and the mode is kept; without
/// finish() nothing is left. A pipe or device is written to and never replaced. "-", /dev/stdout, /dev/stderr and
/// /dev/fd/N are the open descriptors themselves. Errors name `path`.
class WholeFile {
 public:
  static Result<WholeFile> create(const std::filesystem::path& path);
  WholeFile(WholeFile&& other) noexcept;
  WholeFile& operator=(WholeFile&&) = delete;
  ~WholeFile();

  Status write(std::string_view content);
  /// The file is there, or what went wrong, now or before; a full disk may be told only here.
  Status finish();

 private:
  WholeFile() = default;
  Error failed(int cause);

  std::filesystem::path path_, target_, beside_;  // beside: empty where written to directly
  std::filesystem::perms mode_ = std::filesystem::perms::unknown;
  int descriptor_ = -1;
  int cause_ = 0;  // errno of the first failure
  bool ours_ = false;
};

/// All of it at once.
Status write_whole_file(const std::filesystem::path& path, std::string_view content);

/// Does `path` mean standard output?
bool is_standard_output(const std::filesystem::path& path);

}  // namespace phare
