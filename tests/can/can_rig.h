// What the tests on the kernel's real CAN share: interfaces made and unmade with ip, a node on the bus, and a source
// that is read until something has happened. They run in a network namespace or machine of their own, as root: see
// run.sh.
#pragma once

#include <gtest/gtest.h>
#include <net/if.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include "cockpit_io/can_socket.h"
#include "cockpit_io/can_source.h"
#include "cockpit_io/cockpit.h"
#include "config/cockpit.h"

namespace phare::can_test {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// Twenty times what it takes: the machine's processor is emulated and shares two real ones with other tests.
inline constexpr auto kPatience = 10s;

inline int sh(const std::string& command) {
  return std::system(("( " + command + " ) </dev/null >/tmp/phare-can-sh.log 2>&1").c_str());
}

/// Whether the tests may run at all: run.sh says so.
inline bool here() {
  return std::getenv("PHARE_CAN_HERE") != nullptr;
}
#define PHARE_NEEDS_CAN() \
  if (!here()) GTEST_SKIP() << "not in a namespace of its own: start this by tests/can/run.sh"

inline bool is_there(const std::string& interface) {
  return if_nametoindex(interface.c_str()) != 0;  // /sys may be of another network namespace
}

/// Whether the machine has the two SJA1000 controllers that share a bus.
inline bool has_controllers() {
  return is_there("can0") && is_there("can1");
}

/// A virtual interface for one test. run.sh makes phc0 to phc9 by one call of ip: to start a program takes the emulated
/// machine half a second.
struct Vcan {
  explicit Vcan(std::string called) : name(std::move(called)) {
    if (!is_there(name)) add();
  }
  void remove() const { EXPECT_EQ(sh("ip link del " + name), 0); }
  void add() const {
    EXPECT_EQ(sh("ip link add " + name + " mtu 72 txqueuelen 1000 type vcan && ip link set " + name + " up"), 0)
        << name;
  }
  std::string name;
};

inline CanSocket node(const std::string& interface, std::initializer_list<CanId> ids = {}) {
  auto socket = CanSocket::open(interface, std::vector<CanId>(ids));
  EXPECT_TRUE(socket.ok()) << (socket.ok() ? "" : socket.error().text());
  return std::move(*socket);
}

inline CanFrame frame(std::uint32_t id, std::initializer_list<int> bytes, bool extended = false) {
  CanFrame made;
  made.id = id;
  made.extended = extended;
  for (const int byte : bytes) made.data[made.length++] = static_cast<std::uint8_t>(byte);
  return made;
}

/// phare_stalk.dbc's BEAM_STALK with the ignition on.
inline CanFrame stalk(int byte) {
  return frame(0x500, {byte, 1, 0, 0, 0, 0, 0, 0});
}
inline constexpr int kLow = 2, kHigh = 3;

/// A CanSource on phare_stalk.toml's light controls, and the cockpit it drives.
class Rig {
 public:
  explicit Rig(const std::string& interface, double timeout_s = 60.0, const std::string& more = "");

  /// Reads until `done` or patience runs out; whether it was done.
  bool until(const std::function<bool()>& done);
  bool until_light(LightSwitch light) {
    return until([&] { return state().light_switch == light; });
  }
  CockpitState state() const { return cockpit_->state(-1, false); }
  const SourceCounts& counts() const { return source_->counts(); }
  Source& source() { return *source_; }
  /// How often a text stands in what was logged since the rig was made.
  int said(const std::string& text) const;
  std::string log() const { return log_.str(); }

 private:
  std::ostringstream log_;
  std::unique_ptr<Source> source_;
  std::unique_ptr<Cockpit> cockpit_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace phare::can_test
