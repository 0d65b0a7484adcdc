#include "config/base/commit.h"

#include "phare_commit.h"  // made by write_commit.cmake

namespace phare {

const char* build_commit() {
  return PHARE_COMMIT;
}

}  // namespace phare
