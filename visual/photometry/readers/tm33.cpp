// Reader of luminaire data as XML: ANSI/IES TM-33-18 (ATLA S001, UNI 11733; root LuminaireOpticalData) and TM-33-23
// (root IESTM33-22). The emitter's luminous intensities become a table; spectra and colour are not read. No copy of the
// standards was at hand: element names follow public descriptions of both schemas, and names of either are taken in
// either. XML by pugixml, which expands no external entities and no document type.
#include <algorithm>
#include <cmath>
#include <map>
#include <pugixml.hpp>

#include "visual/photometry/readers/file_text.h"
#include "visual/photometry/readers/grid_build.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// Letters and digits alone, upper case: "CIE _ C" and "CIE-C" become CIEC.
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : upper_case(text)) {
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) result += c;
  }
  return result;
}

class Tm33 {
 public:
  Tm33(std::string_view text, const std::string& name, const LampReadSettings& settings)
      : text_(text), name_(name), settings_(settings) {
    table_.name = name;
    table_.axis = settings.axis;
    table_.header.format = "TM-33";
  }
  Result<IntensityTable> read(const pugi::xml_node& root);
  std::string place(std::ptrdiff_t offset) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    return name_ + ":" + std::to_string(1 + std::count(text_.begin(), end, '\n'));
  }

 private:
  Error error(const pugi::xml_node& node, std::string reason) const {
    return {place(node.offset_debug()), std::move(reason)};
  }
  pugi::xml_node child(const pugi::xml_node& node, std::initializer_list<std::string_view> names) const {
    for (const pugi::xml_node& c : node.children()) {
      if (std::find(names.begin(), names.end(), local_name(c)) != names.end()) return c;
    }
    return {};
  }
  Result<double> number(const pugi::xml_node& node, double fallback) const;
  Result<pugi::xml_node> chosen_emitter(const pugi::xml_node& root);
  Status read_type(const pugi::xml_node& data);
  Status read_intensities(const pugi::xml_node& data);

  std::string_view text_;
  std::string name_;
  const LampReadSettings& settings_;
  IntensityTable table_;
  std::string symmetry_;
};

Result<double> Tm33::number(const pugi::xml_node& node, double fallback) const {
  if (!node) return fallback;
  const auto value = parse_number(trimmed(node.child_value()));
  if (!value)
    return error(node, std::string(local_name(node)) + " is not a finite number: " + in_quotes(node.child_value()));
  return *value;
}

Result<pugi::xml_node> Tm33::chosen_emitter(const pugi::xml_node& root) {
  std::size_t found = 0;
  pugi::xml_node chosen;
  for (const pugi::xml_node& emitter : root.children()) {
    if (local_name(emitter) != "Emitter") continue;
    if (!child(emitter, {"LuminousData", "IntensityDistribution"})) continue;
    if (++found == settings_.emitter) chosen = emitter;
  }
  if (found == 0) return error(root, "no Emitter with LuminousData");
  if (!chosen)
    return error(
        root, "emitter " + std::to_string(settings_.emitter) + " was asked for, the file has " + std::to_string(found));
  if (found > 1) {
    table_.notes.push_back(place(chosen.offset_debug()) + ": " + std::to_string(found) + " emitters; number " +
                           std::to_string(settings_.emitter) + " used");
  }
  return chosen;
}

Status Tm33::read_type(const pugi::xml_node& data) {
  const pugi::xml_node type = child(data, {"PhotometryType", "GoniometerType"});
  const std::string kind = plain(type.child_value());
  if (kind.ends_with("C") || kind.empty()) {
    table_.type = PhotometricType::kC;
    if (kind.empty()) table_.notes.push_back(place(data.offset_debug()) + ": no PhotometryType; taken as type C");
  } else if (kind.ends_with("B")) {
    table_.type = PhotometricType::kB;
  } else if (kind.ends_with("A")) {
    table_.type = PhotometricType::kA;
  } else {
    return error(type, "PhotometryType is " + in_quotes(type.child_value()) + ", not A, B or C");
  }
  const std::string metric = plain(child(data, {"Metric"}).child_value());
  if (!metric.empty() && metric != "LUMINOUS")
    return error(data,
                 "the metric is " + in_quotes(child(data, {"Metric"}).child_value()) + ", not luminous: no candela");
  symmetry_ = plain(child(data, {"SymmType", "SymmetryType"}).child_value());
  return Done{};
}

Status Tm33::read_intensities(const pugi::xml_node& data) {
  const auto multiplier = number(child(data, {"Multiplier"}), 1.0);
  if (!multiplier) return multiplier.error();
  if (*multiplier <= 0.0) return error(data, "the Multiplier is " + number_text(*multiplier) + ", not above 0");
  table_.header.multiplier = *multiplier;
  const bool is_c = table_.type == PhotometricType::kC;
  const double first_max = table_.type == PhotometricType::kB ? 90.0 : is_c ? 360.0 : 180.0;
  const double second_max = table_.type == PhotometricType::kA ? 90.0 : 180.0;

  struct Value {
    double first, second, candela;
    std::ptrdiff_t offset;
  };
  std::vector<Value> values;
  for (const pugi::xml_node& node : data.children()) {
    const std::string_view name = local_name(node);
    if (name != "IntensityData" && name != "IntData") continue;
    double angles[2] = {0.0, 0.0};
    for (const auto& [axis, long_name, short_name] : {std::tuple{0, "horz", "h"}, {1, "vert", "v"}}) {
      pugi::xml_attribute attribute = node.attribute(long_name);
      if (!attribute) attribute = node.attribute(short_name);
      const auto angle = parse_number(trimmed(attribute.value()));
      if (!angle)
        return error(node, std::string(long_name) + " is not a finite number: " + in_quotes(attribute.value()));
      angles[axis] = *angle;
    }
    if (std::abs(angles[0]) > first_max || std::abs(angles[1]) > second_max ||
        (is_c && (angles[0] < 0.0 || angles[1] < 0.0)))
      return error(node, "the direction " + number_text(angles[0]) + ", " + number_text(angles[1]) +
                             " is outside this type's range");
    const std::string_view word = trimmed(node.child_value());
    const auto cd = parse_number(word);
    if (!cd) return error(node, "an intensity is not a finite number: " + in_quotes(word));
    if (*cd < 0.0) return error(node, "negative intensity " + number_text(*cd));
    if (!std::isfinite(*cd * *multiplier)) return error(node, "intensity times multiplier is no finite number");
    double& smallest = table_.header.smallest_step_cd;
    if (*cd != 0.0) smallest = std::min(smallest == 0.0 ? 1e300 : smallest, last_digit(word) * *multiplier);
    values.push_back({angles[0], angles[1], *cd * *multiplier, node.offset_debug()});
  }
  if (values.empty()) return error(data, "no IntensityData");

  std::sort(values.begin(), values.end(), [](const Value& a, const Value& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  std::vector<double> first, second, planes;
  for (const Value& v : values) {
    if (first.empty() || v.first != first.back()) first.push_back(v.first);
    if (first.size() == 1) second.push_back(v.second);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Value& v = values[i];
    const bool twice = i > 0 && values[i - 1].first == v.first && values[i - 1].second == v.second;
    const std::string where = "direction " + number_text(v.first) + ", " + number_text(v.second);
    if (twice) return Error{place(v.offset), "the " + where + " is there twice"};
    if (v.first != first[std::min(i / second.size(), first.size() - 1)] || v.second != second[i % second.size()])
      return Error{place(v.offset), "the directions are no grid; " + where + " is out of line"};
    planes.push_back(v.candela);
  }
  if (planes.size() != first.size() * second.size())
    return error(data, "the directions are no grid: the last plane is short");
  if (second.size() < 2) return error(data, "one vertical angle is no beam");

  const bool stored_whole = symmetry_.ends_with("NONE");
  Unfolded unfolded;
  if (!is_c && stored_whole) {
    for (std::size_t i = 0; i < first.size(); ++i) unfolded.columns.push_back({first[i], i});
    if (first.size() < 2) return error(data, "one horizontal angle is no beam");
  } else {
    auto result = unfold_lm63(first, table_.type);
    if (!result) return error(data, result.error().reason);
    unfolded = std::move(*result);
  }
  table_.header.symmetry = unfolded.symmetry.empty() ? "none" : unfolded.symmetry;
  if (!unfolded.note.empty()) table_.notes.push_back(place(data.offset_debug()) + ": " + unfolded.note);
  fill_table(table_, unfolded.columns, std::move(second), planes);
  if (is_c) turn_about_axis(table_, settings_.c0_turn_deg);
  return Done{};
}

Result<IntensityTable> Tm33::read(const pugi::xml_node& root) {
  const std::string_view root_name = local_name(root);
  if (!root_name.starts_with("IESTM33") && root_name != "LuminaireOpticalData")
    return error(root, "the root element is " + in_quotes(root_name) + ", not IESTM33-22 or LuminaireOpticalData");
  std::string version = child(root, {"Version"}).child_value();
  if (version.empty()) version = root.attribute("version").value();
  table_.version = std::string(root_name.substr(0, 32)) + (version.empty() ? "" : " " + version.substr(0, 16));
  if (const pugi::xml_node header = child(root, {"Header"})) {
    for (const pugi::xml_node& node : header.children()) {
      if (table_.header.keywords.size() < 100)
        table_.header.keywords.emplace_back(upper_case(local_name(node)), std::string(trimmed(node.child_value())));
    }
  }
  const auto emitter = chosen_emitter(root);
  if (!emitter) return emitter.error();
  const pugi::xml_node data = child(*emitter, {"LuminousData", "IntensityDistribution"});
  const auto lumens = number(child(*emitter, {"RatedLumens"}), 0.0);
  if (!lumens) return lumens.error();
  const auto quantity = number(child(*emitter, {"Quantity"}), 1.0);
  if (!quantity) return quantity.error();
  table_.header.lamp_count = *quantity;
  table_.header.stated_flux_lm = std::max(0.0, *lumens);
  table_.header.absolute = plain(child(data, {"AbsolutePhotometry"}).child_value()) != "FALSE";
  table_.header.luminaire_flux = table_.header.absolute;
  if (const Status status = read_type(data); !status) return status.error();
  if (const Status status = read_intensities(data); !status) return status.error();
  return std::move(table_);
}

}  // namespace

Result<IntensityTable> parse_tm33(std::string_view text, const std::string& name, const LampReadSettings& settings,
                                  std::shared_ptr<pugi::xml_document>& tree) {
  Tm33 reader(text, name, settings);
  if (!tree) {
    auto document = std::make_shared<pugi::xml_document>();
    const pugi::xml_parse_result parsed = document->load_buffer(text.data(), text.size());
    if (!parsed) return Error{reader.place(parsed.offset), std::string("not XML: ") + parsed.description()};
    tree = std::move(document);
  }
  return reader.read(tree->document_element());
}

}  // namespace phare
