// phare control: commands to a running rig - dim, swivel, place, aim, design, pause, quit.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>

#include "config/toml_table.h"
#include "net/bus.h"
#include "tools/commands.h"

namespace phare {
namespace {

struct ControlOptions {
  std::string rig_file = config_path("rigs/country_road.toml");
  std::uint16_t port_base = 0;
  std::vector<std::string> words;
};

struct Usage {
  const char* verb;
  const char* words;
  const char* meaning;
};
constexpr Usage kCommands[] = {
    {"dim", "LAMP SOURCE LIGHT", "LIGHT 0 to 1 for a source of the lamp, counted from 1 (0: all)"},
    {"swivel", "LAMP YAW_DEG [PITCH_DEG]", "a whole lamp, left and up positive"},
    {"place", "LAMP X_M Y_M Z_M", "a lamp elsewhere on the car: from below the rear axle's middle forward, left, up"},
    {"aim", "PITCH_DEG", "all lamps, up positive"},
    {"design", "INDEX", "counted from 0"},
    {"pause", "", ""},
    {"resume", "", ""},
    {"quit", "", ""}};

std::string all_commands() {
  std::string text;
  for (const Usage& usage : kCommands)
    text +=
        std::string("  ") + usage.verb + " " + usage.words + (*usage.meaning != 0 ? "   " : "") + usage.meaning + "\n";
  return text;
}

Result<double> number(const std::string& word) {
  std::size_t used = 0;
  double value = NAN;
  try {
    value = std::stod(word, &used);
  } catch (const std::exception&) {
  }
  if (used != word.size() || !std::isfinite(value)) return Error{"", "expected a number, got \"" + word + "\""};
  return value;
}

/// One command in words, as on the command line.
Result<RigControl> parse(const std::vector<std::string>& words) {
  if (words.empty()) return Error{"", "no command"};
  const std::string& verb = words.front();
  std::vector<double> numbers;
  const bool names_a_lamp = verb == "dim" || verb == "swivel" || verb == "place";
  for (std::size_t i = names_a_lamp ? 2 : 1; i < words.size(); ++i) {
    const auto value = number(words[i]);
    if (!value) return Error{verb, value.error().reason};
    numbers.push_back(*value);
  }
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const auto whole = [&](double value) { return value >= 0.0 && value <= 1e4 && value == std::floor(value); };
  if (verb == "dim" && numbers.size() == 2) {
    if (!whole(numbers[0])) return Error{verb, "sources are counted from 1, 0 means all"};
    if (numbers[1] < 0.0 || numbers[1] > 1.0) return Error{verb, "light is 0 to 1"};
    return RigControl{RigControl::Dim{words[1], static_cast<std::uint32_t>(numbers[0]), numbers[1]}};
  }
  if (verb == "swivel" && (numbers.size() == 1 || numbers.size() == 2)) {
    for (const double deg : numbers)
      if (std::abs(deg) > 90.0) return Error{verb, "an angle beyond 90 degrees"};
    return RigControl{
        RigControl::Swivel{words[1], numbers[0] * kRadPerDeg, numbers.size() == 2 ? numbers[1] * kRadPerDeg : 0.0}};
  }
  if (verb == "place" && numbers.size() == 3) {
    for (const double at_m : numbers)
      if (std::abs(at_m) > 50.0) return Error{verb, "a lamp more than 50 m from its car"};
    return RigControl{RigControl::Place{words[1], numbers[0], numbers[1], numbers[2]}};
  }
  if (verb == "aim" && numbers.size() == 1) {
    if (std::abs(numbers[0]) > 90.0) return Error{verb, "an angle beyond 90 degrees"};
    return RigControl{RigControl::Aim{numbers[0] * kRadPerDeg}};
  }
  if (verb == "design" && numbers.size() == 1) {
    if (!whole(numbers[0]) || numbers[0] > 9999.0) return Error{verb, "designs are counted from 0"};
    return RigControl{RigControl::Design{static_cast<std::uint32_t>(numbers[0])}};
  }
  if ((verb == "pause" || verb == "resume") && words.size() == 1) return RigControl{RigControl::Pause{verb == "pause"}};
  if (verb == "quit" && words.size() == 1) return RigControl{RigControl::Quit{}};
  std::vector<std::string> verbs;
  for (const Usage& usage : kCommands) {
    if (verb == usage.verb)
      return Error{verb,
                   *usage.words != 0 ? std::string("expected ") + verb + " " + usage.words : "takes nothing more"};
    verbs.emplace_back(usage.verb);
  }
  return Error{"", unknown_name_reason("command", verb, verbs)};
}

int control(const ControlOptions& options) {
  auto rig = read_rig(options.rig_file);
  if (!rig) return bad_input(rig.error());
  if (options.port_base != 0) rig->port_base = options.port_base;
  auto bus = Bus::open_to_send(*rig, Role::kControl);
  if (!bus) return bad_input(bus.error());
  if (options.words != std::vector<std::string>{"-"}) {
    const auto command = parse(options.words);
    if (!command) return bad_input(command.error());
    bus->send(SimTime{}, *command);
    return kExitDone;
  }
  // A stream of commands, one a line: a control unit that dims segments as it drives.
  std::string line;
  for (std::size_t count = 1; std::getline(std::cin, line); ++count) {
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; in >> std::quoted(word);) words.push_back(word);
    if (words.empty() || words.front().starts_with('#')) continue;
    const auto command = parse(words);
    if (!command) return bad_input({"standard input:" + std::to_string(count), command.error().text()});
    bus->send(SimTime{}, *command);
  }
  return kExitDone;
}

}  // namespace

void add_control(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ControlOptions>();
  CLI::App* command = app.add_subcommand(
      "control", "Command a running rig: dim, swivel and move lamps, aim, swap designs, pause, quit");
  command->footer("Commands:\n" + all_commands() +
                  "Example:\n  phare control dim \"headlamp left\" 17 0\n  adb_unit | phare control --rig "
                  "config/rigs/matrix.toml -");
  command->add_option("--rig", options->rig_file, "Rig file")->capture_default_str();
  command->add_option("--port-base", options->port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(1024, 65000));
  command->add_option("command", options->words, "A command and what it needs; - reads one a line from standard input")
      ->required();
  command->callback([options, &chosen] { chosen = [options] { return control(*options); }; });
}

}  // namespace phare
