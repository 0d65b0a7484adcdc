// process: everything that can be wrong with what a user gives. One line on stderr with place and reason, exit 2, and
// nothing left behind. What the machine lacks is told with the package that gives it.
#include "tests/process/bad_input.h"

#include "config/base/paths.h"
#include "config/base/remedies.h"

namespace phare::test {
namespace {

TEST_F(BadInput, OfADrive) {
  const std::string drive =
      "phare drive --headless --lockstep --frames 3 --out out/here --log-level warn --port-base " +
      std::to_string(port_base()) + " ";
  const std::string stalk = " --cockpit " + kConfig + "cockpits/phare_stalk.toml";
  expect_refused({
      {"no rig", drive + "--rig absent.toml", "absent.toml: no such file"},
      {"rig with a terminal's words", drive + R"-(--rig "$(printf 'a\033[31m.toml')")-",
       R"(a\x1b[31m.toml: no such file)"},
      {"rig not TOML", drive + "--rig rig_syntax.toml", "rig_syntax.toml:2: "},
      {"rig with unknown key", drive + "--rig rig_unknown_key.toml", "no key \"scnee\"; did you mean \"scene\"?"},
      {"rig off loopback", drive + "--rig rig_off_loopback.toml", "rig_off_loopback.toml:"},
      {"no key", drive + "--rig rig_no_key.toml", "absent.key: no such file"},
      {"key too short", drive + "--rig rig_bad_key.toml", "bad.key:1: expected 64 hexadecimal digits"},
      {"key for all", drive + "--rig rig_open_key.toml", "open.key: others may read or change it; chmod 600"},
      {"key of zeros", drive + "--rig rig_zero_key.toml", "zero.key:1: all zero is no key"},
      {"a place that is no address", drive + "--rig rig_place.toml", "\"car\" is not an IPv4 address"},
      {"another machine, no key", drive + "--rig rig_far.toml", "a key_file is required"},
      {"no IES", drive + "--rig rig_no_ies.toml", "absent.ies: no such file"},
      {"IES with a word", drive + "--rig rig_bad_ies.toml", "bad.ies:7: a candela value is not a number: \"oops\""},
      {"no glTF", drive + "--rig rig_no_glb.toml", "absent.glb: no such file"},
      {"GLB cut off", drive + "--rig rig_bad_glb.toml", "bad.glb: "},
      {"glTF, a data URI short", drive + "--rig rig_short_uri.toml", "short_uri.gltf: "},
      {"glTF not JSON", drive + "--rig rig_bad_gltf.toml", "bad.gltf: is not a glTF 2.0 file: parse error at line 2"},
      {"no temporary folder", "TMPDIR=/nonexistent " + drive + "--lamp good.ies", "TMPDIR: names no folder"},
      {"ports too high", drive + "--rig rig_high_ports.toml", "65501 is outside 1024 … 65500"},
      {"a script without a lane", drive + "--script empty_lane.toml", "empty_lane.toml:1: \"lane\": is empty"},
      {"vehicle", drive + "--rig rig_bad_car.toml", "bad_car.toml:"},
      {"cockpit file", drive + "--rig rig_bad_cockpit.toml", "bad_cockpit.toml:2: "},
      {"no drive", drive + "--drive absent.pcap", "absent.pcap: no such file"},
      {"drive not pcap", drive + "--drive bad.pcap", "bad.pcap: is no drive file"},
      {"no script", drive + "--script absent.toml", "absent.toml: no such file"},
      {"script a folder", drive + "--script own", "own: is a folder"},
      {"log a pipe", drive + "--log /dev/null" + stalk, "/dev/null: is not a regular file"},
      {"script not TOML", drive + "--script bad_script.toml", "bad_script.toml:1: "},
      {"no log", drive + "--log absent.log" + stalk, "absent.log: no such file"},
      {"log without a frame", drive + "--log bad.log" + stalk, "bad.log:1: "},
      {"log without mapping", drive + "--log good.log", "keyboard.toml: maps no signal"},
      {"DBC", drive + "--log good.log --dbc bad.dbc" + stalk, "bad.dbc:1: "},
      {"no DBC", drive + "--log good.log --dbc absent.dbc" + stalk, "absent.dbc: no such file"},
      {"a DBC of no frames", drive + "--dbc bad.dbc", "bad.dbc: describes CAN frames"},
      {"a DBC of a script", drive + "--dbc bad.dbc" + stalk + " --script bad_script.toml", "bad.dbc: describes CAN"},
      {"cockpit: a DBC of keys", "phare-cockpit --rig rig.toml --dbc bad.dbc", "--dbc bad.dbc: means nothing to"},
      {"cockpit: an interface of keys", "phare-cockpit --rig rig.toml --interface vcan0", "--interface vcan0: means"},
      {"cockpit: the speed of no log", "phare-cockpit --rig rig.toml --log-speed 2", "--log-speed: means nothing to"},
      {"size", drive + "--size 3x3", "--size: expected WIDTHxHEIGHT"},
      {"a budget of no time", drive + "--budget-ms 0", "--budget-ms: 0 is not within 0.1 to 10000"},
      {"a budget in words", drive + "--budget-ms sixteen", "--budget-ms: sixteen is not a finite number"},
      {"a budget that is no number", drive + "--budget-ms nan", "--budget-ms: nan is not a finite number"},
      {"a road of no friction", drive + "--friction nan", "--friction: nan is not"},
      {"a road that recorded poses do not know",
       drive + "--friction 0.3 --drive " + kConfig + "drives/country_road.pcap",
       "--friction: means nothing to recorded poses"},
      {"replay: no speed", "phare replay x.pcap --speed nan", "--speed: nan is not"},
      {"control: no time to wait", "phare control --wait nan status", "--wait: nan is not"},
      {"relay: no share", "phare bus-relay --listen 127.0.0.9 --to 127.0.0.1 --loss nan", "--loss: nan is not"},
      {"hard cases: a seed below 0", "phare hard-cases garbage --seed -1", "--seed: -1 is less than 0"},
      {"cost: a seed below 0", "phare cost --seed=-1", "--seed: -1 is less than 0"},
      {"a lamp set below 0", "phare lamp info good.ies --lamp-set -1", "--lamp-set: -1 is not within 1 to 1e+06"},
      {"hard cases: no factor", "phare hard-cases garbage --tighten nan", "--tighten: nan is not"},
      {"cockpit: no time", "phare-cockpit --wait-for-picture nan", "--wait-for-picture: nan is not"},
      {"lamp: at another distance than it says", "phare lamp info lx.csv --distance 50",
       "lx.csv:2: states a distance of 25 m, and 50 m are asked for"},
      {"lamp: measured points turned", "phare lamp check measured.csv --rule r112-passing-b --distance 25 --aim-up 1",
       "measured.csv: is a list of measured points"},
      {"dynamics: friction for a car without tyres",
       "phare-dynamics --seconds 1 --hold-speed-kmh 50 --level kinematic --road zones.csv --out x.csv --vehicle " +
           kConfig + "vehicles/hatchback.toml",
       "zones.csv: has friction alone"},
      {"dynamics: the bus of no rig", "phare-dynamics --batch x.csv --open-bus",
       "--open-bus: means nothing with --batch"},
      {"dynamics: how much to tell of no rig", "phare-dynamics --batch x.csv --log-level debug", "--log-level: means"},
      {"dynamics: a seed of nothing", "phare-dynamics --rig rig.toml --seed 4", "--seed: is that of --roughness"},
      {"dynamics: poses on ice",
       "phare-dynamics --rig rig.toml --level pose --friction 0.4 --drive " + kConfig + "drives/country_road.pcap",
       "--friction: means nothing to recorded poses"},
      {"dynamics: no speed", "phare-dynamics --batch x.csv --speed-mps nan", "--speed-mps: nan is not"},
      {"picture: no moment", "phare-visual --still-at nan", "--still-at: nan is not a finite number"},
      {"a tolerance without its sign", drive + "--tolerance 0.01", "expected a share of the light in percent"},
      {"a tolerance of nothing", drive + "--tolerance 0%", "expected a share of the light in percent"},
      {"a budget and a tolerance", drive + "--tolerance 1% --budget-ms 20", "--budget-ms"},
      {"an audit's bound without audits", drive + "--audit-bound 1% --audit-every 0", "--audit-every 0 audits none"},
      {"two frames in lockstep", drive + "--frames-in-flight 2", "--frames-in-flight: 2 is of real time"},
      {"a script in a closed loop", drive + "--closed-loop --script " + kConfig + "drives/country_road_script.toml",
       "--closed-loop: replays a recording's controls"},
      {"a lamp far away", drive + "--rig rig_far_lamp.toml",
       "\"design.lamp.position_m\": farther than 50 m from the car"},
      {"an eye far away", drive + "--rig rig_far_eye.toml", "\"channel.eye_m\": farther than 50 m from the car"},
      {"an audit's bound in lux", drive + "--audit-bound 1lx", "expected a share of the light in percent"},
      {"unknown flag", drive + "--siez 3x3", "--siez"},
      {"frames not a number", "phare drive --frames many", "--frames"},
      {"two sources", drive + "--drive bad.pcap --script bad_script.toml", "--script"},
      {"out is a file", "phare drive --headless --out file --port-base " + std::to_string(port_base()), "file"},
      {"drive: record over a recording", "phare drive --headless --frames 2 --record bad.pcap",
       "bad.pcap: is there already"},
      {"record nowhere", drive + "--record /nonexistent/x.pcap", "/nonexistent/x.pcap: cannot be written"},
      {"record over its report", drive + "--record out/here/report.json",
       "is a file that the drive itself writes into"},
      {"record over its rows", drive + "--record ./out/../out/here/drive.csv", "drive.csv: is a file that the drive"},
      {"record over its page", drive + "--record out/here/index.html", "index.html: is a file that the drive itself"},
      {"record over its counts", drive + "--record out/here/visual-0.json", "visual-0.json: is a file that the drive"},
      {"record over its frames", drive + "--record out/here/frames/000001.png", "000001.png: is a file that the drive"},
      {"record through a link", drive + "--record to_report.pcap", "to_report.pcap: is a file that the drive itself"},
      {"record into standard output", drive + "--record -", "--record -: a recording goes into a file"},
      {"record over its drive", drive + "--drive bad.pcap --record ./bad.pcap", "it would be overwritten"},
      {"record over its script", drive + "--script bad_script.toml --record bad_script.toml",
       "it would be overwritten"},
      {"record over its log", drive + "--log good.log --record good.log", "good.log: is the input"},
      {"record over its DBC", drive + "--log good.log --dbc bad.dbc --record bad.dbc", "bad.dbc: is the input"},
      {"record over its traffic", drive + "--traffic file --record file", "file: is an input"},
      {"record over its road", drive + "--road good.csv --record good.csv", "good.csv: is an input"},
      {"record over its rig", drive + "--rig rig.toml --record rig.toml", "rig.toml: is "},
      {"record over its lamp", drive + "--lamp good.ies --record good.ies", "it would be overwritten"},
      {"lamp: no file", drive + "--lamp absent.ies", "absent.ies: no such file"},
      {"lamp: not readable", drive + "--lamp bad.ies", "bad.ies:7: a candela value is not a number: \"oops\""},
      {"lamp: dark ahead", drive + "--lamp dark.ies", "dark.ies: sends no light ahead"},
      {"lamp: left alone", drive + "--lamp left=good.ies", "left= without right="},
      {"lamp: right alone", drive + "--lamp right=good.ies", "right= without left="},
      {"lamp: twice the same", drive + "--lamp left=good.ies,right=good.ies", "the same file is given twice"},
      {"lamp: low and high", drive + "--lamp good.ies --lamp-high good.ies", "good.ies is given twice"},
      {"lamp: given twice", drive + "--lamp good.ies --lamp dark.ies", "--lamp: given twice"},
      {"lamp: unknown key", drive + "--lamp good.ies,pitch=1", "did you mean \"pitch_deg\"?"},
      {"lamp: no spectrum", drive + "--lamp good.ies,spectrum=absent.csv", "absent.csv: "},
      {"lamp: aim", drive + "--lamp good.ies --aim up", "--aim up: expected as-filed, cut-off, or degrees up"},
      {"aim without lamp", drive + "--aim -1", "--aim -1: aims a lamp of one's own"},
      {"rig.toml of others",
       "phare drive --headless --lockstep --frames 3 --out own --lamp good.ies --port-base " +
           std::to_string(port_base()),
       "rig.toml: is there, and no drive has written it"},
  });
}

// An option that is given nothing was not meant to be left out: a shell's variable was not set.
TEST_F(BadInput, OfEmptyValues) {
  std::vector<Case> cases{
      {"drive: --rig=''", "phare drive --rig=''", "--rig: is given nothing"},
      {"visual: --out", "phare-visual --rig rig.toml --out ''", "--out: is given nothing"},
      {"visual: --stats", "phare-visual --rig rig.toml --stats ''", "--stats: is given nothing"},
      {"cockpit: --cockpit", "phare-cockpit --rig rig.toml --cockpit ''", "--cockpit: is given nothing"},
      {"dynamics: --vehicle", "phare-dynamics --rig rig.toml --vehicle ''", "--vehicle: is given"},
      {"import: --pose", "phare import --out x.pcap --can good.log --pose ''", "--pose: is given"},
      {"rig new: --out", "phare rig new --lamp good.ies --out ''", "--out: is given nothing"},
      {"measure: --points", "phare measure --out x.csv --points ''", "--points: is given nothing"},
      {"vehicle: --out", "phare vehicle good.tir --out ''", "--out: is given nothing"}};
  for (const std::string option : {"--drive", "--script", "--log", "--dbc", "--design", "--cockpit", "--record",
                                   "--vehicle", "--device", "--lamp"})
    cases.push_back(
        {"drive: " + option, "phare drive --headless --frames 1 " + option + " ''", option + ": is given nothing"});
  expect_refused(cases);
}

TEST_F(BadInput, OfTheMachine) {
  const std::string ports = " --port-base " + std::to_string(port_base());
  const std::string no_vulkan = "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent ";
  std::vector<Case> cases{
      {"no Vulkan: drive", no_vulkan + "phare drive --headless --out out" + ports, kVulkanRemedy},
      {"no Vulkan: measure", no_vulkan + "phare measure --rig rig.toml --points good.csv --out out.csv", kVulkanRemedy},
      {"no such display", "DISPLAY=:9876 phare drive" + ports, kDisplayRemedy},
      {"no CAN", "phare drive --headless --out out --cockpit " + kConfig + "cockpits/phare_stalk.toml" + ports,
       "can0: "},
  };
  if (fs::exists("/proc/net/can")) cases.pop_back();  // this kernel has it
  expect_refused(cases);

  std::string nothing;
  const std::string doctor = std::string(program("phare")) + " doctor > doctor.txt";
  EXPECT_EQ(run(folder_.path(), "sh -c '" + no_vulkan + doctor + "'", nothing), kExitCheckFailed);
  std::ifstream stream(folder_ / "doctor.txt");
  const std::string says{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_NE(says.find("MISSING  Vulkan device"), std::string::npos) << says;
  EXPECT_NE(says.find(kVulkanRemedy), std::string::npos) << says;
  EXPECT_NE(says.find(kDisplayRemedy), std::string::npos) << says;
  EXPECT_NE(says.find("Debian packages"), std::string::npos) << says;
}

// Whoever only drives is not told to install what the tests call.
TEST_F(BadInput, OfAMachineWithoutThePackagesOfTheTests) {
  std::string nothing;
  const std::string doctor = "PATH=/nonexistent " + std::string(program("phare")) + " doctor";
  EXPECT_EQ(run(folder_.path(), "/bin/sh -c '" + doctor + " > doctor.txt'", nothing), kExitDone);
  std::ifstream stream(folder_ / "doctor.txt");
  const std::string says{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t tests = says.find("Only for Phare's own tests");
  ASSERT_NE(tests, std::string::npos) << says;
  for (const char* only_tests : {"tshark  ", "xvfb-run  ", "mmdebstrap  ", "Vulkan validation layer  "}) {
    const std::size_t at = says.find(only_tests);
    EXPECT_TRUE(at != std::string::npos && at > tests) << only_tests << '\n' << says;
  }
  EXPECT_LT(says.find("ffmpeg"), tests) << says;
  EXPECT_NE(says.find("This machine can drive."), std::string::npos) << says;
  EXPECT_EQ(says.find("MISSING"), std::string::npos) << says;
}

}  // namespace
}  // namespace phare::test
