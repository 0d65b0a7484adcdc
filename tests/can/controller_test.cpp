// Controllers and adapters: two SJA1000 on one bus, bus-off and restart of a serial adapter, PCI unplug while reading.
#include <fcntl.h>
#include <linux/sockios.h>
#include <linux/tty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>

#include "tests/can/can_rig.h"
#include "tests/paths.h"

namespace phare::can_test {
namespace {

void set_up_controllers() {
  std::string batch;
  for (const std::string name : {"can0", "can1"}) {
    batch += "link set " + name + " down\nlink set " + name + " txqueuelen 1000 up type can bitrate 500000\n";
  }
  ASSERT_EQ(sh("printf '" + batch + "' | ip -batch -"), 0);
}

constexpr const char* kSends =
    "[[send]]\nmessage = \"TELLTALES\"\nperiod_s = 0.05\n[send.signals]\nHIGH_BEAM = \"high_beam\"\nLOW_BEAM = "
    "\"low_beam\"\nSPEED = \"speed_kmh\"\n[check.TELLTALES]\ncounter = \"COUNTER\"\ncrc = \"CRC\"\ncrc_kind = "
    "\"crc8-sae-j1850\"\n";

TEST(RealCan, TwoControllersOnOneBusSpeakBothWays) {
  PHARE_NEEDS_CAN();
  if (!has_controllers()) GTEST_SKIP() << "no can0 and can1: only the emulated machine has them";
  set_up_controllers();
  Rig rig("can0", 60.0, kSends);
  CanSocket car = node("can1", {{0x503, false}});
  ASSERT_TRUE(car.send(stalk(kLow)));
  ASSERT_TRUE(rig.until_light(LightSwitch::kLow)) << rig.log();
  ASSERT_TRUE(car.send(stalk(kHigh)));
  ASSERT_TRUE(rig.until_light(LightSwitch::kHigh)) << rig.log();

  // The car's instrument panel: the high beam's telltale, 36 km/h, counters in a row, a CRC that fits.
  const auto dbc = read_dbc(cockpits_dir() + "/phare_stalk.dbc");
  const DbcMessage& telltales = *dbc->find("TELLTALES");
  MessageCheck check;
  check.message = "TELLTALES";
  check.counter = "COUNTER";
  check.crc = "CRC";
  check.crc_kind = CrcKind::kCrc8SaeJ1850;
  MessageChecker checker = *MessageChecker::bind(check, *dbc, telltales);
  int heard = 0;
  bool high = false;
  EXPECT_TRUE(rig.until([&] {
    while (const auto received = car.receive()) {
      EXPECT_EQ(checker.take(received->frame), MessageChecker::Verdict::kGood);
      EXPECT_DOUBLE_EQ(*decode(telltales, *telltales.find("SPEED"), received->frame), 36.0);
      high = *decode(telltales, *telltales.find("HIGH_BEAM"), received->frame) == 1.0;
      ++heard;
    }
    return heard >= 5 && high;
  }));
  EXPECT_EQ(checker.lost(), 0u);
  EXPECT_GE(rig.counts().sent, 5u);
}

/// A serial adapter (slcan) at the other end of a pty: the kernel's driver on ours, its plug in our hand.
class SerialAdapter {
 public:
  SerialAdapter() {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) return;
    slave_ = open(ptsname(master_), O_RDWR | O_NOCTTY);
    termios raw{};
    cfmakeraw(&raw);
    raw.c_cflag |= CREAD | CLOCAL;
    tcsetattr(slave_, TCSANOW, &raw);
    const int slcan = N_SLCAN;
    char name[32] = "";
    if (ioctl(slave_, TIOCSETD, &slcan) != 0 || ioctl(slave_, SIOCGIFNAME, name) != 0) return;
    name_ = name;
    good_ = sh("printf 'link set " + name_ + " name phser0\nlink set phser0 up\n' | ip -batch -") == 0;
  }
  ~SerialAdapter() {
    if (slave_ >= 0) close(slave_);
    if (master_ >= 0) close(master_);
  }
  bool good() const { return good_; }
  /// What the adapter would say over its serial line.
  void say(const std::string& text) const {
    EXPECT_EQ(write(master_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void stalk_moves(int byte) const {
    char line[64];
    std::snprintf(line, sizeof line, "t5008%02X01000000000000\r", byte);
    say(line);
  }

 private:
  int master_ = -1, slave_ = -1;
  std::string name_;
  bool good_ = false;
};

TEST(RealCan, BusOffIsSaidOnceAndTheControllerRestarted) {
  PHARE_NEEDS_CAN();
  const SerialAdapter adapter;
  if (!adapter.good()) GTEST_SKIP() << "the kernel has no slcan";
  Rig rig("phser0");
  adapter.stalk_moves(kHigh);
  ASSERT_TRUE(rig.until_light(LightSwitch::kHigh)) << rig.log();
  EXPECT_FALSE(rig.state().fail_safe);

  adapter.say("sb256000\r");  // state bus-off, receive errors 256
  ASSERT_TRUE(rig.until([&] { return rig.source().status() == "bus-off"; })) << rig.log();
  EXPECT_TRUE(rig.state().fail_safe) << "at once, without waiting for the timeout";
  EXPECT_EQ(rig.state().light_switch, LightSwitch::kLow);
  EXPECT_EQ(rig.source().fault(), "phser0: bus-off");
  adapter.say("sb256000\r");
  // After a second the link is restarted (this driver: down and up), and the stalk is heard again.
  const auto begin = Clock::now();
  ASSERT_TRUE(rig.until([&] { return Clock::now() - begin > 1500ms; }));
  adapter.say("sa000000\r");
  adapter.stalk_moves(kHigh);
  ASSERT_TRUE(rig.until_light(LightSwitch::kHigh)) << rig.log();
  EXPECT_FALSE(rig.state().fail_safe);
  EXPECT_EQ(rig.said("bus-off"), 1) << rig.log();
  EXPECT_EQ(rig.said("on the bus again"), 1) << rig.log();
  EXPECT_EQ(rig.counts().bus_offs, 1u);
}

TEST(RealCan, AControllerPulledOutWhileReadingComesBack) {
  PHARE_NEEDS_CAN();
  if (!has_controllers()) GTEST_SKIP() << "no can0 and can1: only the emulated machine has them";
  set_up_controllers();
  Rig rig("can0", 0.5);
  {
    CanSocket car = node("can1");
    std::atomic<bool> stop = false;
    std::thread stalk_turns([&] {
      while (!stop) {
        car.send(stalk(kHigh));
        std::this_thread::sleep_for(5ms);
      }
    });
    EXPECT_TRUE(rig.until_light(LightSwitch::kHigh)) << rig.log();
    EXPECT_EQ(sh("p=$(readlink -f /sys/class/net/can0/device); echo $p >/tmp/phare-can-pci; echo 1 >$p/remove"), 0);
    EXPECT_TRUE(rig.until([&] { return rig.state().fail_safe; })) << rig.log();
    EXPECT_EQ(sh("echo 1 >/sys/bus/pci/rescan"), 0);
    EXPECT_TRUE(rig.until([&] { return is_there("can0"); }));
    EXPECT_EQ(sh("ip link set can0 up type can bitrate 500000"), 0);
    EXPECT_TRUE(rig.until_light(LightSwitch::kHigh)) << rig.log();
    stop = true;
    stalk_turns.join();
  }
  EXPECT_EQ(rig.said("trying again every"), 1) << rig.log();
  EXPECT_EQ(rig.said("can0: back"), 1) << rig.log();
}

}  // namespace
}  // namespace phare::can_test
