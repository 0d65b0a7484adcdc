#include "config/eye.h"

#include <charconv>

#include "config/toml_table.h"

namespace phare {

Result<EyeSetting> parse_adaptation(const std::string& text) {
  if (text == "auto") return EyeSetting{};
  double kelvin = 0.0;
  const auto [stop, failed] = std::from_chars(text.data(), text.data() + text.size(), kelvin);
  if (failed != std::errc() || stop != text.data() + text.size() ||
      !(kelvin >= kCoolestWhite_k && kelvin <= kHottestWhite_k))
    return Error{"--adaptation", "expected auto or a colour temperature of 2000 to 25000 K, got \"" + text + "\""};
  return EyeSetting{kelvin};
}

Result<EyeSetting> read_eye(const std::filesystem::path& rig_file) {
  auto root = TomlTable::read(rig_file);
  if (!root) return root.error();
  EyeSetting setting;
  if (auto eye = root->table_if("eye"); eye && eye->has("adaptation_k"))
    setting.fixed_k = eye->number_or("adaptation_k", 4000.0, kCoolestWhite_k, kHottestWhite_k);
  return setting;
}

}  // namespace phare
