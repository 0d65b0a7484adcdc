#include "cockpit_io/gamepad_source.h"

#include <spdlog/spdlog.h>

#include <charconv>

namespace phare {

std::optional<double> gamepad_value(const GamepadReading& reading, const std::string& signal) {
  const auto number_at = [&](std::size_t prefix) -> std::optional<std::size_t> {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(signal.data() + prefix, signal.data() + signal.size(), number);
    return error == std::errc{} ? std::optional(number) : std::nullopt;
  };
  if (signal.starts_with("axis")) {
    const auto n = number_at(4);
    if (!n || *n >= reading.axes.size()) return std::nullopt;
    return static_cast<double>(reading.axes[*n]);
  }
  if (signal.starts_with("button")) {
    const auto n = number_at(6);
    if (!n || *n >= reading.buttons.size()) return std::nullopt;
    return reading.buttons[*n] != 0 ? 1.0 : 0.0;
  }
  if (!signal.starts_with("hat")) return std::nullopt;
  const auto n = number_at(3);
  if (!n || *n >= reading.hats.size()) return std::nullopt;
  const unsigned bit = signal.ends_with(".up")      ? 1u
                       : signal.ends_with(".right") ? 2u
                       : signal.ends_with(".down")  ? 4u
                                                    : 8u;
  return (reading.hats[*n] & bit) != 0 ? 1.0 : 0.0;
}

GamepadSource::GamepadSource(CockpitConfig config, Reader reader)
    : config_(std::move(config)), read_(std::move(reader)) {
  input_ = initial_input(config_);
  for (const ControlMapping& mapping : config_.controls) {
    const double debounce_s = mapping.debounce_s.value_or(config_.debounce_s);
    controls_.emplace_back(mapping, static_cast<std::int64_t>(debounce_s * 1e9));
  }
}

void GamepadSource::remember(Memory& memory) {
  memory.field(bits_);
  memory.field(input_);
  memory.field(last_ns_);
  for (ControlReader& control : controls_) control.remember(memory);
}

void GamepadSource::advance(Moment now, const VehicleState*, ControlSink& cockpit) {
  const auto reading = read_();
  if (reading.has_value() != there_) {
    there_ = reading.has_value();
    if (there_) {
      if (heard_) ++counts_.reconnects;
      spdlog::info("gamepad: there");
    } else {
      spdlog::warn("gamepad: not there; waiting for it");
    }
  }
  if (reading) {
    heard_ = true;
    last_ns_ = now.sim.ns;
    ++counts_.frames_read;
    bool complete = true;
    for (ControlReader& control : controls_) {
      const auto value = gamepad_value(*reading, control.mapping().signal);
      complete = value && control.take(*value, now.sim.ns, bits_, input_) && complete;
    }
    ++(complete ? counts_.decoded : counts_.incomplete);
    settle_bits(config_, bits_, input_);
  }
  cockpit.take(input_, now.sim.ns - last_ns_ >= static_cast<std::int64_t>(config_.timeout_s * 1e9), now);
}

}  // namespace phare
