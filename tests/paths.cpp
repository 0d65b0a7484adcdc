#include "tests/paths.h"

namespace phare {

std::string source_dir() {
  return PHARE_SOURCE_DIR;
}
std::string build_dir() {
  return PHARE_BUILD_DIR;
}
std::string build_root(const std::string& below) {
  return source_dir() + "/build/" + below;
}
std::string shared_data_dir() {
  return PHARE_SHARED_DATA_DIR;
}
std::string program(const std::string& name) {
  return build_dir() + "/bin/" + name;
}
std::string tests_dir(const std::string& below) {
  return source_dir() + "/tests/" + below;
}

}  // namespace phare
