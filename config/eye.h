// What the eye of a rig takes for white: [eye] of a rig file, --adaptation of a command line.
#pragma once

#include <optional>
#include <string>

#include "config/base/result.h"

namespace phare {

constexpr double kCoolestWhite_k = 2000.0, kHottestWhite_k = 25000.0;  ///< of light that an eye can take for white

/// The eye follows the light that is lit, or light of this colour temperature looks white whatever is lit.
struct EyeSetting {
  std::optional<double> fixed_k;

  friend bool operator==(const EyeSetting&, const EyeSetting&) = default;
};

/// "auto", or a colour temperature in K.
Result<EyeSetting> parse_adaptation(const std::string& text);

}  // namespace phare
