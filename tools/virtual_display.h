// A display without a screen: Xvfb, started by us.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tools/child_process.h"
#include "tools/temporary_folder.h"

namespace phare {

/// Listens on a number of its own while this lives.
class VirtualDisplay {
 public:
  static bool possible() { return find_in_path("Xvfb").has_value(); }
  /// 640 × 480, 24 bits; waits until it listens, 30 s at most.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  /// ":17"; empty: it does not listen.
  std::string name() const { return number_ < 0 ? "" : ":" + std::to_string(number_); }
  static constexpr int kWidth_px = 640, kHeight_px = 480;

 protected:
  /// What it shows, as XWD.
  std::filesystem::path screen_file() const { return folder_ / "Xvfb_screen0"; }

 private:
  TemporaryFolder folder_;
  int number_ = -1;
  std::optional<ChildProcess> server_;
};

}  // namespace phare
