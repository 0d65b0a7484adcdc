#include "config/eye.h"

#include <charconv>

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

}  // namespace phare
