// Several sources at once. Each control comes from the first source that has it and is not silent: a stalk on CAN,
// wheel and pedals of a gamepad, the keyboard for the rest and for the moment when the adapter is unplugged.
#pragma once

#include <memory>
#include <vector>

#include "cockpit_io/source.h"

namespace phare {

/// The controls of a source, in groups that belong to one hand: a light switch and its lever are not taken from two
/// sources.
enum class ControlGroup {
  kLights,
  kFlash,
  kFogFront,
  kFogRear,
  kTurn,
  kHazard,
  kDesign,  ///< of all sources: a press is a press
  kLampAim,
  kAutomatic,
  kAhead,
  kIgnition,
  kSteering,
  kAccelerator,
  kBrake,
  kClutch,
  kGear,
  kParkingBrake,
};
inline constexpr std::size_t kControlGroups = 17;

class CombinedSource : public Source {
 public:
  struct Part {
    std::unique_ptr<Source> source;
    CockpitConfig config;
  };
  /// In falling priority; at least one.
  explicit CombinedSource(std::vector<Part> parts);

  void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) override;
  bool plays_again() const override;
  void remember(Memory& memory) override;
  bool ended() const override { return children_.front().source->ended(); }
  std::string status() const override { return children_.front().source->status(); }
  std::string fault() const override;
  bool sends_back() const override;
  void send_back(const FeedbackValues& values, WallTime now) override;
  std::vector<int> wait_fds() const override;
  std::string driver() const override { return children_.front().source->driver(); }
  void take_keys(std::uint32_t channel, std::uint64_t start_id, const KeyInput& keys, WallTime received) override;

 private:
  struct Child {
    std::unique_ptr<Source> source;
    std::array<bool, kControlGroups> has{};
    DriverInput input;
    bool silent = false;
  };
  const Child* holder(ControlGroup group) const;
  DriverInput merged() const;
  bool merged_silent() const;

  std::vector<Child> children_;
};

}  // namespace phare
