// Lamps moved by the keys of the window: which lamp or pair is chosen, which of its quantities, and what a key does.
// Knows no window: tests/visual_process/lamp_mounts_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/key_bindings.h"
#include "net/messages.h"
#include "visual/process/lamps.h"

namespace phare {

/// A key of the window moves a lamp by so much.
inline constexpr double kLampStep_m = 0.01;
inline constexpr double kLampStep_deg = 0.1;

/// What may be moved of the design that shines: pairs, then lamps.
std::vector<std::string> movable_lamps(const Lamps& lamps);

class LampKeys {
 public:
  /// Whether the key is one of lamps that are moved.
  static bool has(KeyAction action);

  /// What the key commands, if anything; others choose.
  std::optional<RigControl> press(KeyAction action, const Lamps& lamps);

  /// While a lamp is chosen: it, its quantity, and where it stands now. Empty: none is.
  std::vector<std::string> lines(const Lamps& lamps) const;

 private:
  std::string chosen(const Lamps& lamps) const;
  bool pair(const Lamps& lamps) const;

  std::size_t choice_ = 0;  // 0: none
  rig_command::MountQuantity quantity_ = rig_command::MountQuantity::kUp;
};

/// "headlamp left: x 3.450, y 0.620, z 0.660 m, turned 0.000 deg left, 0.000 deg up, 0.000 deg right side down".
std::string mount_text(const Lamps& lamps, std::size_t slot);

/// In the order of MountQuantity.
inline constexpr std::array<std::string_view, 7> kMountQuantityNames{"forward", "left",  "up",  "spacing",
                                                                     "yaw",     "pitch", "roll"};

}  // namespace phare
