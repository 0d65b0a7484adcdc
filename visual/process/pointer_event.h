// What the mouse did in the window, in order.
#pragma once

namespace phare {

struct PointerEvent {
  enum class Kind { kMove, kPress, kRelease, kWheel };
  enum class Button { kLeft, kRight, kMiddle };
  Kind kind = Kind::kMove;
  double x_px = 0.0, y_px = 0.0;  ///< where it was: picture pixels from the upper left corner
  Button button = Button::kLeft;  ///< that was pressed or let go
  double wheel = 0.0;             ///< turned away from the hand, in notches

  friend bool operator==(const PointerEvent&, const PointerEvent&) = default;
};

}  // namespace phare
