#include "config/rig_edit.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <utility>

#include "config/base/whole_file.h"
#include "config/desk_cameras.h"
#include "config/formats/toml_table.h"
#include "config/rig.h"
#include "config/rig_writer.h"

namespace phare {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kRounding = 1e-6;  // m, degrees

double rounded(double value) {
  return std::round(value / kRounding) * kRounding;
}
/// Of a number that was rounded: no more digits than that.
std::string short_word(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6f", value);
  std::string word = text;
  word.erase(word.find_last_not_of('0') + 1);
  if (word.ends_with('.')) word += '0';
  return word == "-0.0" ? "0.0" : word;
}

/// Pieces of a text to be replaced, none over another.
class Edits {
 public:
  void replace(std::size_t begin, std::size_t end, std::string text) {
    edits_.push_back({begin, end, std::move(text)});
  }
  std::string applied_to(const std::string& text) const {
    std::vector<Edit> sorted = edits_;
    std::ranges::stable_sort(sorted, {}, &Edit::begin);
    std::string result;
    std::size_t at = 0;
    for (const Edit& edit : sorted) {
      if (edit.begin < at) continue;  // told by what is read again
      result += text.substr(at, edit.begin - at) + edit.text;
      at = edit.end;
    }
    return result + text.substr(at);
  }

 private:
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };
  std::vector<Edit> edits_;
};

/// Byte of a line and a column in code points, both from 1; the end of the text where it has no such place.
std::size_t byte_of(const std::string& text, std::uint32_t line, std::uint32_t column) {
  std::size_t at = 0;
  for (std::uint32_t l = 1; l < line && at < text.size(); ++l) at = std::min(text.find('\n', at), text.size() - 1) + 1;
  for (std::uint32_t c = 1; c < column && at < text.size(); ++c) do
      ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u);
  return at;
}

struct Bytes {
  std::size_t begin = 0, end = 0;
};

Bytes bytes_of(const std::string& text, const TomlTable::Region& region) {
  return {byte_of(text, region.begin_line, region.begin_column), byte_of(text, region.end_line, region.end_column)};
}

bool is_inline(const std::string& text, const TomlTable& table) {
  const Bytes at = bytes_of(text, table.region().value_or(TomlTable::Region{}));
  return at.begin < text.size() && text[at.begin] == '{';
}

/// A key of a table: its value where it stands, else written behind that of `neighbour`, which the table has.
void set_key(const std::string& text, Edits& edits, const TomlTable& table, std::string_view key,
             const std::string& word, std::string_view neighbour) {
  if (const auto there = table.region(key)) {
    const Bytes at = bytes_of(text, *there);
    return edits.replace(at.begin, at.end, word);
  }
  const auto beside = table.region(neighbour);
  if (!beside) return;
  std::size_t at = bytes_of(text, *beside).end;
  const std::string pair = std::string(key) + " = " + word;
  if (is_inline(text, table)) return edits.replace(at, at, ", " + pair);
  at = std::min(text.find('\n', at), text.size());
  edits.replace(at, at, "\n" + pair);
}

/// An angle that is 0 and not there is left out.
void set_angle(const std::string& text, Edits& edits, const TomlTable& table, std::string_view key, double rad) {
  const double deg = rounded(rad * kDegPerRad);
  if (deg != 0.0 || table.region(key)) set_key(text, edits, table, key, short_word(deg), "file");
}

/// Place and turns of one table of a lamp.
Edits lamp_edits(const std::string& text, TomlTable lamp, const SavedMount& mount) {
  Edits edits;
  const glm::dvec3 p = mount.position_m;
  set_key(text, edits, lamp, "position_m",
          "[" + short_word(rounded(p.x)) + ", " + short_word(rounded(p.y)) + ", " + short_word(rounded(p.z)) + "]",
          "name");
  if (lamp.region("aim")) set_key(text, edits, lamp, "aim", "\"as-filed\"", "name");
  std::vector<TomlTable> sources = lamp.tables("source");
  std::size_t i = 0;  // of the mount's sources
  for (TomlTable& source : sources) {
    if (i >= mount.sources.size()) break;
    set_angle(text, edits, source, "yaw_deg", mount.sources[i].yaw_rad);
    set_angle(text, edits, source, "pitch_deg", mount.sources[i].pitch_rad);
    set_angle(text, edits, source, "roll_deg", mount.sources[i].roll_rad);
    i += static_cast<std::size_t>(source.integer_or("emitters", 1, 1, 1000));  // one table, turned as one
  }
  return edits;
}

/// Does the right lamp mirror the left one, as pair = true makes it?
bool mirror(const SavedMount& left, const SavedMount& right) {
  const auto same = [](double a, double b) { return std::abs(a - b) <= 0.5 * kRounding; };
  bool all = same(left.position_m.x, right.position_m.x) && same(left.position_m.y, -right.position_m.y) &&
             same(left.position_m.z, right.position_m.z) && left.position_m.y > 0.0;
  for (std::size_t i = 0; i < left.sources.size() && i < right.sources.size(); ++i) {
    const SavedMount::Turn &l = left.sources[i], &r = right.sources[i];
    all = all && same(l.yaw_rad * kDegPerRad, -r.yaw_rad * kDegPerRad) &&
          same(l.pitch_rad * kDegPerRad, r.pitch_rad * kDegPerRad) &&
          same(l.roll_rad * kDegPerRad, -r.roll_rad * kDegPerRad);
  }
  return all;
}

/// From the table's header to the next one that is not of this lamp, without the comment above that; or {…}.
Bytes block_of(const std::string& text, const TomlTable& lamp) {
  Bytes block = bytes_of(text, lamp.region().value_or(TomlTable::Region{}));
  if (is_inline(text, lamp)) return block;
  std::size_t line = text.find('\n', block.end), kept = text.size();
  for (block.end = text.size(); line != std::string::npos; line = text.find('\n', line + 1)) {
    const std::size_t word = text.find_first_not_of(" \t", line + 1);
    if (word == std::string::npos) break;
    const bool empty = text[word] == '\n' || text[word] == '\r' || text[word] == '#';
    if (empty && kept == text.size()) kept = line + 1;
    if (text[word] == '[' && text.find("source", word) > text.find('\n', word)) {
      block.end = std::min(kept, line + 1);
      break;
    }
    if (!empty) kept = text.size();
  }
  return block;
}

/// What a new rig says of a pair (config/rig_writer.h) holds of neither lamp alone; a comment of one's own stays.
void drop_pair_comment(const std::string& text, Edits& edits, const TomlTable& lamp) {
  const auto pair = lamp.region("pair");
  if (!pair) return;
  const std::size_t begin = bytes_of(text, *pair).end, end = std::min(text.find_first_of("\r\n", begin), text.size());
  const std::size_t word = std::min(text.find_first_not_of(" \t", begin), end);
  const std::string comment = "# " + std::string(kPairSays);
  if (text.compare(word, comment.size(), comment) == 0 && text.find_first_not_of(" \t", word + comment.size()) >= end)
    edits.replace(begin, end, "");
}

/// One of the two lamps that a pair is written as, with what holds for it.
std::string half_of_pair(const std::string& block, const SavedMount& mount) {
  // The block alone is no rig; as one it has the same tables at the same bytes behind a line of its own.
  const bool in_braces = block.starts_with('{');
  const std::string head = in_braces ? "lamp = [" : "[[design]]\n", text = head + block + (in_braces ? "]" : "");
  auto root = TomlTable::parse(text, "lamp");
  if (!root) return block;
  auto designs = in_braces ? std::vector{*root} : root->tables("design");
  auto lamps = designs.front().tables("lamp");
  if (lamps.empty()) return block;
  Edits edits = lamp_edits(text, lamps.front(), mount);
  set_key(text, edits, lamps.front(), "name", toml_quoted(mount.lamp), "name");
  set_key(text, edits, lamps.front(), "pair", "false", "name");
  drop_pair_comment(text, edits, lamps.front());
  std::string edited = edits.applied_to(text).substr(head.size());
  if (in_braces) edited.pop_back();
  return edited;
}

/// A lamp of the rig as it was wanted; everything else may be as it likes here.
bool is_as_wanted(const LampConfig& lamp, const SavedMount& mount) {
  constexpr double kOff = 2.0 * kRounding;  // of numbers rounded on the way
  if (lamp.sources.size() != mount.sources.size() || glm::distance(lamp.position_m, mount.position_m) > kOff)
    return false;
  for (std::size_t i = 0; i < lamp.sources.size(); ++i) {
    const SourceConfig& source = lamp.sources[i];
    const SavedMount::Turn& turn = mount.sources[i];
    for (const auto& [now, wanted] : {std::pair{source.yaw_rad, turn.yaw_rad},
                                      {source.pitch_rad, turn.pitch_rad},
                                      {source.roll_rad, turn.roll_rad}})
      if (!(std::abs(now - wanted) * kDegPerRad <= kOff)) return false;
  }
  return lamp.aim.kind == AimConfig::Kind::kAsFiled;
}

const SavedMount* mount_of(std::span<const SavedMount> mounts, const std::string& design, const std::string& lamp) {
  const auto found = std::ranges::find_if(
      mounts, [&](const SavedMount& mount) { return mount.design == design && mount.lamp == lamp; });
  return found == mounts.end() ? nullptr : &*found;
}

/// Whether the edited rig says what was wanted, and nothing else has changed.
Status check_edited(const Rig& before, const Rig& after, std::span<const SavedMount> mounts) {
  const Error strange{after.file.string(), "its lamps are written in a way that cannot be edited; nothing is written"};
  Rig same = after;
  if (before.designs.size() != after.designs.size()) return strange;
  for (std::size_t d = 0; d < after.designs.size(); ++d) {
    const DesignConfig& was = before.designs[d];
    DesignConfig& now = same.designs[d];
    if (was.lamps.size() != now.lamps.size()) return strange;
    for (std::size_t i = 0; i < now.lamps.size(); ++i) {
      LampConfig& lamp = now.lamps[i];
      const SavedMount* mount = mount_of(mounts, was.name, was.lamps[i].name);
      if (mount == nullptr) continue;
      if (!is_as_wanted(lamp, *mount)) return strange;
      lamp.position_m = was.lamps[i].position_m;
      lamp.aim = was.lamps[i].aim;
      for (std::size_t s = 0; s < lamp.sources.size(); ++s) {
        const SourceConfig& source = was.lamps[i].sources[s];
        lamp.sources[s].yaw_rad = source.yaw_rad, lamp.sources[s].pitch_rad = source.pitch_rad;
        lamp.sources[s].roll_rad = source.roll_rad;
      }
    }
  }
  if (!(same == before)) return strange;
  return Done{};
}

/// All edits that put the mounts into the text.
Result<Edits> edits_of(const std::string& text, const std::filesystem::path& file, const Rig& rig,
                       std::span<const SavedMount> mounts) {
  auto root = TomlTable::parse(text, file.string());
  if (!root) return root.error();
  Edits all;
  std::size_t done = 0;
  for (TomlTable design : root->tables("design")) {
    const std::string design_name = design.text("name");
    for (TomlTable lamp : design.tables("lamp")) {
      const std::string name = lamp.text("name");
      const bool pair = lamp.flag_or("pair", false);
      const SavedMount* first = mount_of(mounts, design_name, pair ? name + " left" : name);
      const SavedMount* second = pair ? mount_of(mounts, design_name, name + " right") : nullptr;
      if (first == nullptr && second == nullptr) continue;
      done += (first != nullptr ? 1u : 0u) + (second != nullptr ? 1u : 0u);
      const Bytes block = block_of(text, lamp);
      if (first != nullptr && (!pair || (second != nullptr && mirror(*first, *second)))) {
        const std::string& whole = text;
        const Edits edits = lamp_edits(whole, lamp, *first);
        all.replace(block.begin, block.end, edits.applied_to(whole.substr(0, block.end)).substr(block.begin));
        continue;
      }
      // Of two that no longer mirror each other, one may be as it was.
      const auto as_it_was = [&](const char* side) {
        SavedMount mount{design_name, name + side, {}, {}};
        for (const DesignConfig& of : rig.designs)
          for (const LampConfig& each : of.lamps) {
            if (of.name != design_name || each.name != mount.lamp) continue;
            mount.position_m = each.position_m;
            for (const SourceConfig& s : each.sources) mount.sources.push_back({s.yaw_rad, s.pitch_rad, s.roll_rad});
          }
        return mount;
      };
      const SavedMount left = first != nullptr ? *first : as_it_was(" left"),
                       right = second != nullptr ? *second : as_it_was(" right");
      const std::string written = text.substr(block.begin, block.end - block.begin);
      const std::string between = written.starts_with('{') ? ", " : written.ends_with("\n\n") ? "" : "\n";
      all.replace(block.begin, block.end, half_of_pair(written, left) + between + half_of_pair(written, right));
    }
  }
  if (done != mounts.size())
    return Error{file.string(),
                 "has not all of the lamps that were moved; its designs are others than when the drive "
                 "began"};
  return all;
}

Result<Rig> good_rig(const std::string& text, const std::filesystem::path& file) {
  auto reading = read_rig_text(text, file);
  if (!reading) return reading.error();
  if (!reading->problems.empty()) return reading->problems.front();
  return std::move(reading->rig);
}

}  // namespace

Result<std::string> with_mounts(const std::string& text, const std::filesystem::path& file,
                                std::span<const SavedMount> mounts) {
  const auto before = good_rig(text, file);
  if (!before) return before.error();
  const auto edits = edits_of(text, file, *before, mounts);
  if (!edits) return edits.error();
  std::string edited = edits->applied_to(text);
  const auto after = good_rig(edited, file);
  if (!after) return Error{file.string(), "cannot be edited (" + after.error().text() + "); nothing is written"};
  if (const Status same = check_edited(*before, *after, mounts); !same) return same.error();
  return edited;
}

Result<std::string> with_cameras(const std::string& text, const std::filesystem::path& file,
                                 std::span<const NamedEye> cameras) {
  const auto before = good_rig(text, file);
  if (!before) return before.error();
  auto root = TomlTable::parse(text, file.string());
  if (!root) return root.error();
  std::string list;
  for (const NamedEye& one : cameras) list += (list.empty() ? "" : ", ") + toml_quoted(camera_words(one));
  list = list.empty() ? "\"none\"" : "[" + list + "]";
  const std::string pair = "cameras = " + list;
  Edits edits;
  TomlTable desk = root->table("desk");
  if (const auto there = desk.region("cameras")) {
    const Bytes at = bytes_of(text, *there);
    edits.replace(at.begin, at.end, list);
  } else if (const auto table = root->region("desk")) {
    if (is_inline(text, desk)) {
      const Bytes at = bytes_of(text, *table);
      const bool empty = text.find_first_not_of(" \t", at.begin + 1) == at.end - 1;
      edits.replace(at.begin + 1, at.begin + 1, " " + pair + (empty ? " " : ","));
    } else {
      const std::size_t line = std::min(text.find('\n', bytes_of(text, *table).begin), text.size());
      edits.replace(line, line, "\n" + pair);
    }
  } else {
    edits.replace(text.size(), text.size(), std::string(text.ends_with('\n') ? "" : "\n") + "\n[desk]\n" + pair + "\n");
  }
  // A drive that began with a camera which is no more begins with the driver's eye.
  const std::string& chosen = before->desk.own_camera;
  const bool gone = !chosen.empty() && std::ranges::find(cameras, chosen, &NamedEye::name) == cameras.end();
  if (const auto there = desk.region("camera"); gone && there) {
    const Bytes at = bytes_of(text, *there);
    edits.replace(at.begin, at.end, toml_quoted(std::string(kCameraNames.front())));
  }
  const std::string edited = edits.applied_to(text);
  const auto after = good_rig(edited, file);
  if (!after) return Error{file.string(), "cannot be edited (" + after.error().text() + "); nothing is written"};
  Rig same = *after;
  same.desk.cameras = before->desk.cameras;
  if (gone) same.desk.camera = before->desk.camera, same.desk.own_camera = chosen;
  if (!chosen.empty()) same.desk.free_eye = before->desk.free_eye;  // it stands where that camera does
  if (!std::ranges::equal(after->desk.cameras, cameras) || !(same == *before))
    return Error{file.string(), "its desk is written in a way that cannot be edited; nothing is written"};
  return edited;
}

Status save_mounts(const std::filesystem::path& rig_file, const std::filesystem::path& out,
                   std::span<const SavedMount> mounts, const std::vector<NamedEye>* cameras) {
  const std::filesystem::path to = out.empty() ? rig_file : std::filesystem::absolute(out).lexically_normal();
  std::error_code ignored;
  if (to.parent_path() != std::filesystem::absolute(rig_file).lexically_normal().parent_path())
    return Error{to.string(), "the paths in a rig file are relative to its folder: it can be saved only in " +
                                  std::filesystem::absolute(rig_file).lexically_normal().parent_path().string()};
  if (std::filesystem::exists(to, ignored) && !std::filesystem::equivalent(to, rig_file, ignored))
    return Error{to.string(), "is there already; only the rig that is driven is written over"};
  std::ifstream stream(rig_file, std::ios::binary);
  if (!stream) return Error{rig_file.string(), "cannot be read"};
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  auto edited = with_mounts(text, rig_file, mounts);
  if (edited && cameras != nullptr) edited = with_cameras(*edited, rig_file, *cameras);
  if (!edited) return edited.error();
  return write_whole_file(to, *edited);
}

}  // namespace phare
