// A text of a TOML file that has to say something: a name, a file.
#pragma once

#include <string>
#include <string_view>

#include "config/formats/toml_table.h"

namespace phare {

/// A required text; an empty one is noted as an error too. It would name the folder of the file that names it.
inline std::string filled_text(TomlTable& table, std::string_view key) {
  std::string text = table.text(key);
  if (text.empty() && table.is_text(key)) table.fail(key, "is empty");
  return text;
}

}  // namespace phare
