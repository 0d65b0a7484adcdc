// When a file was made.
#pragma once

#include <ctime>
#include <string>

namespace phare {

/// "2026-11-23T08:01:17Z" (ISO 8601).
inline std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace phare
