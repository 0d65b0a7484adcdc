// JSON on standard output. A file name need not be UTF-8, JSON must: what is not becomes U+FFFD.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "config/base/result.h"
#include "config/base/whole_file.h"

namespace phare {

inline void print_json(const nlohmann::json& json) {
  std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

/// Error where the result and --json would both go to standard output.
inline Status json_alone(const std::string& out, bool json) {
  if (!json || !is_standard_output(out)) return Done{};
  return Error{"--out " + out, "is standard output, where --json prints; give a file"};
}

}  // namespace phare
