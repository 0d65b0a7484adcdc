// The driver's controls from a gamepad, or a wheel with pedals, without force feedback: axes, buttons and hats as the
// cockpit file maps them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cockpit_io/control_reader.h"
#include "cockpit_io/keyboard_driver.h"
#include "cockpit_io/source.h"

namespace phare {

struct GamepadReading {
  std::vector<float> axes;            ///< -1 … 1
  std::vector<std::uint8_t> buttons;  ///< 0 or 1
  std::vector<std::uint8_t> hats;     ///< bits: 1 up, 2 right, 4 down, 8 left, as GLFW has them
};

class GamepadSource : public Source {
 public:
  /// nullopt: the device is not there now.
  using Reader = std::function<std::optional<GamepadReading>()>;

  GamepadSource(CockpitConfig config, Reader reader);

  void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) override;
  void remember(Memory& memory) override;
  std::string status() const override { return there_ ? "up" : "down"; }
  std::string fault() const override { return there_ ? std::string() : "gamepad: not there"; }

 private:
  CockpitConfig config_;
  Reader read_;
  std::vector<ControlReader> controls_;
  BeamBits bits_;
  DriverInput input_;
  bool there_ = true;
  bool heard_ = false;
  std::int64_t last_ns_ = 0;  // SimTime of the newest reading
};

/// The value of "axis2", "button3" or "hat0.up"; nullopt when the device has none such.
std::optional<double> gamepad_value(const GamepadReading& reading, const std::string& signal);

/// A device by part of its name (empty: the first), through GLFW. Error when GLFW was not built in or does not start.
Result<GamepadSource::Reader> open_glfw_gamepad(const std::string& name);

/// The first device that GLFW knows as a gamepad, whichever is plugged in at the time; empty where GLFW does not start.
std::function<std::optional<PadReading>()> open_any_gamepad();

}  // namespace phare
