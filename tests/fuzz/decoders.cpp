#include "tests/fuzz/decoders.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "cockpit_io/candump.h"
#include "cockpit_io/cockpit.h"
#include "cockpit_io/dbc.h"
#include "cockpit_io/signal_map.h"
#include "config/cockpit.h"
#include "net/wire.h"
#include "tests/net/sample.h"
#include "tests/paths.h"

namespace phare::test {
namespace {

void must(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: does not hold: %s\n", what);
  std::abort();
}

std::string whole_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The words of a reason without what it quotes and its numbers: inputs that fail alike have one.
std::string kind_of(const std::string& reason) {
  std::string kind;
  bool quoted = false;
  for (const char c : reason.substr(0, 200)) {
    if (c == '"') quoted = !quoted;
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0 || c == ' ';
    if (!quoted && letter && !(c == ' ' && kind.ends_with(' '))) kind += c;
  }
  return kind.substr(0, 24);
}

std::string once_each(std::string letters) {
  std::ranges::sort(letters);
  letters.erase(std::unique(letters.begin(), letters.end()), letters.end());
  return letters;
}

/// 0, 1, 2, 4, 8, …: how many, roughly.
std::string about(std::size_t count) {
  std::size_t power = count == 0 ? 0 : 1;
  while (power != 0 && 2 * power <= count) power *= 2;
  return std::to_string(power);
}

std::string decode_datagram(const std::string& bytes) {
  Datagram datagram;
  const Refusal refusal = decode_into(view(bytes), datagram);
  if (refusal != Refusal::kNone) return refusal_text(refusal);
  must(encode(datagram) == bytes, "a datagram has one encoding");
  must(check(datagram) == Refusal::kNone, "what is decoded is in its ranges");
  return "taken " + std::to_string(datagram.payload.index());
}

/// The decoder behind the checksum: a fitting one is put in, that damage reaches it.
std::string decode_datagram_with_check(const std::string& bytes) {
  if (bytes.size() < 6) return decode_datagram(bytes);
  std::string sealed = bytes.substr(0, bytes.size() - 6);
  std::uint32_t crc = 0xFFFFFFFFu;  // ISO 3309, as zlib.crc32
  for (const char c : sealed) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  crc = ~crc;
  sealed += "\x85\x01";
  for (int shift = 0; shift < 32; shift += 8) sealed += static_cast<char>(crc >> shift);
  return decode_datagram(sealed);
}

std::string decode_candump(const std::string& text) {
  const auto log = parse_candump(text, "f.log");
  if (!log) return kind_of(log.error().reason);
  std::string kinds;
  for (const CandumpEntry& entry : log->entries) {
    must(entry.frame.length <= CanFrame::kMaxLength, "a frame has at most 64 bytes");
    kinds += entry.frame.remote ? 'r' : entry.frame.error ? 'e' : entry.frame.extended ? 'x' : 'd';
  }
  return "taken " + once_each(kinds) + (log->broken_lines > 0 ? " and broken" : "");
}

std::string decode_dbc(const std::string& text) {
  const auto dbc = parse_dbc(text, "f.dbc");
  if (!dbc) return kind_of(dbc.error().reason);
  CanFrame frame;
  frame.length = CanFrame::kMaxLength;
  for (std::size_t i = 0; i < frame.data.size(); ++i) frame.data[i] = static_cast<std::uint8_t>(37 * i + text.size());
  for (const DbcMessage& message : dbc->messages) {
    for (const DbcSignal& signal : message.signals) {
      must(signal.multiplexor.empty() || message.find(signal.multiplexor) != nullptr,
           "a multiplexor is in its message");
      CanFrame made = empty_frame(message);
      encode(message, signal, decode(message, signal, frame).value_or(1.0), made);
      raw_value(signal, frame.bytes());
    }
  }
  return "taken " + about(dbc->signal_count()) + ", problem " +
         (dbc->problems.empty() ? "none" : kind_of(dbc->problems.front().reason));
}

std::string decode_cockpit(const std::string& text) {
  static const Dbc dbc = *read_dbc(cockpits_dir() + "/phare_stalk.dbc");
  const auto config = parse_cockpit(text, "f.toml");
  if (!config) return kind_of(config.error().reason);
  const auto map = SignalMap::bind(*config, dbc, 0);
  return map ? "taken " + about(config->controls.size()) : "bound: " + kind_of(map.error().reason);
}

/// Frames of 8 + 1 + 1 bytes: data, id, length and kind. Through the map, the checks and the switches.
std::string decode_frames(const std::string& bytes) {
  static const CockpitConfig config = *read_cockpit(cockpits_dir() + "/phare_stalk.toml");
  static const SignalMap fresh = *SignalMap::bind(config, *read_dbc(config.dbc_file), 0);
  SignalMap map = fresh;
  Cockpit cockpit({20'000'000, 2}, "fuzz");
  DriverInput input;
  std::string kinds;
  for (std::size_t at = 0; at + 10 <= bytes.size(); at += 10) {
    CanFrame frame;
    for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(bytes[at + i]);
    frame.id = 0x4FEu + (static_cast<std::uint8_t>(bytes[at + 8]) & 7u);
    frame.length = static_cast<std::uint8_t>(bytes[at + 9] & 15);
    frame.remote = (bytes[at + 9] & 16) != 0;
    frame.error = (bytes[at + 9] & 32) != 0;
    const auto ns = static_cast<std::int64_t>(at) * 3'000'000;
    kinds += static_cast<char>('a' + static_cast<int>(map.take(frame, ns, input)));
    cockpit.take(input, ns >= map.silent_at_ns(), {SimTime{ns}, WallTime{ns}});
  }
  const CockpitState state = cockpit.state(-1, false);
  must(state.accelerator_01 >= 0.0 && state.accelerator_01 <= 1.0 && state.brake_01 >= 0.0 && state.brake_01 <= 1.0,
       "pedals lie from 0 to 1");
  Datagram datagram{Sender::kCockpit, 0, 1, 1, SimTime{}, WallTime{}, state};
  must(check(datagram) == Refusal::kNone, "the cockpit says what receivers take");
  return "taken " + once_each(kinds) + " light " + std::to_string(static_cast<int>(state.light_switch)) +
         (state.flash ? " flash" : "") + (state.fail_safe ? " safe" : "") + " turn " +
         std::to_string(static_cast<int>(state.turn));
}

std::vector<std::string> datagram_seeds() {
  std::vector<std::string> all;
  for (const Datagram& datagram : samples(1)) all.push_back(encode(datagram));
  return all;
}

}  // namespace

std::vector<FuzzedDecoder> fuzzed_decoders() {
  const std::string multiplexed =
      "BO_ 1280 M: 8 X\n SG_ W M : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ I m3M : 4|4@1- (1,0) [0|0] \"\" X\n"
      " SG_ D m1 : 15|8@0+ (0.5,1) [0|0] \"\" X\n SG_ F m2 : 16|32@1- (1,0) [0|0] \"\" X\n"
      "SG_MUL_VAL_ 1280 I W 3-5;\nSG_MUL_VAL_ 1280 D I 1-1, 9-9;\nSIG_VALTYPE_ 1280 F : 1;\n"
      "VAL_TABLE_ T 0 \"a\" 1 \"b\";\nVAL_ 1280 W T;\nCM_ SG_ 1280 W \"x\ny\";\n";
  const std::string log =
      "(46408.584930) can0 260#08FFFB0000001884\n(1700000000.123456) vcan0 12345678##3112233\n(1.0) c 123#R4\n"
      "(2.5) c 20000040#0000000000000000 R\n";
  std::string frames;
  for (const char* data : {"\x02\x01\0\0\0\0\0\0\x02\x08", "\x07\x01\0\0\0\0\0\0\x02\x08", "\0\0\0\0\0\0\0\0\x03\x08"})
    frames += std::string(data, 10);
  return {{"datagram", datagram_seeds(), decode_datagram_with_check},
          {"candump", {log}, decode_candump},
          {"dbc", {multiplexed}, decode_dbc},
          {"cockpit", {whole_file(cockpits_dir() + "/phare_stalk.toml")}, decode_cockpit},
          {"frames", {frames}, decode_frames}};
}

std::string damaged_input(const std::string& good, const std::string& other, std::mt19937_64& random) {
  static constexpr std::string_view kLetters = "0123456789-+.|@()[]{}\":;#=,\\ \nmM_";
  std::string text = good;
  const std::size_t most = good.size() + 100;
  for (auto edits = random() % 3 == 0 ? random() % 6 + 1 : 1; edits > 0; --edits) {
    if (text.empty()) text = " ";
    const std::size_t at = random() % text.size();
    switch (random() % 8) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
        break;
      case 2:
        text.erase(at, random() % 20 + 1);
        break;
      case 3:
        text.insert(at, text.substr(random() % text.size(), random() % 40));
        break;
      case 4:
        text.insert(at, std::to_string(random() >> random() % 64));
        break;
      case 5:
        text[at] = kLetters[random() % kLetters.size()];
        break;
      case 6:
        text.resize(at);
        break;
      default:
        if (!other.empty()) text.replace(at, random() % 40, other.substr(random() % other.size(), random() % 80));
        break;
    }
    if (text.size() > most) text.resize(most);
  }
  return text;
}

std::string escaped(const std::string& bytes) {
  std::string line;
  char code[8];
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    std::snprintf(code, sizeof code, "\\x%02x", byte);
    line += byte >= 0x20 && byte < 0x7f && c != '\\' ? std::string(1, c) : std::string(code);
  }
  return line;
}

std::string unescaped(const std::string& line) {
  std::string bytes;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\' && i + 3 < line.size()) {
      bytes += static_cast<char>(std::strtoul(line.substr(i + 2, 2).c_str(), nullptr, 16));
      i += 3;
    } else {
      bytes += line[i];
    }
  }
  return bytes;
}

FuzzRun fuzz(const FuzzedDecoder& decoder, const std::vector<std::string>& corpus, std::uint64_t count,
             std::uint64_t seed) {
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::off);  // each first value without a meaning is told
  FuzzRun run;
  std::set<std::string> words;
  std::vector<std::string> pool = decoder.seeds;
  const auto put = [&](const std::string& input) {
    const std::string word = decoder.decode(input);
    ++run.inputs;
    run.taken += word.starts_with("taken") ? 1 : 0;
    return words.insert(word).second;
  };
  for (const std::string& input : pool) put(input);
  for (const std::string& input : corpus) put(input);
  pool.insert(pool.end(), corpus.begin(), corpus.end());
  std::mt19937_64 random(seed);
  constexpr std::size_t kMost = 4000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string input = damaged_input(pool[random() % pool.size()], pool[random() % pool.size()], random);
    if (!put(input) || input.size() > kMost) continue;
    run.fresh.push_back(input);
    pool.push_back(input);
  }
  spdlog::set_level(level);
  return run;
}

std::vector<std::string> kept_corpus(const std::string& name) {
  std::ifstream stream(tests_dir("fuzz") + "/corpus/" + name + ".txt");
  std::vector<std::string> all;
  for (std::string line; std::getline(stream, line);) all.push_back(unescaped(line));
  return all;
}

}  // namespace phare::test
