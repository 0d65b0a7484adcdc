#include "tools/virtual_display.h"

#include <signal.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace phare {

using namespace std::chrono_literals;

// On a free number, which it tells when it listens: a server that was killed leaves its lock and its socket.
VirtualDisplay::VirtualDisplay() {
  const std::filesystem::path told = folder_ / "display";
  auto server = ChildProcess::start(
      "/bin/sh", {"-c", "exec Xvfb -displayfd 5 -screen 0 " + std::to_string(kWidth_px) + "x" +
                            std::to_string(kHeight_px) + "x24 -fbdir '" + folder_.path().string() +
                            "' -nolisten tcp 5>'" + told.string() + "' >/dev/null 2>&1"});
  if (!server) return;
  server_ = *server;
  const auto until = std::chrono::steady_clock::now() + 30s;
  while (std::chrono::steady_clock::now() < until && !server_->ended()) {
    if (std::ifstream(told) >> number_) return;
    std::this_thread::sleep_for(20ms);
  }
  number_ = -1;
}

VirtualDisplay::~VirtualDisplay() {
  if (!server_) return;
  server_->send_signal(SIGTERM);
  while (!server_->ended()) std::this_thread::sleep_for(5ms);
}

}  // namespace phare
