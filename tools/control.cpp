// phare control: commands to a running rig - dim, swivel, place, aim, design, pause, quit - and its answers.
#include <poll.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <iomanip>
#include <memory>
#include <numbers>
#include <sstream>
#include <utility>

#include "config/toml_table.h"
#include "tools/commands.h"
#include "tools/control_client.h"

namespace phare {
namespace {

struct ControlOptions {
  std::string rig_file = config_path("rigs/country_road.toml");
  std::uint16_t port_base = 0;
  double wait_s = 3.0;
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
    {"seek", "SECONDS", "to this time of a replayed drive"},
    {"status", "", "what is lit, the design, each lamp's place, turn and light"},
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
  if (verb == "seek" && numbers.size() == 1) {
    if (numbers[0] < 0.0 || numbers[0] > 1e9) return Error{verb, "seconds from the beginning of the drive"};
    return RigControl{RigControl::Seek{numbers[0]}};
  }
  if (verb == "status" && words.size() == 1) return RigControl{RigControl::Tell{}};
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

using Outcome = ControlClient::Outcome;

/// Of an answer in a stream, on one line: "ok: headlamp left: source 17 at 0 %".
void print_line(const ControlClient::Answer& answer) {
  std::string text = answer.text;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) text.replace(at, 1, ";");
  std::printf("%s%s%s\n", answer.outcome == Outcome::kRefused ? "refused" : "ok", text.empty() ? "" : ": ",
              text.c_str());
  std::fflush(stdout);
}

int one_command(const RigControl& control, ControlClient& client) {
  client.put(control);
  const ControlClient::Answer answer = client.wait_for_next();
  if (answer.outcome == Outcome::kDone) {
    std::printf("%s\n", answer.text.empty() ? "done" : answer.text.c_str());
    return kExitDone;
  }
  std::fprintf(stderr, "phare: %s\n", answer.text.c_str());
  return answer.outcome == Outcome::kRefused ? kExitBadInput : kExitCheckFailed;
}

/// Whole lines of standard input as they come, without waiting for the next.
class LineReader {
 public:
  bool ended() const { return ended_; }
  /// Reads what waits; lines it completes go to `take`.
  void read(const std::function<void(const std::string&)>& take) {
    char bytes[4096];
    const ssize_t count = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (count < 0) return;  // a signal
    if (count == 0) {
      ended_ = true;
      if (!rest_.empty()) take(std::exchange(rest_, {}));
      return;
    }
    rest_.append(bytes, static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1)
      take(rest_.substr(begin, end - begin));
    rest_.erase(0, begin);
  }

 private:
  std::string rest_;
  bool ended_ = false;
};

/// Commands, one a line: a control unit that dims segments as it drives. One line out for every one in; what is refused
/// does not end the stream, and the exit code tells of it.
int command_stream(ControlClient& client) {
  LineReader lines;
  std::size_t line_number = 0, commands = 0, refused = 0;
  const auto take = [&](const std::string& line) {
    ++line_number;
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; in >> std::quoted(word);) words.push_back(word);
    if (words.empty() || words.front().starts_with('#')) return;
    ++commands;
    const auto command = parse(words);
    if (command) {
      client.put(*command);
    } else {
      client.put_refused("line " + std::to_string(line_number) + ": " + command.error().text());
    }
  };
  while (!lines.ended() || !client.idle()) {
    const bool reads = !lines.ended() && !client.full();
    pollfd waited[2] = {{client.fd(), POLLIN, 0}, {reads ? STDIN_FILENO : -1, POLLIN, 0}};
    ::poll(waited, 2, 20);
    if (reads && waited[1].revents != 0) lines.read(take);
    client.step();
    while (const auto answer = client.next()) {
      if (answer->outcome == Outcome::kSilent) {
        std::fprintf(stderr, "phare: %s\n", answer->text.c_str());
        return kExitCheckFailed;
      }
      if (answer->outcome == Outcome::kRefused) ++refused;
      print_line(*answer);
    }
  }
  if (refused == 0) return kExitDone;
  std::fprintf(stderr, "phare: standard input: %zu of %zu commands refused\n", refused, commands);
  return kExitBadInput;
}

int control(const ControlOptions& options) {
  auto rig = read_rig(options.rig_file);
  if (!rig) return bad_input(rig.error());
  if (options.port_base != 0) rig->port_base = options.port_base;
  const bool stream = options.words == std::vector<std::string>{"-"};
  const auto command = stream ? Result<RigControl>(RigControl{}) : parse(options.words);
  if (!command) return bad_input(command.error());
  auto bus = Bus::open_to_send(*rig, Role::kControl);
  if (!bus) return bad_input(bus.error());
  ControlClient client(std::move(*bus), *rig,
                       std::chrono::nanoseconds(static_cast<std::int64_t>(options.wait_s * 1e9)));
  return stream ? command_stream(client) : one_command(*command, client);
}

}  // namespace

void add_control(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ControlOptions>();
  CLI::App* command = app.add_subcommand(
      "control", "Command a running rig, and hear what it says: dim, swivel, move and aim lamps, swap designs, pause");
  command->footer(
      "Commands:\n" + all_commands() +
      "The answer is what holds now. Exit code 2: the rig refuses, and says why; 1: nobody answers.\n"
      "With -, one command a line comes from standard input and one answer a line goes out, \"ok: ...\" or "
      "\"refused: ...\";\nwhat is refused does not end the stream, and makes its exit code 2.\n"
      "Examples, while phare drive runs:\n  phare control status\n  phare control dim \"headlamp left\" 1 0.5\n"
      "  phare control - < commands.txt");
  command->add_option("--rig", options->rig_file, "Rig file: address, ports, channels and key")->capture_default_str();
  command->add_option("--port-base", options->port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(1024, 65000));
  command->add_option("--wait", options->wait_s, "Seconds to wait for an answer")
      ->check(CLI::Range(0.01, 3600.0))
      ->capture_default_str();
  command->add_option("command", options->words, "A command and what it needs; - reads one a line from standard input")
      ->required();
  command->callback([options, &chosen] { chosen = [options] { return control(*options); }; });
}

}  // namespace phare
