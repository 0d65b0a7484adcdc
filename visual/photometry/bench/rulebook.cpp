#include "visual/photometry/bench/rulebook.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "config/formats/toml_table.h"

namespace phare {
namespace {

std::vector<HV> points(TomlTable& table, std::string_view key, std::size_t least, std::size_t most) {
  const std::vector<double> numbers = table.numbers(key, 0);
  std::vector<HV> result;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    if (std::abs(numbers[i]) > 180.0 || std::abs(numbers[i + 1]) > 90.0)
      table.fail(key, "an angle is outside the sphere");
    result.push_back({numbers[i], numbers[i + 1]});
  }
  if (numbers.size() % 2 != 0 || result.size() < least || result.size() > most)
    table.fail(key, "expected pairs of H and V in degrees");
  return result;
}

RuleRow read_row(TomlTable table, const std::string& rule_clause, const std::string& rule_unconfirmed) {
  RuleRow row;
  row.id = table.text("id");
  row.clause = table.text_or("clause", rule_clause);
  struct Kind {
    const char* key;
    RowShape shape;
    std::size_t least, most;
  };
  constexpr std::array<Kind, 5> kKinds{{{"at_deg", RowShape::kPoints, 1, 100},
                                        {"line_deg", RowShape::kLine, 2, 100},
                                        {"area_deg", RowShape::kArea, 2, 2},
                                        {"polygon_deg", RowShape::kPolygon, 3, 100},
                                        {"sum_deg", RowShape::kSum, 2, 100}}};
  std::size_t shapes = 0;
  for (const Kind& kind : kKinds) {
    if (!table.has(kind.key)) continue;
    row.shape = kind.shape;
    row.at = points(table, kind.key, kind.least, kind.most);
    ++shapes;
  }
  if (table.flag_or("peak", false)) {
    row.shape = RowShape::kPeak;
    ++shapes;
  }
  if (shapes != 1) table.fail("id", "a row has one of at_deg, line_deg, area_deg, polygon_deg, sum_deg, peak");
  row.min_cd = table.number_or("min_cd", kNoMinimum, 0.0, 1e9);
  row.max_cd = table.number_or("max_cd", kNoMaximum, 0.0, kNoMaximum);
  row.min_of_peak_01 = table.number_or("min_of_peak_01", 0.0, 0.0, 1.0);
  row.max_factor = table.number_or("max_factor", 0.0, 0.0, 100.0);
  row.max_of = table.text_or("max_of", "");
  row.max_led_module_cd = table.number_or("max_led_module_cd", 0.0, 0.0, 1e9);
  constexpr std::array<std::string_view, 4> kSides{"", "left", "right", "down"};
  row.open = static_cast<OpenSide>(table.choice_or("open", 0, kSides));
  row.unconfirmed = table.text_or("unconfirmed", rule_unconfirmed);
  if (row.min_cd == kNoMinimum && row.max_cd == kNoMaximum && row.min_of_peak_01 == 0.0 && row.max_factor == 0.0)
    table.fail("id", "a row needs a limit");
  return row;
}

CutoffAim read_aim(TomlTable table, const std::string& rule_clause) {
  CutoffAim aim;
  aim.clause = table.text_or("clause", rule_clause);
  aim.unconfirmed = table.text_or("unconfirmed", "");
  aim.name = table.text("name");
  aim.scan_h_deg = table.number("scan_h_deg", -20.0, 20.0);
  aim.line_v_deg = table.number("line_v_deg", -10.0, 10.0);
  aim.sharpness_min = table.number_or("sharpness_min", 0.0, 0.0, 10.0);
  aim.sharpness_max = table.number_or("sharpness_max", kNoMaximum, 0.0, kNoMaximum);
  if (table.has("linearity_h_deg")) {
    aim.linearity_h_deg = table.numbers("linearity_h_deg", 0);
    aim.linearity_max_deg = table.number("linearity_max_deg", 0.0, 10.0);
  }
  return aim;
}

std::string plain(std::string_view name) {
  std::string result;
  for (char c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    result += c == ' ' || c == '_' || c == '/' ? '-' : c;
  }
  return result;
}

}  // namespace

const RuleRow* Rulebook::row(const std::string& row_id) const {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const RuleRow& r) { return r.id == row_id; });
  return found == rows.end() ? nullptr : &*found;
}

const CutoffAim* Rulebook::aim(const std::string& aim_name) const {
  const auto found = std::find_if(cutoff_aims.begin(), cutoff_aims.end(),
                                  [&](const CutoffAim& a) { return plain(a.name) == plain(aim_name); });
  return found == cutoff_aims.end() ? nullptr : &*found;
}

bool Rulebook::has_led_module_limits() const {
  return std::any_of(rows.begin(), rows.end(), [](const RuleRow& r) { return r.max_led_module_cd > 0.0; });
}

Rulebook Rulebook::for_led_modules() const {
  Rulebook result = *this;
  for (RuleRow& row : result.rows) {
    if (row.max_led_module_cd > 0.0) row.max_cd = row.max_led_module_cd;
  }
  return result;
}

Result<Rulebook> read_rulebook(const std::filesystem::path& file) {
  auto read = TomlTable::read(file);
  if (!read) return read.error();
  TomlTable& table = *read;
  Rulebook rule;
  rule.id = file.stem().string();
  rule.aliases = table.texts_or_empty("aliases");
  rule.name = table.text("name");
  rule.document = table.text("document");
  rule.clause = table.text("clause");
  rule.sources = table.texts_or_empty("sources");
  if (rule.sources.empty()) table.fail("sources", "a rulebook names where its numbers were read");
  rule.function = table.text("function");
  rule.market = table.text_or("market", "");
  rule.half_sum = table.flag_or("half_sum", false);
  rule.flux_min_lm = table.number_or("flux_min_lm", 0.0, 0.0, 1e6);
  rule.flux_or = table.text_or("flux_or", "");
  const std::string unconfirmed = table.text_or("unconfirmed", "");
  for (TomlTable& aim : table.tables("aim")) rule.cutoff_aims.push_back(read_aim(aim, rule.clause));
  if (auto reaim = table.table_if("reaim")) {
    rule.reaim_left_deg = reaim->number_or("left_deg", 0.0, 0.0, 5.0);
    rule.reaim_right_deg = reaim->number_or("right_deg", 0.0, 0.0, 5.0);
    rule.reaim_up_deg = reaim->number_or("up_deg", 0.0, 0.0, 5.0);
    rule.reaim_down_deg = reaim->number_or("down_deg", 0.0, 0.0, 5.0);
    rule.point_reaim_deg = reaim->number_or("each_point_deg", 0.0, 0.0, 5.0);
  }
  for (TomlTable& row : table.tables("row")) rule.rows.push_back(read_row(row, rule.clause, unconfirmed));
  if (rule.rows.empty()) table.fail("name", "a rulebook needs at least one [[row]]");
  for (const RuleRow& row : rule.rows) {
    if (row.max_factor > 0.0 && (rule.row(row.max_of) == nullptr))
      table.fail("name", "row " + row.id + ": max_of names no row");
  }
  if (const Status status = table.finish(); !status) return status.error();
  return rule;
}

Result<std::vector<Rulebook>> read_rulebooks(const std::filesystem::path& folder) {
  std::error_code code;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  if (code) return Error{folder.string(), "cannot be read: " + code.message()};
  std::sort(files.begin(), files.end());
  std::vector<Rulebook> rules;
  for (const auto& file : files) {
    auto rule = read_rulebook(file);
    if (!rule) return rule.error();
    rules.push_back(std::move(*rule));
  }
  return rules;
}

Result<Rulebook> find_rulebook(const std::filesystem::path& folder, const std::string& name) {
  std::error_code code;
  if (name.ends_with(".toml") && std::filesystem::is_regular_file(name, code)) return read_rulebook(name);
  auto rules = read_rulebooks(folder);
  if (!rules) return rules.error();
  const std::string wanted = plain(name);
  std::vector<std::string> known;
  for (const Rulebook& rule : *rules) {
    if (rule.id == wanted) return rule;
    known.push_back(rule.id);
    for (const std::string& alias : rule.aliases) {
      if (plain(alias) == wanted) return rule;
    }
  }
  return Error{"--rule", unknown_name_reason("rulebook", name, known)};
}

std::vector<std::string> names_of_rows(std::span<const Rulebook> rules) {
  std::vector<std::string> names;
  for (const Rulebook& rule : rules) {
    for (const RuleRow& row : rule.rows) {
      names.push_back(row.id);
      if (row.shape != RowShape::kSum) continue;
      for (std::size_t begin = 0; begin <= row.id.size();) {
        const std::size_t end = std::min(row.id.find('+', begin), row.id.size());
        names.push_back(row.id.substr(begin, end - begin));
        begin = end + 1;
      }
    }
  }
  for (const char* peak : {"Imax", "Emax", "max", "maximum", "peak"}) names.emplace_back(peak);
  return names;
}

}  // namespace phare
