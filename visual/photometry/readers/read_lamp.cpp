#include "visual/photometry/readers/read_lamp.h"

#include <algorithm>
#include <cassert>
#include <future>

#include "config/base/content_hash.h"
#include "config/base/input_files.h"
#include "visual/photometry/readers/file_text.h"

namespace phare {
namespace {

bool has_tilt_line(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (upper_case(trimmed(text.substr(at, std::min<std::size_t>(end - at, 64)))).starts_with("TILT")) return true;
    at = end + 1;
  }
  return false;
}

/// A file of another format has one set of values: asked for another, there is none.
Status has_what_is_asked(LampFormat format, const std::string& name, const LampReadSettings& settings) {
  if (format == LampFormat::kFind) return Done{};  // no file of any kind: that is told
  if (settings.lamp_set > 1 && format != LampFormat::kEulumdat)
    return Error{name, "has no lamp set " + std::to_string(settings.lamp_set) + ": only EULUMDAT files have several"};
  if (settings.emitter > 1 && format != LampFormat::kTm33)
    return Error{name, "has no emitter " + std::to_string(settings.emitter) + ": only TM-33 files have several"};
  return Done{};
}

/// Settings that change nothing in a table like this are told, so that nobody takes them for used.
void note_unused(IntensityTable& table, LampFormat format, const std::string& name, const LampReadSettings& settings) {
  const bool turned = settings.axis != GammaAxis::kGamma0 || settings.c0_turn_deg != 0.0;
  if (turned && table.type != PhotometricType::kC)
    table.notes.push_back(name + ": axis and C 0 are of type C and EULUMDAT; not used here");
  if (settings.distance_m > 0.0 && format != LampFormat::kCsv)
    table.notes.push_back(name + ": the distance is for CSV in lux; not used here");
}

}  // namespace

LampFormat find_format(std::string_view bytes, std::string_view name) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::string start = upper_case(trimmed(bytes.substr(0, 64)));
  std::string_view head = start;
  while (!head.empty() && head.front() == '\n') head.remove_prefix(1);
  if (head.starts_with('<')) return LampFormat::kTm33;
  if (head.starts_with("IESNA") || head.starts_with("IES:")) return LampFormat::kLm63;
  const std::string ending = upper_case(name.substr(std::min(name.rfind('.'), name.size())));
  if (ending == ".LDT" || ending == ".EUL") return LampFormat::kEulumdat;
  if (ending == ".IES") return LampFormat::kLm63;
  if (ending == ".XML" || ending == ".IESXML") return LampFormat::kTm33;
  if (ending == ".CSV" || head.starts_with('#')) return LampFormat::kCsv;
  if (has_tilt_line(bytes)) return LampFormat::kLm63;
  return LampFormat::kFind;
}

Result<IntensityTable> LampFile::read(LampFormat format, std::string_view text, const LampReadSettings& settings) {
  switch (format) {
    case LampFormat::kLm63:
      return parse_lm63(text, name_, settings);
    case LampFormat::kEulumdat:
      return parse_eulumdat(text, name_, settings);
    case LampFormat::kTm33:
      return parse_tm33(text, name_, settings, tree_);
    case LampFormat::kCsv:
      return parse_lamp_csv(text, name_, settings);
    case LampFormat::kFind:
      break;
  }
  return Error{name_, "looks like none of LM-63 (.ies), EULUMDAT (.ldt), TM-33 (.xml) and CSV; --format says which"};
}

Result<IntensityTable> LampFile::table(LampReadSettings settings) {
  if (read_) settings.folder = path_.parent_path();
  if (bytes_.empty()) return Error{name_, "is empty"};
  const LampFormat format = settings.format == LampFormat::kFind ? find_format(bytes_, name_) : settings.format;
  if (const Status has = has_what_is_asked(format, name_, settings); !has) return has.error();
  std::string storage, note;
  const std::string_view text = without_marks(bytes_, name_, storage, note);
  // Hashing a large file takes as long as reading its numbers; it goes beside it. (The default policy falls back to
  // hashing in get() when no thread can be had.)
  constexpr std::size_t kWorthAThread = 1u << 20;
  const auto hash_bytes = [this] { return content_hash(std::as_bytes(std::span(bytes_.data(), bytes_.size()))); };
  std::future<std::string> hash;
  if (hash_.empty() && bytes_.size() > kWorthAThread)
    hash = std::async(std::launch::async | std::launch::deferred, hash_bytes);
  auto table = read(format, text, settings);
  if (!table) return table.error();
  if (hash_.empty()) hash_ = hash.valid() ? hash.get() : hash_bytes();
  table->content_hash = hash_;
  if (table->type == PhotometricType::kC) table->header.read_c0_deg = settings.c0_turn_deg;
  table->header.read_mirrored = settings.mirror_h;
  note_unused(*table, format, name_, settings);
  if (!note.empty()) table->notes.insert(table->notes.begin(), note);
  if (settings.mirror_h) {
    mirror_left_right(*table);
    table->notes.push_back(name_ + ": left and right turned round, as asked");
  }
  if (read_) table->name = is_standard_input(path_) ? name_ : path_.filename().string();
  return table;
}

Result<LampFile> LampFile::open(const std::filesystem::path& file) {
  const std::string name = input_name(file);
  auto bytes = read_photometry_bytes(file, name);
  if (!bytes) return bytes.error();
  auto kept = std::make_shared<const std::string>(std::move(*bytes));
  LampFile opened(*kept, name);
  opened.read_ = std::move(kept);
  opened.path_ = file;
  return opened;
}

Result<IntensityTable> parse_lamp(std::string_view bytes, const std::string& name, const LampReadSettings& settings) {
  return LampFile(bytes, name).table(settings);
}

Result<IntensityTable> read_lamp(const std::filesystem::path& file, const LampReadSettings& settings) {
  auto opened = LampFile::open(file);
  if (!opened) return opened.error();
  return opened->table(settings);
}

Result<IntensityTable> read_lm63(const std::filesystem::path& file, GammaAxis axis) {
  LampReadSettings settings;
  settings.format = LampFormat::kLm63;
  settings.axis = axis;
  return read_lamp(file, settings);
}

void mirror_left_right(IntensityTable& table) {
  const std::size_t columns = table.first_deg.size();
  if (columns == 0) return;
  if (table.type != PhotometricType::kC) {
    std::reverse(table.first_deg.begin(), table.first_deg.end());
    for (double& angle : table.first_deg) angle = -angle + 0.0;  // no -0
    for (std::size_t j = 0; j < table.second_deg.size(); ++j) {
      const auto row = table.candela.begin() + static_cast<std::ptrdiff_t>(j * columns);
      std::reverse(row, row + static_cast<std::ptrdiff_t>(columns));
    }
    return;
  }
  // gamma0: C 0 right, so right and left are C and 180 - C; gamma90: C 0 ahead, so they are C and 360 - C.
  const bool about_180 = table.axis == GammaAxis::kGamma0;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < columns; ++i) {
    const double c = table.first_deg[i];
    if (!about_180) {
      order.emplace_back(360.0 - c, i);
    } else if (i + 1 < columns) {  // 0 and 360 are one plane
      order.emplace_back(c <= 180.0 ? 180.0 - c : 540.0 - c, i);
    }
  }
  std::sort(order.begin(), order.end());
  IntensityTable old = std::move(table);
  table = old;
  table.first_deg.clear();
  std::vector<std::size_t> from;
  const auto add = [&](double c, std::size_t i) {
    table.first_deg.push_back(c);
    from.push_back(i);
  };
  for (const auto& [c, i] : order) add(c, i);
  const bool seam = table.first_deg.front() == 0.0;
  if (about_180 && seam) add(360.0, from.front());
  table.candela.assign(table.first_deg.size() * old.second_deg.size(), 0.0);
  for (std::size_t j = 0; j < old.second_deg.size(); ++j) {
    for (std::size_t i = 0; i < from.size(); ++i)
      table.candela[j * from.size() + i] = old.candela[j * columns + from[i]];
  }
  if (about_180 && !seam) {  // no plane at C 180: the seam of the mirror image falls between two
    IntensityTable whole = table;
    whole.first_deg.insert(whole.first_deg.begin(), 0.0);
    whole.first_deg.push_back(360.0);
    whole.candela.clear();
    for (std::size_t j = 0; j < old.second_deg.size(); ++j) {
      const double at_seam = old.intensity_at_cd({180.0, old.second_deg[j]});
      const auto row = table.candela.begin() + static_cast<std::ptrdiff_t>(j * from.size());
      whole.candela.push_back(at_seam);
      whole.candela.insert(whole.candela.end(), row, row + static_cast<std::ptrdiff_t>(from.size()));
      whole.candela.push_back(at_seam);
    }
    table = std::move(whole);
  }
}

}  // namespace phare
