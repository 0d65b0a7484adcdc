// process: manual page, completion and --help tell of the same options; what `phare drive` hands on to phare-visual.
#include "tools/help_data.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "config/picture_options.h"
#include "tests/paths.h"

namespace phare {
namespace {

struct Output {
  int code = -1;
  std::string text;
};

/// stdout of a shell command; stderr too where the command says so.
Output output_of(const std::string& command) {
  Output output;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) output.text.push_back(static_cast<char>(c));
  const int status = pclose(pipe);
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

std::string phare(const std::string& arguments) {
  const Output output = output_of(quoted(program("phare")) + " " + arguments);
  EXPECT_EQ(output.code, 0) << arguments;
  return output.text;
}

nlohmann::json commands_of_phare() {
  static const nlohmann::json data = nlohmann::json::parse(phare("help-data"), nullptr, false);
  return data;
}

/// "--rig" of "  --rig TEXT  …" and all others in the words of --help.
std::set<std::string> long_options_of_help(const std::string& help) {
  std::set<std::string> names;
  std::istringstream in(help);
  for (std::string line; std::getline(in, line) && !line.starts_with("Example");) {
    std::istringstream words(line);
    std::string word;
    if (!line.starts_with("  -")) continue;
    for (words >> word; word.starts_with("-"); word.clear(), words >> word) {
      std::istringstream parts(word);
      for (std::string name; std::getline(parts, name, ',');)
        if (name.starts_with("--")) names.insert(name.substr(0, name.find('{')));  // a flag that turns off: "{false}"
    }
  }
  return names;
}

TEST(HelpData, HasEveryOptionThatHelpShows) {
  const nlohmann::json data = commands_of_phare();
  ASSERT_GT(data.size(), 12u);
  for (const nlohmann::json& command : data) {
    std::set<std::string> names;
    for (const nlohmann::json& option : command["options"])
      for (const std::string name : option["names"])
        if (name.starts_with("--")) names.insert(name);
    const std::string path = command["path"];
    EXPECT_EQ(names,
              long_options_of_help(phare(path.substr(std::min(path.size(), std::string("phare ").size())) + " --help")))
        << path;
  }
}

TEST(ManualPage, HasEveryOptionOfEveryCommandAndGroffHasNoWarning) {
  const std::string page = phare("manual");
  for (const nlohmann::json& command : commands_of_phare()) {
    const std::string path = command["path"];
    std::string roff_path;
    for (const char c : path) roff_path += c == '-' ? std::string("\\-") : std::string(1, c);
    const std::size_t begin = path == "phare" ? 0 : page.find(".SS \"" + roff_path + "\"\n");
    ASSERT_NE(begin, std::string::npos) << path;
    const std::size_t end = page.find(path == "phare" ? ".SH COMMANDS" : "\n.S", begin + 1);
    const std::string section = page.substr(begin, end - begin);
    for (const nlohmann::json& option : command["options"]) {
      for (const std::string name : option["names"]) {
        std::string roff;
        for (const char c : name) roff += c == '-' ? std::string("\\-") : std::string(1, c);
        EXPECT_NE(section.find((name.starts_with("-") ? "\\fB" : "\\fI") + roff + "\\fR"), std::string::npos)
            << path << " " << name;
      }
    }
  }
  for (const char* told :
       {".SH ENVIRONMENT", "PHARE_RUN_DIR", "PHARE_GENERATED_DIR", "PHARE_PYTHON", ".SH FILES", "130"})
    EXPECT_NE(page.find(told), std::string::npos) << told;
  EXPECT_EQ(page.find(source_dir()), std::string::npos) << "names a folder of this machine";
  if (output_of("command -v groff").code != 0) GTEST_SKIP() << "no groff: the page is not set";
  const Output said = output_of(quoted(program("phare")) + " manual | groff -man -ww -z -Tutf8 2>&1");
  EXPECT_EQ(said.text, "");
}

/// What bash itself would offer after these words.
std::set<std::string> offered(const std::string& words, const std::string& current) {
  const std::string script = "eval \"$(" + quoted(program("phare")) +
                             " completion bash)\"; complete -p phare >/dev/null || exit 9; "
                             "COMP_WORDS=(" +
                             words + " " + (current.empty() ? "''" : quoted(current)) +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); "
                             "_phare; printf '%s\\n' \"${COMPREPLY[@]}\"";
  std::ofstream(testing::TempDir() + "/phare_completion.sh") << script << "\n";
  const Output output = output_of("bash " + testing::TempDir() + "/phare_completion.sh 2>&1");
  EXPECT_EQ(output.code, 0) << output.text;
  std::set<std::string> names;
  std::istringstream in(output.text);
  for (std::string line; std::getline(in, line);) names.insert(line);
  return names;
}

TEST(Completion, BashOffersCommandsOptionsAndChoices) {
  EXPECT_TRUE(offered("phare", "").contains("drive"));
  EXPECT_EQ(offered("phare", "dr"), std::set<std::string>{"drive"});
  EXPECT_TRUE(offered("phare lamp", "").contains("check"));
  EXPECT_EQ(offered("phare drive --camera", ""),
            (std::set<std::string>{"driver", "birds-eye", "chase", "oncoming", "wall", "left-mirror", "inner-mirror",
                                   "right-mirror", "free"}));
  EXPECT_EQ(offered("phare drive --headless --camera", "c"), (std::set<std::string>{"chase"}));
  EXPECT_EQ(offered("phare lamp check x.ies --traffic", "r"), (std::set<std::string>{"right"}));
  for (const nlohmann::json& command : commands_of_phare()) {
    std::set<std::string> names;
    for (const nlohmann::json& option : command["options"])
      for (const std::string name : option["names"])
        if (name.starts_with("-")) names.insert(name);
    EXPECT_EQ(offered(command["path"], "-"), names) << command["path"];
  }
}

TEST(Completion, ZshHasEveryOption) {
  const std::string script = phare("completion zsh");
  for (const nlohmann::json& command : commands_of_phare()) {
    std::string function = "_" + command["path"].get<std::string>();
    for (char& c : function)
      if (c == ' ' || c == '-') c = '_';
    const std::size_t begin = script.find("\n" + function + "() {");
    ASSERT_NE(begin, std::string::npos) << function;
    const std::string body = script.substr(begin, script.find("\n}\n", begin) - begin);
    for (const nlohmann::json& option : command["options"])
      for (const std::string name : option["names"])
        EXPECT_TRUE(!name.starts_with("-") || body.find("'*" + name + "[") != std::string::npos) << function << name;
  }
  if (output_of("command -v zsh").code != 0) GTEST_SKIP() << "no zsh: the script is not parsed";
  EXPECT_EQ(output_of(quoted(program("phare")) + " completion zsh | zsh -n 2>&1").text, "");
}

TEST(Version, SaysVersionCommitAndDevice) {
  const std::string said = phare("--version");
  EXPECT_TRUE(said.starts_with(std::string("phare ") + PHARE_VERSION + ", commit ")) << said;
  EXPECT_NE(said.find("\nVulkan device: "), std::string::npos) << said;
  const Output described = output_of("git -C " + quoted(source_dir()) + " rev-parse --short HEAD 2>/dev/null");
  if (described.code != 0) GTEST_SKIP() << "no git to ask for the commit";
}

// ---- phare drive and phare-visual

/// Options of phare-visual that `phare drive` sets itself or that make no sense there.
const std::set<std::string> kSetByDrive{"--alive", "--channel", "--demo", "--go-on", "--guide", "--report", "--stats"};

TEST(PictureOptions, EveryOptionOfVisualReachesItThroughDrive) {
  const Output visual = output_of(quoted(program("phare-visual")) + " --help");
  if (visual.code != 0) GTEST_SKIP() << "no phare-visual: built without graphics";
  const std::set<std::string> of_visual = long_options_of_help(visual.text),
                              of_drive = long_options_of_help(phare("drive --help"));
  EXPECT_GT(of_visual.size(), 15u);
  for (const std::string& name : of_visual)
    EXPECT_TRUE(of_drive.contains(name) || kSetByDrive.contains(name) || name == "--version")
        << name << " of phare-visual cannot be given to phare drive";
}

TEST(PictureOptions, AreTurnedBackIntoTheArgumentsTheyWere) {
  const std::vector<std::string> given{
      "--frames",   "3",           "--size",         "320x180", "--samples",     "4",
      "--camera",   "chase",       "--exposure",     "1.5",     "--adaptation",  "4300",
      "--method",   "vertex-1998", "--false-colour", "--set",   "lines=off",     "--still-at",
      "2.5",        "--traffic",   "/dev/null",      "--video", "--beam-image",  "half-float-native-nodes",
      "--road-lod", "2",           "--audit-every",  "0",       "--audit-bound", "1%",
      "--frames-in-flight", "1", "--device", "llvm", "--validation"};
  PictureOptions options;
  CLI::App app;
  options.add_to(app);
  // Declared and not in the list above: a new option that this test has not heard of.
  std::set<std::string> named(given.begin(), given.end());
  for (const CLI::Option* option : app.get_options())
    EXPECT_TRUE(option->get_group() != "Picture" || named.contains(option->get_name())) << option->get_name();
  app.parse(std::vector<std::string>(given.rbegin(), given.rend()));
  EXPECT_EQ(options.width_px, 320);
  const DeskCommand camera{"camera", "chase"};
  EXPECT_NE(std::ranges::find(options.desk, camera), options.desk.end());
  EXPECT_EQ(options.arguments(), given);

  PictureOptions none;
  CLI::App bare;
  none.add_to(bare);
  bare.parse(std::vector<std::string>{});
  EXPECT_TRUE(none.arguments().empty());
}

TEST(Examples, AreTheCommandLinesAfterTheWord) {
  EXPECT_EQ(examples_in("Commands:\n  phare nothing\nExample:\n  phare a --b\n  phare-c\nMore words.\n"),
            (std::vector<std::string>{"phare a --b", "phare-c"}));
  EXPECT_EQ(examples_in("Example: phare a"), (std::vector<std::string>{"phare a"}));
  EXPECT_TRUE(examples_in("none").empty());
}

}  // namespace
}  // namespace phare
