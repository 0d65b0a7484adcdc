// The driver's controls from keys: of the terminal phare was started from, and of the window; besides, a gamepad that
// is plugged in, and a demo driver who takes the wheel at a key. What the keys are: config/key_bindings.h.
#pragma once

#include <termios.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cockpit_io/driver_source.h"
#include "cockpit_io/keyboard_driver.h"
#include "cockpit_io/source.h"
#include "net/window_keys.h"

namespace phare {

/// What a keyboard stands beside.
struct KeyboardCompany {
  struct Demo {
    DriverScript script;
    std::vector<LanePoint> lane;
  };
  std::optional<Demo> demo;
  bool demo_at_once = false;
  std::function<std::optional<PadReading>()> pad;  ///< nullopt: none is plugged in; may be empty
};

class KeyboardSource : public Source {
 public:
  /// Puts standard input into raw mode if it is a terminal in the foreground; else there are only the keys of windows.
  explicit KeyboardSource(KeyboardCompany company = {});
  ~KeyboardSource() override;  ///< gives the terminal back as it was

  void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) override;
  void take_keys(std::uint32_t channel, std::uint64_t start_id, const KeyInput& keys, WallTime received) override;
  /// As if the terminal had sent this; handled with the next advance().
  void take_terminal(std::string_view bytes) { typed_ += bytes; }
  void remember(Memory& memory) override;
  std::string driver() const override;
  std::string fault() const override { return fault_; }
  std::vector<int> wait_fds() const override;
  std::string status() const override { return terminal_ ? "up" : "no terminal"; }

 private:
  void read_terminal(Moment now, ControlSink& cockpit);
  void read_window(Moment now, ControlSink& cockpit);
  void read_pad(Moment now, ControlSink& cockpit);
  void change_hands(Moment now, const VehicleState* vehicle);
  void begin_demo(Moment now, const VehicleState* vehicle);
  void drive_demo(Moment now, const VehicleState* vehicle, ControlSink& cockpit);

  std::string typed_;                // by the terminal, not handled yet
  std::optional<termios> terminal_;  // as it was; nullopt: no terminal
  KeyboardCompany company_;
  KeyboardDriver keys_;
  WindowKeys window_;
  std::optional<DriverSource> demo_;  // has the wheel
  bool demo_goes_on_ = false;         // it had the wheel of the cockpit before this one
  bool persons_lights_ = false;       // the person has moved a light switch since the demo driver took the wheel
  std::string fault_;
  std::int64_t fault_until_ns_ = 0, pad_read_ns_ = -1;
};

}  // namespace phare
