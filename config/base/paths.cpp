#include "config/base/paths.h"

#include <cstdlib>
#include <string>

namespace phare {
namespace {

/// <prefix>/share/phare of the running program; empty where it was not installed.
const std::filesystem::path& share_dir() {
  static const std::filesystem::path found = [] {
    std::error_code failed;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
    if (failed) return std::filesystem::path{};
    const auto share = program.parent_path().parent_path() / "share" / "phare";
    return std::filesystem::is_directory(share / "config", failed) ? share : std::filesystem::path{};
  }();
  return found;
}

}  // namespace

bool is_installed() {
  return !share_dir().empty();
}

std::filesystem::path config_dir() {
  return is_installed() ? share_dir() / "config" : std::filesystem::path(PHARE_CONFIG_DIR);
}

std::filesystem::path generated_dir() {
  const char* from_environment = std::getenv("PHARE_GENERATED_DIR");
  if (from_environment != nullptr && *from_environment != '\0') return from_environment;
  return is_installed() ? share_dir() / "generated" : std::filesystem::path(PHARE_BUILD_GENERATED_DIR);
}

std::filesystem::path resolve_path(const std::filesystem::path& named, const std::filesystem::path& naming_file) {
  if (named.empty() || named.is_absolute()) return named;
  if (*named.begin() == "generated")
    return std::filesystem::absolute(generated_dir() / named.lexically_relative("generated"));
  return std::filesystem::absolute(naming_file.parent_path() / named).lexically_normal();
}

std::filesystem::path packages_file() {
  return config_dir().parent_path() / "packages.txt";
}

}  // namespace phare
