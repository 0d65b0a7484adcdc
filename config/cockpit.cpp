#include "config/cockpit.h"

#include <algorithm>

#include "config/base/paths.h"
#include "config/cockpit_control.h"
#include "config/formats/toml_table.h"
#include "config/rig.h"

namespace phare {

namespace {

constexpr std::size_t kE2eProfile2Ids = 16;
constexpr std::size_t kMostSources = 8;

std::filesystem::path named_file(TomlTable& table, std::string_view key) {
  const std::string named = table.text_or(key, "");
  return named.empty() ? std::filesystem::path{} : resolve_path(named, table.file());
}

bool is_e2e(CrcKind kind) {
  return kind == CrcKind::kE2eProfile1 || kind == CrcKind::kE2eProfile2;
}

std::vector<std::int64_t> data_ids(TomlTable& table, CrcKind kind) {
  if (kind == CrcKind::kE2eProfile2) {
    std::vector<std::int64_t> ids;
    for (const double id : table.numbers("data_ids", kE2eProfile2Ids)) {
      if (!(id >= 0 && id <= 255)) table.fail("data_ids", "expected sixteen bytes, one for each counter value");
      ids.push_back(static_cast<std::int64_t>(std::clamp(id, 0.0, 255.0)));
    }
    return ids;
  }
  if (kind == CrcKind::kPolynomial && table.has("data_ids")) {
    std::vector<std::int64_t> ids;
    for (const auto& value : table.values_or_empty("data_ids")) {
      const double* id = std::get_if<double>(&value);
      const bool byte = id != nullptr && *id >= 0.0 && *id <= 255.0;
      if (!byte) table.fail("data_ids", "expected bytes, one for each value of the counter in turn");
      ids.push_back(byte ? static_cast<std::int64_t>(*id) : 0);
    }
    return ids;
  }
  if (kind == CrcKind::kE2eProfile1) return {table.integer("data_id", 0, 0xFFFF)};
  if (table.has("data_id")) return {table.integer("data_id", 0, 0xFF)};
  return {};
}

CrcPolynomial read_polynomial(TomlTable& table) {
  CrcPolynomial p;
  p.width = static_cast<int>(table.integer("width", 3, 32));
  const std::int64_t most = (std::int64_t{1} << p.width) - 1;
  p.poly = static_cast<std::uint32_t>(table.integer("poly", 1, most));
  p.init = static_cast<std::uint32_t>(table.integer_or("init", 0, 0, most));
  p.xor_out = static_cast<std::uint32_t>(table.integer_or("xor_out", 0, 0, most));
  p.reflect = table.flag_or("reflect", false);
  constexpr double kAll[]{0.0, 63.0};
  const auto range = table.numbers_or("bytes", kAll);
  p.first_byte = static_cast<int>(std::clamp(range[0], 0.0, 63.0));
  p.last_byte = static_cast<int>(std::clamp(range[1], 0.0, 63.0));
  if (p.first_byte > p.last_byte) table.fail("bytes", "expected [first, last], counted from 0");
  p.data_id_first = table.flag_or("data_id_first", false);
  return p;
}

MessageCheck read_check(const std::string& message, TomlTable table) {
  MessageCheck check;
  check.message = message;
  check.place = check.message_place = table.place();
  check.counter = table.text_or("counter", "");
  check.counter_place = table.place("counter");
  if (!check.counter.empty()) {
    check.counter_step = table.integer_or("counter_step", 1, 1, 255);
    check.counter_most_lost = table.integer_or("counter_most_lost", 5, 0, 1000);
    if (table.has("counter_values")) check.counter_values = table.integer("counter_values", 2, 1 << 30);
  }
  check.crc = table.text_or("crc", "");
  check.crc_place = table.place("crc");
  if (!check.crc.empty()) {
    check.crc_kind = static_cast<CrcKind>(table.choice("crc_kind", kCrcNames));
    if (check.crc_kind == CrcKind::kNone) table.fail("crc_kind", "a crc needs its kind");
    if (check.crc_kind == CrcKind::kPolynomial) check.polynomial = read_polynomial(table);
    check.data_ids = data_ids(table, check.crc_kind);
    if (check.data_ids.size() > 1 && check.counter.empty()) table.fail("data_ids", "several need a counter");
    if (check.crc_kind == CrcKind::kE2eProfile1)
      check.data_id_mode = static_cast<DataIdMode>(table.choice_or("data_id_mode", 0, kDataIdModeNames));
    if (is_e2e(check.crc_kind) && check.counter.empty()) table.fail("crc_kind", "this profile needs a counter");
    // AUTOSAR: the counter of profile 1 goes from 0 to 14.
    if (check.crc_kind == CrcKind::kE2eProfile1 && !check.counter_values) check.counter_values = 15;
  }
  if (check.counter.empty() && check.crc.empty()) table.fail({}, "expected a counter, a crc or both");
  return check;
}

SendMessage read_send(TomlTable table) {
  SendMessage send;
  send.place = table.place("message");
  send.message = table.text("message");
  send.period_s = table.number_or("period_s", 0.1, 0.005, 60.0);
  TomlTable signals = table.table("signals");
  for (const std::string& signal : signals.keys()) {
    send.signals.push_back(
        {signal, static_cast<SendValue>(signals.choice(signal, kSendValueNames)), signals.place(signal)});
  }
  if (send.signals.empty() && table.has("signals")) table.fail("signals", "expected at least one signal");
  return send;
}

void read_automatic(TomlTable table, CockpitConfig& config) {
  config.automatic_high = table.flag_or("enabled", true);
  config.automatic_above_mps = table.number_or("above_kmh", 40.0, 0.0, 300.0) / 3.6;
  config.automatic_below_mps = table.number_or("below_kmh", 25.0, 0.0, 300.0) / 3.6;
  config.automatic_delay_s = table.number_or("delay_s", config.automatic_delay_s, 0.0, 60.0);
  if (config.automatic_below_mps > config.automatic_above_mps)
    table.fail("below_kmh", "must not be above above_kmh, or the beam would flicker");
}

void read_source(TomlTable source, CockpitConfig& config) {
  config.source = static_cast<SourceKind>(source.choice("kind", kSourceKindNames));
  const bool is_can = config.source == SourceKind::kCan;
  const bool is_log = config.source == SourceKind::kLog;
  if (is_can) config.interface = source.text("interface");
  if (is_log) config.interface = source.text_or("interface", "");
  if (is_can && config.interface.size() > 15) source.fail("interface", "an interface's name has at most 15 letters");
  if (is_can || is_log) config.dbc_file = named_file(source, "dbc");
  if (is_log || config.source == SourceKind::kDrive || config.source == SourceKind::kDriver)
    config.input_file = named_file(source, "file");
  if (is_log) config.log_speed = source.number_or("speed", 1.0, 0.01, 1000.0);
  if (config.source == SourceKind::kGamepad) config.device = source.text_or("device", "");
  config.timeout_s = source.number_or("timeout_s", config.timeout_s, 0.001, kMostTimeout_s);
  config.debounce_s = source.number_or("debounce_s", config.debounce_s, 0.0, 1.0);
  config.default_light = static_cast<int>(source.choice_or("lights", 0, kLightSwitchNames));
  for (const std::string& file : source.texts_or_empty("also")) {
    std::filesystem::path beside = resolve_path(file, source.file());
    // One's own file lies anywhere; what stands beside its stalk is mostly one of ours.
    const std::filesystem::path shipped = config_dir() / "cockpits" / file;
    if (!std::filesystem::exists(beside) && std::filesystem::exists(shipped)) beside = shipped;
    config.also.push_back(std::move(beside));
  }
  if (config.also.size() >= kMostSources) source.fail("also", "at most 7 further sources");
}

Result<CockpitConfig> read_cockpit_table(TomlTable root) {
  CockpitConfig config;
  config.file = root.file();
  read_source(root.table("source"), config);
  const bool is_gamepad = config.source == SourceKind::kGamepad;
  if (auto automatic = root.table_if("automatic_high_beam")) read_automatic(*automatic, config);
  if (auto controls = root.table_if("control")) {
    for (std::size_t i = 0; i < kControlNames.size(); ++i) {
      if (auto table = controls->table_if(kControlNames[i])) {
        config.controls.push_back(read_control(static_cast<Control>(i), *table, config.timeout_s, is_gamepad));
      }
    }
    check_conflicts(*controls, config);
  } else if (config.source == SourceKind::kCan || is_gamepad) {
    root.fail("source", "this source needs at least one [control.…] table");
  }
  if (auto checks = root.table_if("check")) {
    for (const std::string& message : checks->keys()) {
      config.checks.push_back(read_check(message, checks->table(message)));
    }
  }
  for (const TomlTable& send : root.tables("send")) config.sends.push_back(read_send(send));
  if (const Status status = root.finish(); !status) return status.error();
  return config;
}

}  // namespace

const ControlMapping* CockpitConfig::find(Control control) const {
  const auto found =
      std::find_if(controls.begin(), controls.end(), [&](const ControlMapping& m) { return m.control == control; });
  return found == controls.end() ? nullptr : &*found;
}

Result<CockpitConfig> read_cockpit(const std::filesystem::path& file) {
  Result<TomlTable> root = TomlTable::read(file);
  if (!root) return root.error();
  return read_cockpit_table(*root);
}

Result<CockpitConfig> parse_cockpit(std::string_view text, const std::string& name) {
  Result<TomlTable> root = TomlTable::parse(text, name);
  if (!root) return root.error();
  return read_cockpit_table(*root);
}

}  // namespace phare
