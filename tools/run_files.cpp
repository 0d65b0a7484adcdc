#include "tools/run_files.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "net/run_key.h"

namespace phare {

Result<RunFiles> RunFiles::make(const Rig& rig) {
  const auto folder = run_folder();
  if (!folder) return folder.error();
  std::string name = (*folder / ("drive-" + std::to_string(rig.port_base) + "-XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr) return Error{name, std::strerror(errno)};
  return RunFiles(name);
}

RunFiles::RunFiles(RunFiles&& other) noexcept : folder_(std::exchange(other.folder_, {})) {}

RunFiles::~RunFiles() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

}  // namespace phare
