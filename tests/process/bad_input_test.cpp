// process: everything that can be wrong with what a user gives. One line on stderr with place and reason, exit 2, and
// nothing left behind. What the machine lacks is told with the package that gives it.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>

#include "config/base/paths.h"
#include "config/base/remedies.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  std::string command;  ///< after "phare "; may begin with VARIABLE=value for the environment
  std::string says;     ///< part of the line
};

const std::string kConfig = source_dir() + "/config/";

/// Runs in `folder` through the shell; stderr into `said`.
int run(const fs::path& folder, const std::string& command, std::string& said) {
  // The words before "phare" are for env.
  const std::string line = "cd '" + folder.string() + "' && { timeout 100 env -u DISPLAY -u WAYLAND_DISPLAY " +
                           command + "; } 2>&1 >/dev/null </dev/null";
  said.clear();
  FILE* pipe = popen(line.c_str(), "r");
  if (pipe == nullptr) return -1;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) said.push_back(static_cast<char>(c));
  const int status = pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A script without its line `lane = …`.
std::string without_lane(std::string script) {
  const std::size_t at = script.find("\nlane = ") + 1;
  return script.erase(at, script.find('\n', at) + 1 - at);
}

class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    const std::string text = text_of(kConfig + "rigs/country_road.toml");
    write_rig("rig.toml", text, "", "");
    write_rig("rig_bad_ies.toml", text, "\"generated/lamps/low_rht.ies\"",
              "\"" + (folder_ / "bad.ies").string() + "\"");
    write_rig("rig_far_lamp.toml", text, "position_m = [3.45, ", "position_m = [1e30, ");
    write_rig("rig_far_eye.toml", text, "eye_m = [", "eye_m = [1e300, 0, 0] # ");
    write_rig("rig_no_ies.toml", text, "\"generated/lamps/low_rht.ies\"", "\"absent.ies\"");
    write_rig("rig_bad_glb.toml", text, "\"generated/scenes/country_road.glb\"", "\"bad.glb\"");
    write_rig("rig_bad_gltf.toml", text, "\"generated/scenes/country_road.glb\"", "\"bad.gltf\"");
    write_rig("rig_no_glb.toml", text, "\"generated/scenes/country_road.glb\"", "\"absent.glb\"");
    write_rig("rig_unknown_key.toml", text, "scene = ", "scnee = ");
    write_rig("rig_key_besides.toml", text, "scene = ", "scnee = 1\nscene = ");
    write_rig("rig_bad_car.toml", text, "\"../vehicles/hatchback.toml\"", "\"bad_car.toml\"");
    write_rig("rig_bad_cockpit.toml", text, "\"../cockpits/keyboard.toml\"", "\"bad_cockpit.toml\"");
    write_rig("rig_off_loopback.toml", text, "127.0.0.1", "10.0.0.1");
    write_rig("rig_no_key.toml", text, "address = ", "key_file = \"absent.key\"\naddress = ");
    write_rig("rig_bad_key.toml", text, "address = ", "key_file = \"bad.key\"\naddress = ");
    write("bad.key", "00ff\n");
    write_rig("rig_open_key.toml", text, "address = ", "key_file = \"open.key\"\naddress = ");
    write("open.key", std::string(64, 'a') + "\n");
    write_rig("rig_zero_key.toml", text, "address = ", "key_file = \"zero.key\"\naddress = ");
    write("zero.key", std::string(64, '0') + "\n");
    fs::permissions(folder_ / "zero.key", fs::perms::owner_read | fs::perms::owner_write);
    write_rig("rig_place.toml", text, "[clock]", "[bus.dynamics]\nsend_to = \"car\"\n\n[clock]");
    write_rig("rig_far.toml", text, "[clock]", "[bus.dynamics]\nsend_to = \"10.0.0.2\"\n\n[clock]");
    write_rig("rig_empty_scene.toml", text, "\"generated/scenes/country_road.glb\"", "\"\"");
    write_rig("rig_empty_vehicle.toml", text, "\"../vehicles/hatchback.toml\"", "\"\"");
    write_rig("rig_empty_cockpit.toml", text, "\"../cockpits/keyboard.toml\"", "\"\"");
    write_rig("rig_empty_design.toml", text, "name = \"halogen\"", "name = \"\"");
    write_rig("rig_high_ports.toml", text, "port_base = 47000", "port_base = 65501");
    write("rig_syntax.toml", "name = \"x\"\nscene = \n");
    write("bad.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 2 2 0 0 0\n1 1 100\n0 1 2\n0 1\n5 6 oops\n1 2 3\n");
    write("good.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 2 2 0 0 0\n1 1 100\n0 1 2\n0 1\n5 6 7\n1 2 3\n");
    write("dark.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 2 2 0 0 0\n1 1 100\n0 1 2\n0 1\n0 0 0\n0 0 0\n");
    fs::create_directories(folder_ / "own");
    write("own/rig.toml", "name = \"mine\"\n");
    write("short.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 2 2 0 0 0\n1 1 100\n0 1 2\n0 1\n5 6\n");
    write("bad.glb", std::string("glTF\2\0\0\0\377\0\0\0junk", 16));
    write("bad.gltf", "{\"asset\": {\"version\": \"2.0\"},\n oops");
    write_rig("rig_short_uri.toml", text, "\"generated/scenes/country_road.glb\"", "\"short_uri.gltf\"");
    write("short_uri.gltf",
          "{\"asset\": {\"version\": \"2.0\"}, \"buffers\": [{\"byteLength\": 90000, \"uri\": "
          "\"data:application/octet-stream;base64," +
              std::string(40'000, 'A') + "\"}]}");
    write("bad_car.toml", "name = \"x\"\nmass_kg = -3\n");
    write("bad_cockpit.toml", "[source]\nkind = \"telepathy\"\n");
    write("bad.pcap", "not a capture\n");
    write("bad_script.toml", "at = [\n");
    write("empty_lane.toml", "lane = \"\"\n" + without_lane(text_of(kConfig + "drives/country_road_script.toml")));
    fs::create_symlink("out/here/report.json", folder_ / "to_report.pcap");
    write("bad.log", "nonsense\n");
    write("good.log", "(1.0) can0 500#0201000000000000\n");
    write("bad.dbc", "BO_ x\n");
    write("bad.csv", "x_m,y_m,z_m,nx,ny,nz\n1,2,3,0,0,1\n1,2,3,0,0,oops\n");
    write("short.csv", "x_m,y_m,z_m,nx,ny\n1,2,3,0,0\n");
    write("good.csv", "x_m,y_m,z_m,nx,ny,nz\n1,2,3,0,0,1\n");
    write("pose.csv", "t_s,east_m,north_m,up_m,heading_deg_cw_from_north,path_pitch_deg\n1,0,0,0,0,0\n2,0,9,0,0,0\n");
    write("lx.csv", "# unit: lx\n# distance_m: 25\nV\\H,-1,0,1\n-1,1,2,3\n0,1,4,3\n1,1,2,3\n");
    write("measured.csv", "point,lx\nB50L,0.2\n75R,12\n");
    write("zones.csv", "x_m,friction\n0,0.3\n100,1\n");
    write("file", "");
    write("binary.blf", "LOGG");
  }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  /// The demo rig with one text replaced and files found from here.
  void write_rig(const std::string& name, std::string text, const std::string& from, const std::string& to) {
    const auto replace = [&](const std::string& a, const std::string& b) {
      for (std::size_t at = 0; !a.empty() && (at = text.find(a, at)) != std::string::npos; at += b.size())
        text.replace(at, a.size(), b);
    };
    replace(from, to);
    replace("\"../", "\"" + kConfig);
    write(name, text);
  }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      names.insert(entry.path().lexically_relative(folder_.path()).string());
    return names;
  }

  void expect_refused(const std::vector<Case>& cases) {
    const std::set<std::string> before = files();
    for (const Case& given : cases) {
      std::string said, command = given.command;
      // The launcher, or the program that begins the line.
      const std::size_t launcher = command.find("phare ");
      ASSERT_TRUE(launcher != std::string::npos || command.starts_with("phare-"));
      const std::size_t at = launcher == std::string::npos ? 0 : launcher, end = command.find(' ', at);
      command.replace(at, end - at, program(command.substr(at, end - at)));
      EXPECT_EQ(run(folder_.path(), command, said), kExitBadInput) << given.name << ": " << said;
      EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << given.name << ": " << said;
      EXPECT_NE(said.find(given.says), std::string::npos)
          << given.name << ": expected " << given.says << "\ngot " << said;
      EXPECT_TRUE(said.starts_with("phare")) << said;
      EXPECT_LT(said.size(), 5000u) << given.name;
      EXPECT_EQ(said.find('\x1b'), std::string::npos) << given.name;
      for (const std::string& file : files()) EXPECT_TRUE(before.contains(file)) << given.name << " left " << file;
      std::printf("%-24s %s", given.name.c_str(), said.c_str());
    }
  }

  TemporaryFolder folder_;
};

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

TEST_F(BadInput, OfTheOtherCommands) {
  write("bare.gltf", R"({"asset": {"version": "2.0"}})");
  const std::string measure = "phare measure --method reference --out out.csv ";
  const std::string lamp = " --lamp short.ies,x=0,y=0,z=1";
  const std::string import = "phare import --out out.pcap ", cost = "phare cost --ladder poses --quick --out cost ";
  write("far.csv", "x_m,y_m,z_m,nx,ny,nz\n1,2,3,0,0,1\n1e200,2,3,0,0,1\n");
  // Cockpit files and street lamps that are good by themselves, and name what is not.
  std::string stalk = text_of(kConfig + "cockpits/phare_stalk.toml");
  write_rig("stalk.toml", stalk, "\"phare_stalk.dbc\"", "\"" + kConfig + "cockpits/phare_stalk.dbc\"");
  stalk = text_of(folder_ / "stalk.toml");
  write_rig("unknown_signal.toml", stalk, "\"FLASH\"", "\"FLUSH\"");
  write_rig("unknown_telltale.toml", stalk, "HIGH_BEAM =", "HIGH_BEAMS =");
  write_rig("beside_itself.toml", stalk, "timeout_s", "also = [\"beside_itself.toml\"]\ntimeout_s");
  write_rig("beside_none.toml", stalk, "timeout_s", "also = [\"absent.toml\"]\ntimeout_s");
  for (const std::string cockpit : {"unknown_signal.toml", "unknown_telltale.toml", "beside_itself.toml"})
    write_rig("rig_" + cockpit, text_of(folder_ / "rig.toml"), "\"" + kConfig + "cockpits/keyboard.toml\"",
              "\"" + cockpit + "\"");
  write("lamps.toml", "r_table = \"absent.csv\"\n" + text_of(generated_dir() / "scenes/town_lamps.toml"));
  write_rig("rig_no_table.toml", text_of(kConfig + "rigs/town.toml"), "\"generated/scenes/town_lamps.toml\"",
            "\"lamps.toml\"");
  expect_refused({
      {"rig: signal unknown", "phare rig check rig_unknown_signal.toml",
       "no signal \"FLUSH\"; did you mean \"FLASH\"?"},
      {"rig: telltale unknown", "phare rig check rig_unknown_telltale.toml", "no signal \"HIGH_BEAMS\""},
      {"rig: source beside itself", "phare rig check rig_beside_itself.toml", "names further sources itself (also)"},
      {"rig: no r-table", "phare rig check rig_no_table.toml", "absent.csv: no such file; it is the r-table of"},
      {"can: telltale unknown", "phare can check unknown_telltale.toml --log good.log", "no signal \"HIGH_BEAMS\""},
      {"can: no source beside", "phare can check beside_none.toml --log good.log", "absent.toml: no such file"},
      {"can: a DBC of another car", "phare can decode good.log --dbc " + source_dir() + "/config/examples/car.dbc",
       "the DBC file knows none"},
      {"no command", "phare ", "subcommand"},
      {"an option that is none", "phare -V", "unknown option -V"},
      {"an option that no lamp has", "phare lamp --jsno", "unknown option --jsno"},
      {"unknown command", "phare drvie", "no command \"drvie\"; did you mean \"drive\"?"},
      {"points without a number", measure + "--points bad.csv" + lamp, "short.ies:"},
      {"points with a word", measure + "--points bad.csv --rig rig.toml", "bad.csv:3: nz is not a finite number"},
      {"points without a column", measure + "--points short.csv --rig rig.toml", "short.csv:1: "},
      {"no points", measure + "--points absent.csv --rig rig.toml", "absent.csv: "},
      {"lamp without place", measure + "--points good.csv --lamp short.ies,x=0", "is missing (position in m)"},
      {"no lamp", measure + "--points good.csv", "give --rig FILE or --lamp"},
      {"no beam", measure + "--points good.csv --rig rig.toml --beams cornering", "--beams: "},
      {"a scene without lamps", measure + "--points good.csv --scene bare.gltf", "bare.gltf: has no lamps of its own"},
      {"no scene", measure + "--points good.csv --scene absent.gltf --rig rig.toml", "absent.gltf: "},
      {"a table and a scene", "phare measure --table absent.csv --scene bare.gltf", "--scene"},
      {"street lamps and a car", measure + "--points good.csv --street-lamps lamps.toml --rig rig.toml",
       "--street-lamps: is measured alone"},
      {"no table", "phare measure --table absent.csv", "absent.csv: no such file"},
      {"a folder for a table", "phare measure --table own", "own: is a folder"},
      {"over a lamp of the rig",
       "phare measure --method reference --rig rig_bad_ies.toml --points good.csv --out bad.ies",
       "it would be overwritten"},
      {"nowhere to write", "phare measure --method reference --rig rig.toml --points good.csv --out /nonexistent/e.csv",
       "/nonexistent/e.csv"},
      {"vehicle: no file", "phare vehicle absent.yaml --tyre absent.tir --out out.toml", "absent.yaml: cannot be read"},
      {"vehicle: no tyre", "phare vehicle good.log --out out.toml", "--tyre: is needed"},
      {"vehicle: no tyre file", "phare vehicle good.ies.tir", "good.ies.tir: cannot be read"},
      {"import: a start on no lane",
       import + "--can good.log --dbc " + kConfig + "cockpits/phare_stalk.dbc --onto none --start 5",
       "--start: is a place on a lane"},
      {"import: no log", import + "--can absent.log --dbc bad.dbc --pose pose.csv", "absent.log: "},
      {"import: DBC", import + "--can good.log --dbc bad.dbc --pose pose.csv", "bad.dbc:1: "},
      {"import: other signals", import + "--can good.log --dbc " + kConfig + "cockpits/phare_stalk.dbc --pose pose.csv",
       "phare_stalk.dbc: no message"},
      {"drive: no such setting of the picture", "phare drive --set kamera=chase", "did you mean \"camera\"?"},
      {"drive: a design that is not there", "phare drive --headless --explain --set design=99", "counted from 0"},
      {"drive: a design compared with itself",
       "phare drive --headless --explain --design halogen --set versus=0 --set compare=split",
       "versus 0: is the design that --design names"},
      {"drive: two designs of one",
       "phare drive --headless --explain --rig " + kConfig + "rigs/matrix.toml --set compare=split",
       "compare: the rig has one design"},
      {"drive: a moment, and no --explain", "phare drive --light high", "--explain"},
      {"drive: costs, and no --explain", "phare drive --headless --cost", "--cost requires --explain"},
      {"drive: costs on no device",
       "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent phare drive --headless --explain --cost --light low",
       "Vulkan"},
      {"drive: beside which lamp", "phare drive --headless --lamp-others none", "--lamp-others none: is about lamps"},
      {"drive: the aim of which lamp", "phare drive --headless --aim 0.5", "--aim 0.5: aims a lamp of one's own"},
      {"drive: of what is beside no lamp", "phare drive --headless --versus led --lamp-others none",
       "--lamp-others none: is about lamps"},
      {"drive: a moment and a report", "phare drive --headless --explain --json", "--json"},
      {"drive: a moment and pictures", "phare drive --headless --explain --out x", "--out"},
      {"drive: a moment and a recording", "phare drive --headless --explain --record x.pcap", "--record"},
      {"drive: a moment drawn never and often", "phare drive --headless --explain --frames 5", "--cost is not given"},
      {"drive: the moment of a script", "phare drive --explain --script x.toml", "--script"},
      {"drive: a moment of no drive", "phare drive --headless --explain --light low --still-at 30",
       "--still-at: is a moment of a drive"},
      {"drive: a folder without a name", "phare drive --headless --lockstep --frames 2 --out ''",
       "--out: names no folder"},
      {"drive: stills after its frames", "phare drive --headless --lockstep --frames 6 --still-at 0.2",
       "--still-at: 0.2 s is after the end of the drive"},
      {"drive: stills after the drive", "phare drive --headless --still-at 1000",
       "--still-at: 1000 s is after the end of the drive"},
      {"drive: a moment after the drive", "phare drive --headless --explain --still-at 1e9",
       "--still-at: 1e+09 s is after the end of the drive"},
      {"drive: the moment of a drive and another", "phare drive --explain --light low --drive x.pcap", "--light"},
      {"control: set what", "phare control set", "set: expected set SETTING [VALUE]"},
      {"control: no such command", "phare control dmi", "no command \"dmi\"; did you mean \"dim\"?"},
      {"control: too few words", "phare control dim \"headlamp left\" 1", "dim: expected dim LAMP SOURCE LIGHT"},
      {"control: too bright", "phare control dim \"headlamp left\" 1 1.5", "dim: light is 0 to 1"},
      {"control: far from its car", "phare control place \"headlamp left\" 3 0.6 66",
       "place: a lamp more than 50 m from its car"},
      {"control: no number", "phare control aim nan", "aim: expected a number, got \"nan\""},
      {"control: a number in hexadecimal", "phare control seek 0x10", "seek: expected a number, got \"0x10\""},
      {"control: too far", "phare control aim -91", "aim: an angle beyond 90 degrees"},
      {"rig: no file", "phare rig check absent.toml", "absent.toml: no such file"},
      {"rig: not TOML", "phare rig check rig_syntax.toml", "rig_syntax.toml:2: "},
      {"rig: unknown key", "phare rig check rig_key_besides.toml", "no key \"scnee\"; did you mean \"scene\"?"},
      {"rig: empty scene", "phare rig check rig_empty_scene.toml", "rig_empty_scene.toml:5: \"scene\": is empty"},
      {"rig: empty vehicle", "phare rig check rig_empty_vehicle.toml",
       "rig_empty_vehicle.toml:6: \"vehicle\": is empty"},
      {"rig: empty cockpit", "phare rig check rig_empty_cockpit.toml",
       "rig_empty_cockpit.toml:7: \"cockpit\": is empty"},
      {"rig: empty design", "phare rig check rig_empty_design.toml", "\"design.name\": is empty"},
      {"rig: of standard input", "phare rig check - < rig_empty_scene.toml", "standard input:5: \"scene\": is empty"},
      {"rig: bad lamp", "phare rig check rig_bad_ies.toml", "bad.ies:7: "},
      {"rig: no lamp", "phare rig check rig_no_ies.toml", "absent.ies: no such file"},
      {"rig: written over", "phare rig new --lamp good.ies --out rig.toml", "rig.toml: is there already"},
      {"rig: bad lamp of one's own", "phare rig new --lamp bad.ies --out new.toml", "bad.ies:7: "},
      {"rig: portable nowhere", "phare rig new --lamp good.ies --portable", "--portable: "},
      {"rig: nowhere to write", "phare rig new --lamp good.ies --out /nonexistent/r.toml", "/nonexistent/r.toml"},
      {"rig: portable, nowhere", "phare rig new --lamp good.ies --portable --out good.ies/r.toml", "good.ies/r"},
      {"import: no DBC", import + "--can good.log", "--dbc: is required"},
      {"import: no cockpit file", import + "--can good.log --cockpit absent.toml", "absent.toml: no such file"},
      {"import: a cockpit file without steering",
       import + "--can good.log --dbc " + kConfig + "cockpits/phare_stalk.dbc --cockpit " + kConfig +
           "cockpits/keyboard.toml",
       "maps no"},
      {"a log that Python reads, without Python", "PHARE_PYTHON=/nonexistent phare can crc binary.blf", "python3-can"},
      {"relay: to nowhere", "phare bus-relay --listen 127.0.0.9 --to car --seconds 1", "car: is not an IPv4 address"},
      {"relay: to itself", "phare bus-relay --listen 127.0.0.9 --to 127.0.0.9 --seconds 1", "passes on to itself"},
      {"relay: at no address of ours", "phare bus-relay --listen 192.0.2.1 --to 127.0.0.1 --seconds 1",
       "is no address of this machine"},
      {"can: a bus that the log has not",
       "phare can decode good.log --interface can7 --dbc " + kConfig + "cockpits/phare_stalk.dbc",
       "good.log: no frame comes from can7, but from can0"},
      {"can: no DBC", "phare can list absent.dbc", "absent.dbc: no such file"},
      {"can: a broken DBC of standard input", "phare can list - < bad.dbc", "standard input:1: "},
      {"can: a broken log of standard input", "phare can crc - < bad.log", "standard input:1: "},
      {"can: no log", "phare can decode absent.log --dbc " + kConfig + "cockpits/phare_stalk.dbc", "absent.log: "},
      {"can: no such signals",
       "phare can decode good.log --signal BEAM_SWICH --signal FLASCH --dbc " + kConfig + "cockpits/phare_stalk.dbc",
       "did you mean \"FLASH\"?"},
      {"can: no cockpit file", "phare can check absent.toml --log good.log", "absent.toml: no such file"},
      {"can: no DBC for it", "phare can check " + kConfig + "cockpits/toyota_rav4.toml --log good.log",
       "give one with --dbc"},
      {"can: a checksum in nothing", "phare can crc absent.log", "absent.log: "},
      {"replay: standard input", "phare replay -", "-: a drive is read from a file"},
      {"replay: the highest port", "phare replay absent.pcap --port-base 65500", "absent.pcap: "},
      {"visual: the highest port", "phare-visual --rig absent.toml --port-base 65500", "absent.toml: "},
      {"visual: above the highest port", "phare-visual --rig absent.toml --port-base 65501", "--port-base: "},
      {"replay: no drive", "phare replay absent.pcap", "absent.pcap: "},
      {"replay: not pcap", "phare replay bad.pcap", "bad.pcap: is no drive file"},
      {"measure: a rig and a lamp", measure + "--rig rig.toml --lamp good.ies,x=0,y=0,z=1 --points good.csv", "--lamp"},
      {"measure: beams of no rig", measure + "--lamp good.ies,x=0,y=0,z=1 --points good.csv --beams low",
       "--beams requires --rig"},
      {"measure: a design of no rig", measure + "--lamp good.ies,x=0,y=0,z=1 --points good.csv --design led",
       "--design requires --rig"},
      {"measure: a table and a lamp", "phare measure --table good.csv --lamp good.ies,x=0,y=0,z=1", "--table"},
      {"measure: a table and a file", "phare measure --table good.csv --out out.csv", "--table"},
      {"measure: an error of no table", measure + "--rig rig.toml --points good.csv --max-error 0.1",
       "--max-error requires --table"},
      {"measure: an image of no method", measure + "--rig rig.toml --points good.csv --beam-image float32-native-nodes",
       "--beam-image float32-native-nodes: goes with"},
      {"measure: an image of street lamps",
       measure + "--street-lamps lamps.toml --points good.csv --beam-image "
                 "float32-native-nodes",
       "--beam-image float32-native-nodes: the lamps of a scene or street"},
      {"measure: street lamps by the shader",
       "phare measure --out out.csv --street-lamps lamps.toml --points good.csv --method fragment",
       "--method fragment"},
      {"measure: street lamps validated",
       "phare measure --out out.csv --scene bare.gltf --points good.csv --validation", "--validation: the lamps of"},
      {"measure: float64 validated", measure + "--rig rig.toml --points good.csv --validation", "--validation: goes"},
      {"measure: a point far off", measure + "--points far.csv --rig rig.toml",
       "far.csv:3: the point is not within 1e8 m"},
      {"cost: no rig", cost + "--rig absent.toml", "absent.toml: no such file"},
      {"cost: no vehicle", cost + "--vehicle absent.toml", "absent.toml: no such file"},
      {"cost: against a table", cost + "--against good.csv", "good.csv: is no cost.json, as phare cost writes it"},
      {"cost: against no run", cost + "--against bad.log", "bad.log: "},
      {"measure: JSON beside rows", "phare measure --method reference --rig rig.toml --points good.csv --out - --json",
       "--out -: is standard output, where --json prints"},
      {"lamp: JSON beside a lamp", "phare lamp convert good.ies --to csv --out - --json",
       "--out -: is standard output"},
      {"import: JSON beside a drive", "phare import --can good.log --out - --json", "--out -: is standard output"},
      {"record: into standard output", "phare record --out -", "--out -: a recording goes into a file"},
      {"record over a recording", "phare record --out bad.pcap", "bad.pcap: is there already"},
      {"record nowhere", "phare record --out /nonexistent/x.pcap --port-base " + std::to_string(port_base()),
       "/nonexistent/x.pcap"},
  });
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
