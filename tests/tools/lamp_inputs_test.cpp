// process: what the commands do with their files: hints of the linter that help when followed, standard input as "-",
// and never a result over an input, under whatever name.
#include <cmath>
#include <map>
#include <set>

#include "lamp_program.h"
#include "visual/photometry/bench/lint.h"
#include "visual/photometry/readers/grid_build.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

class LampInputs : public test::LampProgram {
 protected:
  /// Any command of `phare`, as a shell reads it.
  Said phare(const std::string& command) const {
    const std::string out = in("stdout.txt"), err = in("stderr.txt");
    const int status = std::system((command.substr(0, command.find('@')) + "\"" + program("phare") + "\" " +
                                    command.substr(command.find('@') + 1) + " >'" + out + "' 2>'" + err + "'")
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::content_of(out), test::content_of(err)};
  }
};

/// The flags that a finding names, in its words: "--c0 -90", "without --mirror".
struct Advice {
  std::string id, text;
  std::vector<std::string> flags;
  bool without_mirror = false;
};
std::vector<Advice> advice_of(const LampReport& report) {
  std::vector<Advice> all;
  for (const Finding& finding : report.findings) {
    Advice advice{finding.id, finding.text, {}, false};
    const std::string text = advice.text;
    for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 2)) {
      std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-", at);
      end = std::min(end, text.size());
      std::string flag = text.substr(at, end - at);
      if (flag == "--mirror" && at >= 8 && text.substr(at - 8, 8) == "without ") {
        advice.without_mirror = true;
        continue;
      }
      // A value follows, unless the flag stands alone.
      if (flag != "--mirror" && end < text.size() && text[end] == ' ') {
        const std::size_t stop = text.find_first_of(" ),;", end + 1);
        flag += " " + text.substr(end + 1, stop == std::string::npos ? stop : stop - end - 1);
      }
      if (text.substr(at < 4 ? 0 : at - 4, 4).find("or ") != std::string::npos) continue;  // the other choice
      advice.flags.push_back(flag);
    }
    if (!advice.flags.empty() || advice.without_mirror) all.push_back(advice);
  }
  return all;
}

/// The settings of a user who does what a hint says: what it names is set anew, the rest stays.
LampReadSettings followed(LampReadSettings settings, const Advice& advice) {
  for (const std::string& flag : advice.flags) {
    const std::size_t blank = std::min(flag.find(' '), flag.size() - 1);
    const std::string name = flag.substr(0, flag.find(' ')), value = flag.substr(blank + 1);
    if (name == "--axis") {
      EXPECT_TRUE(value == "gamma0" || value == "gamma90") << advice.text;
      settings.axis = value == "gamma90" ? GammaAxis::kGamma90 : GammaAxis::kGamma0;
    } else if (name == "--c0") {
      settings.c0_turn_deg = std::stod(value);
    } else if (name == "--mirror") {
      settings.mirror_h = true;
    } else {
      ADD_FAILURE() << name << " is unknown to this test: " << advice.text;
    }
  }
  if (advice.without_mirror) settings.mirror_h = false;
  return settings;
}

// A lamp read wrongly in the ways that a setting can mend: each hint names a flag that `info` takes, following it
// makes that hint go away, and following all of them ends, with the lamp as it is.
TEST_F(LampInputs, EveryHintOfTheLinterHelpsWhenFollowed) {
  const auto low = read_lamp(ours("low_rht.ies"));
  ASSERT_TRUE(low.ok());
  const auto nodes = [](double from, double to, double step) {
    std::vector<double> all;
    for (int i = 0; from + step * i <= to + 1e-9; ++i) all.push_back(from + step * i);
    return all;
  };
  struct Case {
    std::string name, text;
    LampReadSettings settings;
  };
  std::vector<Case> cases;
  // Type C about the beam (gamma 0) and about the upright (gamma 90), plane C 0 in each of four places, read as either.
  for (const GammaAxis axis : {GammaAxis::kGamma0, GammaAxis::kGamma90}) {
    const bool upright = axis == GammaAxis::kGamma90;
    const IntensityTable whole = resample(*low, PhotometricType::kC, axis, nodes(0, 360, upright ? 1.0 : 5.0),
                                          upright ? nodes(80, 100, 0.1) : nodes(0, 20, 0.1));
    for (const double c0 : {0.0, 90.0, 180.0, 270.0}) {
      IntensityTable turned = whole;
      turn_about_axis(turned, -c0);
      const std::string name = std::string(upright ? "gamma90" : "gamma0") + ", C 0 at " + std::to_string(c0);
      LampReadSettings other, mirrored;
      other.axis = GammaAxis::kGamma90;
      other.c0_turn_deg = 180.0;
      mirrored.axis = GammaAxis::kGamma90;
      mirrored.c0_turn_deg = -90.0;
      mirrored.mirror_h = true;
      for (const LampReadSettings& settings : {LampReadSettings{}, other, mirrored})
        cases.push_back({name, lm63_text(turned), settings});
    }
  }
  // Stored clockwise, with words and without; read with --mirror where nothing is mirrored.
  IntensityTable b = resample(*low, PhotometricType::kB, GammaAxis::kGamma0, nodes(-20, 20, 0.5), nodes(-5, 3, 0.1));
  for (const char* words : {"for right-hand traffic", "a lamp"}) {
    b.header.keywords = {{"OTHER", words}};
    IntensityTable clockwise = b;
    mirror_left_right(clockwise);
    LampReadSettings mirror;
    mirror.mirror_h = true;
    cases.push_back({std::string("clockwise, ") + words, lm63_text(clockwise), {}});
    cases.push_back({std::string("right, mirrored, ") + words, lm63_text(b), mirror});
  }
  const std::string help = lamp("info --help").out;
  std::set<std::string> ids;
  for (const Case& one : cases) {
    const auto advices_of = [&](const LampReadSettings& settings) {
      const auto table = parse_lamp(one.text, "lamp.ies", settings);
      EXPECT_TRUE(table.ok());
      return table.ok() ? advice_of(lint_lamp(*table)) : std::vector<Advice>{};
    };
    LampReadSettings settings = one.settings;
    std::vector<Advice> advices = advices_of(settings);
    int steps = 0;
    for (; steps < 6 && !advices.empty(); ++steps) {
      const Advice advice = advices.front();
      ids.insert(advice.id);
      for (const std::string& flag : advice.flags)
        EXPECT_NE(help.find(flag.substr(0, flag.find(' ')) + " "), std::string::npos) << "no flag: " << advice.text;
      settings = followed(settings, advice);
      advices = advices_of(settings);
      for (const Advice& next : advices)
        EXPECT_FALSE(next.id == advice.id && next.text == advice.text)
            << one.name << ": followed, and still there: " << advice.text;
    }
    EXPECT_LT(steps, 5) << one.name << ": hints send in a circle";
    // Where the hints end the beam lies ahead.
    const auto table = parse_lamp(one.text, "lamp.ies", settings);
    for (const Finding& finding : lint_lamp(*table).findings) EXPECT_NE(finding.id, "axis") << one.name;
  }
  EXPECT_TRUE(ids.contains("axis"));
  EXPECT_TRUE(ids.contains("turned"));
  EXPECT_TRUE(ids.contains("mirrored"));
  EXPECT_TRUE(ids.contains("left-hand-traffic"));
}

TEST_F(LampInputs, StrictInfoFailsOnAnError) {
  const std::string dark = file("dark.csv", "# unit: cd\n# angles: type A\nV\\H,-1,1\n-1,0,0\n1,0,0\n");
  EXPECT_EQ(lamp("info " + dark).code, 0);
  EXPECT_EQ(lamp("info --strict " + dark).code, 1);
  EXPECT_EQ(lamp("info --strict --json " + ours("fog.ies") + " " + dark).code, 1);
  EXPECT_EQ(lamp("info --strict " + ours("low_rht.ies")).code, 0);
  EXPECT_EQ(lamp("info --strict " + dark + " " + in("absent.ies")).code, 2);
}

TEST_F(LampInputs, StandardInputIsAFile) {
  const std::string low = ours("low_rht.ies"), at = file("at.csv", "h_deg,v_deg\n0,-1\n");
  const auto same = [&](const std::string& with, const std::string& file_name) {
    const std::string piped = with.substr(0, with.find("LOW")) + "-" + with.substr(with.find("LOW") + 3);
    const std::string named = with.substr(0, with.find("LOW")) + low + with.substr(with.find("LOW") + 3);
    const Said from_pipe = lamp(piped + " < " + low), from_file = lamp(named);
    EXPECT_EQ(from_pipe.code, from_file.code) << piped << from_pipe.err;
    EXPECT_FALSE(from_pipe.out.empty()) << piped;
    if (!file_name.empty()) {
      EXPECT_NE(from_pipe.out.find(file_name), std::string::npos) << piped << "\n" << from_pipe.out;
    }
  };
  same("info LOW", "26");  // its grid or peak
  same("table LOW --at " + at, "");
  same("check LOW --rule r112-passing-b", "standard input");
  same("convert LOW --to lm63 --out -", "IES:LM-63-2019");
  same("compare LOW " + low, "");
  same("plot LOW --view birds_eye --out " + in("p"), "");
  same("hspr LOW " + low, "");
  same("levels LOW", "standard input");
  EXPECT_EQ(lamp("table " + low + " --at - < " + at).out, lamp("table " + low + " --at " + at).out);
  EXPECT_EQ(lamp("table - --at " + at + " < " + low).out, lamp("table " + low + " --at " + at).out);
  // A pipe that is no file.
  EXPECT_EQ(phare("cat " + low + " | @lamp info -").code, 0);
  // A format without marks of its own has to be named, and the message says how.
  lamp("convert " + low + " --out-axis gamma90 --out " + in("low.ldt"));
  EXPECT_NE(lamp("info - < " + in("low.ldt")).err.find("--format says which"), std::string::npos);
  EXPECT_EQ(lamp("info - --format eulumdat --axis gamma90 < " + in("low.ldt")).code, 0);
  EXPECT_NE(lamp("info - < /dev/null").err.find("standard input: is empty"), std::string::npos);
  const std::string bad = file("bad.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 x\n");
  EXPECT_NE(lamp("info - < " + bad).err.find("standard input:3: "), std::string::npos);
}

TEST_F(LampInputs, StandardInputIsReadOnce) {
  const std::string low = ours("low_rht.ies");
  for (const std::string command :
       {"info - -", "check - - --rule fmvss108-lb2v", "convert - /dev/stdin --out x.ies", "compare - -",
        "plot - - --out p", "hspr - -", "table - --at -", "hspr a - --high b -"}) {
    const Said said = lamp(command + " < " + low);
    EXPECT_EQ(said.code, 2) << command;
    EXPECT_NE(said.err.find("is standard input, which can be read only once"), std::string::npos)
        << command << said.err;
  }
  const std::string points = file("points.csv", "x_m,y_m,z_m,nx,ny,nz\n10,0,0,0,0,1\n");
  const std::string method = " --method reference --out ";
  EXPECT_EQ(phare("@measure --lamp " + low + ",x=0,y=0,z=0.65 --points -" + method + in("a.csv") + " < " + points).code,
            0);
  EXPECT_EQ(phare("@measure --lamp -,x=0,y=0,z=0.65 --points " + points + method + in("b.csv") + " < " + low).code, 0);
  EXPECT_EQ(test::content_of(in("a.csv")), test::content_of(in("b.csv")));
  const Said both = phare("@measure --lamp -,x=0,y=0,z=0.65 --points -" + method + in("c.csv") + " < " + low);
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.err.find("can be read only once"), std::string::npos) << both.err;
  // One lamp file for two lamps is one file; read in two ways it is not.
  EXPECT_EQ(phare("@measure --lamp -,x=0,y=0.6,z=0.65 --lamp -,x=0,y=-0.6,z=0.65 --points " + points + method +
                  in("d.csv") + " < " + low)
                .code,
            0);
  const Said twice = phare("@measure --lamp -,x=0,y=0.6,z=0.65 --lamp -,x=0,y=-0.6,z=0.65,mirror=1 --points " + points +
                           method + in("e.csv") + " < " + low);
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("standard input: can be read only once"), std::string::npos) << twice.err;
}

// Refused before anything is written, whatever name leads to the file.
TEST_F(LampInputs, NoResultIsWrittenOverAnInput) {
  const std::string text = test::content_of(ours("fog.ies"));
  const std::string lamp_file = file("lamp.csv", test::content_of(ours("fog.ies")));
  const std::string ies = file("lamp.ies", text), points = file("points.csv", "x_m,y_m,z_m,nx,ny,nz\n10,0,0,0,0,1\n"),
                    angles = file("angles.csv", "h_deg,v_deg\n0,-1\n"), wall = file("wall_25m.svg", text),
                    ratio = file("ratio.png", text), rig = file("rig.toml", "[rig]\n"), log = file("log.can", "x\n"),
                    rule = file("rule.toml", test::content_of(rules_dir() + "/r112-passing-b.toml"));
  std::filesystem::create_hard_link(ies, in("hard.ies"));
  std::filesystem::create_symlink(ies, in("soft.ies"));
  std::filesystem::create_directories(in("folder"));
  const std::string names[] = {ies, in("hard.ies"), in("soft.ies"), in("./lamp.ies"), in("folder/../lamp.ies")};
  std::vector<std::string> commands;
  for (const std::string& out : names) {
    commands.push_back("@lamp convert " + ies + " --to lm63 --out " + out);
    commands.push_back("@lamp convert " + ours("high.ies") + " " + ies + " --out " + out);
    commands.push_back("@lamp table " + ies + " --at " + angles + " --out " + out);
    commands.push_back("@lamp check " + ies + " --rule r112-passing-b --out " + out);
    commands.push_back("@measure --lamp " + ies + ",x=0,y=0,z=1 --points " + points + " --method reference --out " +
                       out);
  }
  commands.push_back("@lamp table " + ies + " --at " + angles + " --out " + angles);
  commands.push_back("@measure --lamp " + ies + ",x=0,y=0,z=1 --points " + points + " --method reference --out " +
                     points);
  commands.push_back("@lamp check " + ies + " --rule " + rule + " --out " + rule);
  commands.push_back("@lamp plot " + wall + " --format lm63 --out " + in("."));
  commands.push_back("@lamp compare " + ratio + " " + ies + " --format lm63 --out " + in("."));
  commands.push_back("@record --rig " + rig + " --out " + rig);
  commands.push_back("@import --can " + log + " --dbc " + points + " --pose " + angles + " --out " + log);
  commands.push_back("@import --can " + log + " --dbc " + points + " --pose " + angles + " --out " + points);
  commands.push_back("@import --can " + log + " --dbc " + points + " --pose " + angles + " --out " + angles);
  commands.push_back("@import --can " + log + " --dbc " + points + " --pose " + angles + " --rig " + rig + " --out " +
                     rig);
  std::map<std::string, std::string> before;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    if (entry.is_regular_file()) before[entry.path()] = test::content_of(entry.path());
  for (const std::string& command : commands) {
    const Said said = phare(command);
    EXPECT_EQ(said.code, 2) << command;
    EXPECT_NE(said.err.find("it would be overwritten"), std::string::npos) << command << "\n" << said.err;
  }
  for (const auto& [path, content] : before) {
    if (path.ends_with("stdout.txt") || path.ends_with("stderr.txt")) continue;
    EXPECT_EQ(test::content_of(path), content) << path;
  }
  EXPECT_FALSE(std::filesystem::exists(in("isocandela.svg"))) << "nothing else is written either";
  // A file of the same content is another file.
  EXPECT_EQ(phare("@lamp convert " + ies + " --out " + in("other.ies")).code, 0);
}

}  // namespace
}  // namespace phare
