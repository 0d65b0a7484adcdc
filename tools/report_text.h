// Values of a report as short text for its page.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/html_text.h"

namespace phare {

inline std::string number(double value, const char* format = "%.3g") {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A value as short text; "–" when it is not there.
inline std::string value_text(const nlohmann::json& object, const char* key, const char* format = "%.2f") {
  if (!object.is_object() || !object.contains(key)) return "–";
  const nlohmann::json& value = object[key];
  if (value.is_number_float()) return number(value.get<double>(), format);
  if (value.is_number()) return value.dump();
  if (value.is_string()) return escaped(value.get<std::string>());
  return "–";
}

inline std::string short_hash(const std::string& hash) {
  const std::size_t colon = hash.find(':');
  return escaped(colon == std::string::npos ? hash.substr(0, 12) : hash.substr(colon + 1, 12));
}

}  // namespace phare
