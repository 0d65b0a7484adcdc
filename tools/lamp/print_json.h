// JSON on standard output. A file name need not be UTF-8, JSON must: what is not becomes U+FFFD.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>

namespace phare {

inline void print_json(const nlohmann::json& json, std::FILE* to = stdout) {
  std::fprintf(to, "%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

}  // namespace phare
