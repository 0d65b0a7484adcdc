// What the person at the window wants of the drive as a whole: begin again, drive instead of looking on. Their keys
// come as KeyInput; what a key does while somebody drives is the cockpit's.
#pragma once

#include <optional>

#include "net/bus.h"
#include "net/window_keys.h"

namespace phare {

enum class Wish {
  kAgain,        ///< the same drive from its start
  kDriveMyself,  ///< after a drive that was shown
  kDemo,         ///< after a drive that was shown: the demo driver, closed loop
};

class WishReader {
 public:
  /// Listens on the launcher's bus. `shown`: the drive is a recorded one, at whose end the person may want to drive.
  WishReader(Bus& bus, bool shown);
  WishReader(const WishReader&) = delete;
  WishReader& operator=(const WishReader&) = delete;

  /// After Bus::poll(): the newest wish.
  std::optional<Wish> take();
  /// The picture has shown the end of the drive.
  bool drive_over() const { return over_; }

 private:
  WindowKeys keys_;
  bool shown_;
  bool over_ = false;
};

}  // namespace phare
