// What tests of bad input share: a folder with everything that can be wrong, and what each refusal owes.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "config/base/fail.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {

namespace fs = std::filesystem;

/// A command that is refused.
struct Case {
  std::string name;
  std::string command;  ///< after "phare "; may begin with VARIABLE=value for the environment
  std::string says;     ///< part of the line
};

inline const std::string kConfig = source_dir() + "/config/";

/// Runs in `folder` through the shell; stderr into `said`.
inline int run(const fs::path& folder, const std::string& command, std::string& said) {
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

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A script without its line `lane = …`.
inline std::string without_lane(std::string script) {
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

}  // namespace phare::test
