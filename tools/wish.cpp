#include "tools/wish.h"

#include "config/key_bindings.h"

namespace phare {

WishReader::WishReader(Bus& bus, bool shown) : shown_(shown) {
  bus.on_datagram = [this](const Datagram& datagram, std::span<const std::byte>) {
    if (const auto* keys = std::get_if<KeyInput>(&datagram.payload))
      keys_.take(datagram.sender_channel, datagram.start_id, *keys, wall_now());
    if (const auto* report = std::get_if<FrameReport>(&datagram.payload)) over_ = over_ || report->drawn.drive_ended;
  };
}

std::optional<Wish> WishReader::take() {
  std::optional<Wish> wish;
  for (const std::uint32_t code : keys_.take_presses()) {
    const KeyBinding* bound = binding_of(code);
    if (bound == nullptr) continue;
    if (bound->action == KeyAction::kBeginAgain) wish = Wish::kAgain;
    if (!shown_ || !over_) continue;
    if (bound->action == KeyAction::kAccelerate) wish = Wish::kDriveMyself;
    if (bound->action == KeyAction::kDemo) wish = Wish::kDemo;
  }
  return wish;
}

}  // namespace phare
