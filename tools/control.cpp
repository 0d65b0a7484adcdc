// phare control: commands to a running rig - dim, move lamps, design, set, pause, quit - and its answers.
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <memory>
#include <numbers>
#include <sstream>
#include <utility>

#include "config/desk.h"
#include "config/finite_numbers.h"
#include "config/formats/toml_table.h"
#include "config/port_base.h"
#include "net/run_key.h"
#include "tools/commands.h"
#include "tools/control_client.h"

namespace phare {
namespace {

struct ControlOptions {
  std::string rig_file = config_path("rigs/country_road.toml");
  std::uint16_t port_base = 0;
  bool open_bus = false;
  double wait_s = 3.0;
  std::vector<std::string> words;
};

/// The words of a command after its verb.
struct Words {
  std::string lamp;              ///< of verbs that name one
  std::vector<double> numbers;   ///< of all others, but for `text`
  std::string text;              ///< of verbs that take words: all of them
  std::vector<std::string> all;  ///< the same, each
};
enum class Takes { kNumbers, kLampAndNumbers, kText };

/// One verb: what it takes, and the command it makes of that or why not.
struct Verb {
  const char* name;
  const char* words;
  const char* meaning;
  Takes takes;
  std::size_t least, most;  ///< numbers, or words of a text
  Result<RigControl> (*make)(const Words& words);
};

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

bool is_count(double value, double most) {
  return value >= 0.0 && value <= most && value == std::floor(value);
}

Result<RigControl> dim(const Words& w) {
  if (!is_count(w.numbers[0], 1e4)) return Error{"", "sources are counted from 1, 0 means all"};
  if (w.numbers[1] < 0.0 || w.numbers[1] > 1.0) return Error{"", "light is 0 to 1"};
  return RigControl{RigControl::Dim{w.lamp, static_cast<std::uint32_t>(w.numbers[0]), w.numbers[1]}};
}
Result<RigControl> swivel(const Words& w) {
  for (const double deg : w.numbers)
    if (std::abs(deg) > 90.0) return Error{"", "an angle beyond 90 degrees"};
  const double pitch_deg = w.numbers.size() == 2 ? w.numbers[1] : 0.0;
  return RigControl{RigControl::Swivel{w.lamp, w.numbers[0] * kRadPerDeg, pitch_deg * kRadPerDeg}};
}
Result<RigControl> place(const Words& w) {
  for (const double at_m : w.numbers)
    if (std::abs(at_m) > 50.0) return Error{"", "a lamp more than 50 m from its car"};
  return RigControl{RigControl::Place{w.lamp, w.numbers[0], w.numbers[1], w.numbers[2]}};
}
Result<double> number(const std::string& word);

/// "[by] NUMBER" from the word `at` on, and nothing behind.
Result<RigControl::Mount> mount_of(const Words& w, std::size_t at) {
  RigControl::Mount mount;
  mount.by = at < w.all.size() && w.all[at] == "by";
  if (mount.by) ++at;
  if (at + 1 != w.all.size()) return Error{"", "expected one number, or by and one"};
  const auto value = number(w.all[at]);
  if (!value) return value.error();
  mount.value = *value;
  return mount;
}
Result<RigControl> aim(const Words& w) {
  auto mount = mount_of(w, 0);
  if (!mount) return mount.error();
  if (std::abs(mount->value) > 90.0) return Error{"", "an angle beyond 90 degrees"};
  if (!mount->by) return RigControl{RigControl::Aim{mount->value * kRadPerDeg}};
  mount->quantity = rig_command::MountQuantity::kPitch;
  mount->value *= kRadPerDeg;
  return RigControl{std::move(*mount)};
}
Result<RigControl> move(const Words& w) {
  using rig_command::MountQuantity;
  constexpr std::string_view kNames[] = {"forward", "left", "up", "spacing", "yaw", "pitch", "roll"};
  if (w.all.size() < 3) return Error{"", "expected a lamp or a pair, what of it, and how much"};
  auto mount = mount_of(w, 2);
  if (!mount) return mount.error();
  const auto found = std::ranges::find(kNames, w.all[1]);
  if (found == std::end(kNames))
    return Error{
        "", unknown_name_reason("quantity", w.all[1], std::vector<std::string>(std::begin(kNames), std::end(kNames)))};
  mount->lamp = w.all[0] == "all" ? "" : w.all[0];
  mount->quantity = static_cast<MountQuantity>(found - std::begin(kNames));
  if (mount->quantity > MountQuantity::kSpacing) {
    if (std::abs(mount->value) > 90.0) return Error{"", "an angle beyond 90 degrees"};
    mount->value *= kRadPerDeg;
  } else if (std::abs(mount->value) > 50.0) {
    return Error{"", "a lamp more than 50 m from its car"};
  }
  return RigControl{std::move(*mount)};
}
Result<RigControl> frame(const Words& w) {
  if (w.all.size() != 2) return Error{"", "expected a lamp and a file"};
  std::string file = std::filesystem::absolute(w.all[1]).lexically_normal().string();
  if (file.size() > 4096) return Error{"", "more than a message holds"};
  return RigControl{RigControl::Frame{w.all[0], std::move(file)}};
}
Result<RigControl> undo(const Words& w) {
  const double steps = w.numbers.empty() ? 1.0 : w.numbers[0];
  if (!is_count(steps, 1000.0) || steps < 1.0) return Error{"", "1 to 1000 steps"};
  return RigControl{RigControl::Undo{static_cast<std::uint32_t>(steps)}};
}
Result<RigControl> reset(const Words& w) {
  return RigControl{RigControl::Reset{w.text == "all" ? "" : w.text}};
}
Result<RigControl> save(const Words& w) {
  std::string file;
  if (!w.text.empty()) file = std::filesystem::absolute(w.text).lexically_normal().string();
  if (file.size() > 4096) return Error{"", "more than a message holds"};
  return RigControl{RigControl::Save{std::move(file)}};
}
Result<RigControl> design(const Words& w) {
  if (!is_count(w.numbers[0], 9999.0)) return Error{"", "designs are counted from 0"};
  return RigControl{RigControl::Design{static_cast<std::uint32_t>(w.numbers[0])}};
}
Result<RigControl> seek(const Words& w) {
  if (w.numbers[0] < 0.0 || w.numbers[0] > 1e9) return Error{"", "seconds from the beginning of the drive"};
  return RigControl{RigControl::Seek{w.numbers[0]}};
}
Result<RigControl> set(const Words& w) {
  const DeskCommand command = desk_command(w.text);
  // Whether there is such a setting the picture says; what no message can hold is told here.
  if (command.setting.size() > 64 || command.value.size() > 1024) return Error{"", "more than a message holds"};
  return RigControl{RigControl::Set{command.setting, command.value}};
}
template <typename Kind, bool... on>
Result<RigControl> plain(const Words&) {
  return RigControl{Kind{on...}};
}

constexpr std::size_t kAny = 1000;
constexpr Verb kVerbs[] = {
    {"dim", "LAMP SOURCE LIGHT", "LIGHT 0 to 1 for a source of the lamp, counted from 1 (0: all)",
     Takes::kLampAndNumbers, 2, 2, dim},
    {"frame", "LAMP FILE", "the picture (PNG, PGM) that the lamp's pixel light shines", Takes::kText, 2, 2, frame},
    {"swivel", "LAMP YAW_DEG [PITCH_DEG]", "a whole lamp, left and up positive", Takes::kLampAndNumbers, 1, 2, swivel},
    {"place", "LAMP X_M Y_M Z_M", "a lamp elsewhere on the car: from below the rear axle's middle forward, left, up",
     Takes::kLampAndNumbers, 3, 3, place},
    {"aim", "[by] PITCH_DEG", "all lamps, up positive; by: the levelling wheel, on top of what holds", Takes::kText, 1,
     2, aim},
    {"move", "LAMP|PAIR QUANTITY [by] VALUE",
     "forward, left, up, spacing (m) or yaw, pitch, roll (degrees) of a lamp or a pair; by: on top of what holds",
     Takes::kText, 3, 4, move},
    {"undo", "[STEPS]", "takes back what was placed, turned or aimed last", Takes::kNumbers, 0, 1, undo},
    {"reset", "[LAMP|PAIR]", "place and turn as in the rig file; without a lamp: of all, and the aim", Takes::kText, 0,
     1, reset},
    {"save", "[FILE]", "places and turns into the rig file, comments kept, or into another beside it", Takes::kText, 0,
     kAny, save},
    {"design", "INDEX", "counted from 0", Takes::kNumbers, 1, 1, design},
    {"set", "SETTING [VALUE]", "a setting of the picture, below; without a value: what it is", Takes::kText, 1, kAny,
     set},
    {"pause", "", "", Takes::kNumbers, 0, 0, plain<RigControl::Pause, true>},
    {"resume", "", "", Takes::kNumbers, 0, 0, plain<RigControl::Pause, false>},
    {"seek", "SECONDS", "to this time of a replayed drive", Takes::kNumbers, 1, 1, seek},
    {"status", "", "what is lit, the design, each lamp's place, turn and light, and what is set of the picture",
     Takes::kNumbers, 0, 0, plain<RigControl::Tell>},
    {"quit", "", "", Takes::kNumbers, 0, 0, plain<RigControl::Quit>}};

std::string all_commands() {
  std::string text;
  for (const Verb& verb : kVerbs)
    text += std::string("  ") + verb.name + " " + verb.words + (*verb.meaning != 0 ? "   " : "") + verb.meaning + "\n";
  return text + "Settings of the picture:\n" + desk_settings_text("  ");
}

Result<double> number(const std::string& word) {
  const auto value = finite_number(word);
  if (!value) return Error{"", "expected a number, got \"" + word + "\""};
  return *value;
}

/// One command in words, as on the command line.
Result<RigControl> parse(const std::vector<std::string>& words) {
  if (words.empty()) return Error{"", "no command"};
  const auto verb = std::ranges::find(kVerbs, words.front(), [](const Verb& each) { return std::string(each.name); });
  if (verb == std::end(kVerbs)) {
    std::vector<std::string> names;
    for (const Verb& each : kVerbs) names.emplace_back(each.name);
    return Error{"", unknown_name_reason("command", words.front(), names)};
  }
  Words taken;
  std::size_t count = 0;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (verb->takes == Takes::kText) {
      taken.text += (i == 1 ? "" : " ") + words[i];
      taken.all.push_back(words[i]);
      ++count;
    } else if (verb->takes == Takes::kLampAndNumbers && i == 1) {
      taken.lamp = words[i];
    } else {
      const auto value = number(words[i]);
      if (!value) return Error{verb->name, value.error().reason};
      taken.numbers.push_back(*value);
      ++count;
    }
  }
  const bool lamp_missing = verb->takes == Takes::kLampAndNumbers && words.size() < 2;
  if (count < verb->least || count > verb->most || lamp_missing)
    return Error{verb->name,
                 *verb->words != 0 ? std::string("expected ") + verb->name + " " + verb->words : "takes nothing more"};
  auto made = verb->make(taken);
  if (!made) return Error{verb->name, made.error().reason};
  return made;
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

/// The words of a line, parted by blanks; in double quotes they may hold some. Error: a quote that does not end.
Result<std::vector<std::string>> words_of_line(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream in(line);
  while (in >> std::ws && !in.eof()) {
    std::string word;
    if (!(in >> std::quoted(word))) return Error{"", "a double quote does not end"};
    words.push_back(std::move(word));
  }
  return words;
}

/// Commands, one a line: a control unit that dims segments as it drives. One line out for every one in; what is refused
/// does not end the stream, and the exit code tells of it.
int command_stream(ControlClient& client) {
  LineReader lines;
  std::size_t line_number = 0, commands = 0, refused = 0;
  const auto take = [&](const std::string& line) {
    ++line_number;
    const auto words = words_of_line(line);
    if (words && (words->empty() || words->front().starts_with('#'))) return;
    ++commands;
    const auto command = words ? parse(*words) : Result<RigControl>(words.error());
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
  if (options.open_bus) rig->run_key = false;
  if (const Status key = take_run_key(*rig); !key) return bad_input(key.error());
  auto bus = Bus::open_to_send(*rig, Role::kControl);
  if (!bus) return bad_input(bus.error());
  ControlClient client(std::move(*bus), *rig,
                       std::chrono::nanoseconds(static_cast<std::int64_t>(options.wait_s * 1e9)));
  return stream ? command_stream(client) : one_command(*command, client);
}

}  // namespace

void add_control(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ControlOptions>();
  CLI::App* command = app.add_subcommand("control",
                                         "Command a running rig, and hear what it says: dim, swivel, move and aim "
                                         "lamps, swap designs, set the picture, pause");
  command->footer(
      "Commands:\n" + all_commands() +
      "The answer is what holds now. Exit code 2: the rig refuses, and says why; 1: nobody answers.\n"
      "With -, one command a line comes from standard input and one answer a line goes out, \"ok: ...\" or "
      "\"refused: ...\";\nwhat is refused does not end the stream, and makes its exit code 2.\n"
      "Examples, while phare drive runs:\n  phare control status\n  phare control dim \"headlamp left\" 1 0.5\n"
      "  phare control move headlamp up by 0.05\n  phare control set camera chase\n"
      "  phare control - < commands.txt");
  command->add_option("--rig", options->rig_file, "Rig file: address, ports, channels and key")->capture_default_str();
  command->add_option("--port-base", options->port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(kLowestPortBase, kHighestPortBase));
  command->add_flag("--open-bus", options->open_bus, "Of a rig that runs with --open-bus: no key");
  command->add_option("--wait", options->wait_s, "Seconds to wait for an answer")
      ->check(number_within(0.01, 3600.0))
      ->capture_default_str();
  command->add_option("command", options->words, "A command and what it needs; - reads one a line from standard input")
      ->required();
  command->callback([options, &chosen] { chosen = [options] { return control(*options); }; });
}

}  // namespace phare
