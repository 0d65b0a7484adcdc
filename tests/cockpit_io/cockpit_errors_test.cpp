// What is refused or doubtful about a cockpit file and its DBC file, and where that is said.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cockpit_io/feedback.h"
#include "cockpit_io/signal_map.h"
#include "config/cockpit.h"
#include "tests/cockpit_io/controls_file.h"

namespace phare {
namespace {

using test::can, test::control, test::kDbc;

std::string error_of(const std::string& text) {
  const auto config = parse_cockpit(text, "c.toml");
  if (!config.ok()) return config.error().text();
  const Dbc dbc = *parse_dbc(kDbc, "c.dbc");
  const auto map = SignalMap::bind(*config, dbc, 0);
  if (!map.ok()) return map.error().text();
  const auto feedback = Feedback::bind(*config, dbc);
  return feedback.ok() ? "" : feedback.error().text();
}

TEST(CockpitErrors, AreSaidAtTheirLineAndNameTheNearest) {
  const auto says = [](const std::string& text, const std::string& part) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(part), std::string::npos) << error << "\n" << text;
    EXPECT_EQ(error.rfind("c.toml:", 0), 0u) << error;
  };
  const std::string flash = control("flash", "S0");
  EXPECT_EQ(error_of(can(flash)), "");
  says(can(control("beam_lever", "S0", "levels = { neutral = 0, push = 1 }\n") + control("high", "S1")),
       "two signals for one control");
  says(can(control("light_switch", "S0", "levels = { off = 0, high = 1 }\n") +
           control("beam_lever", "S1", "levels = { neutral = 0, push = 1 }\n")),
       "two signals for one control");
  says(can(control("turn", "S0", "levels = { none = 0, left = 1 }\n") + control("turn_right", "S1")),
       "two signals for one control");
  says(can(control("turn", "S0", "levels = { none = 0, left = \"pushd\" }\n")), "did you mean \"pushed\"?");
  says(can(control("turn", "S1", "levels = { none = 0, left = \"pushed\" }\n")), "has no value names");
  says(can(control("turn", "S0", "levels = { none = 0, left = 0 }\n")), "another level");
  says(can(control("turn", "S0", "levels = { none = 0, left = 100000 }\n")), "\"S0\" never is 100000: it has ");
  says(can(control("turn", "S0", "levels = { none = 0, left = -1 }\n")), "\"S0\" never is -1: it has ");
  says(can(control("flash", "S0", "on = 0.5\n")), "\"S0\" never is 0.5; next to it is ");
  says(can(control("flash", "S0", "on = \"pull\"\n")), "did you mean \"pulled\"?");
  says(can(control("flash", "S0", "on = []\n")), "expected a finite number or a text");
  says(can(control("beam_lever", "S0", "levels = { neutral = 0, push = 1 }\nlatch = \"pusch\"\n")),
       "is none of none, push, pull");
  says(can(control("steering", "ANGLE", "range_deg = [-5000, 5000]\n")), "within -1080 and 1080");
  says(can(control("steering", "ANGLE", "scale = 0\n")), "c.toml:6: \"control.steering.scale\": must not be 0");
  says(can(control("steering", "ANGLE", "range_deg = [10, 20]\n")),
       "c.toml:6: \"control.steering.range_deg\": must have 0");
  EXPECT_EQ(error_of(can(control("steering", "ANGLE", "range_deg = [0, 20]\n"))), "");
  says(can(flash + "[check.A]\n"), "expected a counter, a crc or both");
  says(can(flash + "[check.A]\ncrc = \"CRC\"\ncrc_kind = \"crc9\"\n"), "is none of none, e2e-p1");
  says(can(flash + "[check.A]\ncrc = \"CRC\"\ncrc_kind = \"e2e-p1\"\ndata_id = 7\n"), "needs a counter");
  says(can(flash + "[check.A]\ncrc = \"CRX\"\ncrc_kind = \"crc8\"\n"), "did you mean \"CRC\"?");
  says(can(flash + "[check.M]\ncounter = \"WHICH\"\n"), "no control comes from message \"M\"");
  says(can(flash + "[check.B]\ncounter = \"WHICH\"\n"), "no message \"B\"");
  says(can(flash + "[[send]]\nmessage = \"OUT\"\n[send.signals]\nHIGHT = \"high_beam\"\n"), "did you mean \"HIGH\"?");
  says(can(flash + "[[send]]\nmessage = \"OUT\"\n[send.signals]\nHIGH = \"high_bean\"\n"), "is none of high_beam");
  says(can(flash + "[automatic_high_beam]\nabove_kmh = 20\nbelow_kmh = 40\n"), "below_kmh");
  says("[source]\nkind = \"gamepad\"\n[control.flash]\naxis = 1\nbutton = 1\n", "expected one of axis, button and hat");
  says("[source]\nkind = \"gamepad\"\n[control.flash]\nhat = \"0.north\"\n", "expected a hat and its way");
  says("[source]\nkind = \"gamepad\"\n", "at least one [control");
}

TEST(Sending, ASignalThatDoesNotHoldItsSourceIsTold) {
  const auto doubts_of = [](const std::string& signals) {
    const auto config = parse_cockpit(can("[[send]]\nmessage = \"OUT\"\n[send.signals]\n" + signals), "c.toml");
    EXPECT_TRUE(config) << config.error().text();
    return send_doubts(*config, *parse_dbc(kDbc, "c.dbc"));
  };
  EXPECT_TRUE(doubts_of("HIGH = \"high_beam\"\nKMH = \"speed_kmh\"\nCOUNT = \"light_switch\"\n").empty());
  const auto speed = doubts_of("KMH = \"speed_kmh\"\nHIGH = \"speed_kmh\"\n");
  ASSERT_EQ(speed.size(), 1u);
  EXPECT_EQ(speed[0],
            "c.toml:7: speed_kmh is 0 to 130, the bits of \"HIGH\" hold 0 to 1; beyond, the nearest of these is sent");
  const auto others = doubts_of("HIGH = \"light_switch\"\nKMH = \"steering_deg\"\n");
  ASSERT_EQ(others.size(), 2u);
  EXPECT_NE(others[0].find("light_switch is 0 to 3, the bits of \"HIGH\" hold 0 to 1"), std::string::npos) << others[0];
  EXPECT_NE(others[1].find("steering_deg is -360 to 360, the bits of \"KMH\" hold 0 to 255"), std::string::npos);
  // What the file writes of a signal that has bits enough.
  const auto written =
      send_doubts(*parse_cockpit(can("[[send]]\nmessage = \"OUT\"\n[send.signals]\nA = \"speed_kmh\"\n"), "c.toml"),
                  *parse_dbc("BO_ 3 OUT: 8 X\n SG_ A : 0|16@1+ (1,0) [0|1] \"\" X\n", "c.dbc"));
  ASSERT_EQ(written.size(), 1u);
  EXPECT_EQ(written[0], "c.toml:6: speed_kmh is 0 to 130, the DBC file says that \"A\" is 0 to 1");
}

// A table may be long: what a key says wrong is said at the key's line.
TEST(CockpitErrors, HaveTheLineOfTheKey) {
  const auto at_key = [](const std::string& text, const std::string& key) {
    const auto before = text.begin() + static_cast<std::ptrdiff_t>(text.find("\n" + key + " =") + 1);
    const std::string line = "c.toml:" + std::to_string(1 + std::count(text.begin(), before, '\n')) + ": ";
    EXPECT_EQ(error_of(text).substr(0, line.size()), line) << error_of(text) << "\n" << text;
  };
  at_key(can(control("turn", "S0", "timeout_s = 1\nlevels = { none = 0, left = 100000 }\n")), "levels");
  at_key(can(control("turn", "S0", "timeout_s = 1\nlevels = { none = 0, left = \"pushd\" }\n")), "levels");
  at_key(can(control("flash", "S0", "timeout_s = 1\non = 0.5\n")), "on");
  at_key(can(control("flash", "S0", "timeout_s = 1\nbits = \"2|4\"\n")), "bits");
  at_key(can(control("flash", "S0", "timeout_s = 1\nbits = \"62|4@1+\"\n")), "bits");
  at_key(can(control("brake", "S2", "range = [0, 1]\ninvalid = 300\n")), "invalid");
  at_key(can(control("steering", "ANGLE", "scale = 1\nfine_signal = \"ANGEL\"\n")), "fine_signal");
  at_key(can(control("steering", "ANGLE", "scale = 1\nsign_signal = \"ANGEL\"\n")), "sign_signal");
}

}  // namespace
}  // namespace phare
