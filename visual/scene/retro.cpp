#include "visual/scene/retro.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string_view>

#include "config/formats/toml_table.h"
#include "shaders/lib/retro.h"
#include "shaders/lib/wet.h"

namespace phare {
namespace {

static_assert(kObservations_deg.size() == shader::kSheetingRows);

constexpr double kNotGiven = -1.0;
const double kCosThirtyMetres{shader::kCosIncidenceAt30m};
constexpr double kDarkest = 1e-3;  ///< cd/(lx·m²): what counts as nothing, for the logarithm

constexpr const char* kEn12899 =
    "StVZVO 1998 (Austria, BGBl. II 238/1998), annex 2, types 1 and 2, as printed; that EN 12899-1 has the same is "
    "from memory";
constexpr const char* kRa3 =
    "from memory, of BS 8408 and DIN 67520; two digests of DIN 67520 give 300 as the least of both, without angles";
constexpr const char* kR3IvaWhite = "UN R3, class IVA, 20' to 40° official text; the rest from memory";
constexpr const char* kR3Iva = "UN R3, class IVA, from memory";
constexpr const char* kPlateLaw = "French order of 15 April 1996 on number plates, equal to EN 12899-1 RA1 at 0.33°";
constexpr const char* kD4956 = "ASTM D4956-01, from a transcription; entrance -4° taken as 5°";
constexpr const char* kD4956Unread = "ASTM D4956, from memory; entrance -4° taken as 5°";

RetroClass marking(const char* name, double mcd, const char* source, bool confirmed = true) {
  return {
      .name = name, .kind = RetroKind::kMarking, .r_l_mcd_per_lx_m2 = mcd, .source = source, .confirmed = confirmed};
}

RetroClass wet_marking(const char* name, double mcd, const char* source, bool confirmed = true) {
  RetroClass made = marking(name, mcd, source, confirmed);
  made.wet_mcd_per_lx_m2 = mcd;
  return made;
}

/// Rows of entrance angles 5°, 30°, 40°.
struct Row3 {
  double observation_deg;
  std::array<double, 3> r_a;
};
RetroClass sheeting(const char* name, std::initializer_list<Row3> rows, const char* source, bool confirmed) {
  RetroClass made{.name = name, .kind = RetroKind::kSheeting, .source = source, .confirmed = confirmed};
  for (const Row3& row : rows)
    made.rows.push_back({row.observation_deg, {row.r_a[0], kNotGiven, row.r_a[1], row.r_a[2]}});
  return made;
}

/// A colour: white's rows times the ratio of its first figure (D4956: at 0.2°, RA3B: at 0.33°) to white's.
RetroClass tinted(const char* name, RetroClass white, double ratio) {
  white.name = name;
  for (RetroClass::Row& row : white.rows)
    for (double& r_a : row.r_a_cd_per_lx_m2)
      if (r_a > 0.0) r_a *= ratio;
  return white;
}

std::vector<RetroClass> make_classes() {
  constexpr const char* kDry = "EN 1436, dry, least R_L in use, as two texts have it";
  constexpr const char* kDryOne = "EN 1436, dry, as one text has it";
  constexpr const char* kWet = "EN 1436, wet, as one text has it";
  constexpr const char* kWetUnread = "EN 1436, wet, from memory";
  std::vector<RetroClass> all{
      marking("EN 1436 R1", 80.0, "EN 1436, from memory", false),
      marking("EN 1436 R2", 100.0, kDryOne),
      marking("EN 1436 R3", 150.0, kDry),
      marking("EN 1436 R4", 200.0, kDry),
      marking("EN 1436 R5", 300.0, kDry),
      wet_marking("EN 1436 RW1", 25.0, kWet),
      wet_marking("EN 1436 RW2", 35.0, kWet),
      wet_marking("EN 1436 RW3", 50.0, kWetUnread, false),
      wet_marking("EN 1436 RW4", 75.0, kWetUnread, false),
      wet_marking("EN 1436 RW5", 100.0, kWetUnread, false),
      wet_marking("EN 1436 RW6", 150.0, kWetUnread, false),
      wet_marking("EN 1436 RR1", 25.0, "EN 1436, in rain, as one text has it"),
      wet_marking("EN 1436 RR2", 35.0, "EN 1436, in rain, from memory; a French level is 35, as one text has it",
                  false),
      wet_marking("EN 1436 RR3", 50.0, "EN 1436, in rain, from memory", false),
      sheeting("EN 12899-1 RA1 white", {{0.2, {70, 30, 10}}, {0.33, {50, 24, 9}}, {2.0, {5, 2.5, 1.5}}}, kEn12899,
               true),
      sheeting("EN 12899-1 RA1 yellow", {{0.2, {50, 22, 7}}, {0.33, {35, 16, 6}}, {2.0, {3, 1.5, 1}}}, kEn12899, true),
      sheeting("EN 12899-1 RA1 red", {{0.2, {14.5, 6, 2}}, {0.33, {10, 4, 1.8}}, {2.0, {1, 0.5, 0.5}}}, kEn12899, true),
      sheeting("EN 12899-1 RA1 green", {{0.2, {9, 3.5, 1.5}}, {0.33, {7, 3, 1.2}}, {2.0, {0.5, 0.3, 0.2}}}, kEn12899,
               true),
      sheeting("EN 12899-1 RA1 blue", {{0.2, {4, 1.7, 0.5}}, {0.33, {2, 1, 0.1}}, {2.0, {0.1, 0.1, 0.1}}}, kEn12899,
               true),
      sheeting("EN 12899-1 RA2 white", {{0.2, {250, 150, 110}}, {0.33, {180, 100, 95}}, {2.0, {5, 2.5, 1.5}}}, kEn12899,
               true),
      sheeting("EN 12899-1 RA2 yellow", {{0.2, {170, 100, 70}}, {0.33, {120, 70, 60}}, {2.0, {3, 1.5, 1}}}, kEn12899,
               true),
      sheeting("EN 12899-1 RA2 red", {{0.2, {45, 25, 15}}, {0.33, {25, 14, 13}}, {2.0, {1, 0.4, 0.3}}}, kEn12899, true),
      sheeting("EN 12899-1 RA2 green", {{0.2, {45, 25, 12}}, {0.33, {21, 12, 11}}, {2.0, {0.5, 0.3, 0.2}}}, kEn12899,
               true),
      sheeting("EN 12899-1 RA2 blue", {{0.2, {20, 11, 8}}, {0.33, {14, 8, 7}}, {2.0, {0.2, 0.1, 0.1}}}, kEn12899, true),
      sheeting("number plate white", {{0.33, {50, 24, 9}}, {1.5, {5, 2.5, 1.5}}}, kPlateLaw, true),
      sheeting("number plate yellow", {{0.33, {35, 16, 6}}, {1.5, {3, 1.5, 1}}}, kPlateLaw, true),
  };
  // Type II: a class dry and another wet, each pair "EN 1436 R3 RW2".
  const std::vector<RetroClass> markings(all.begin(), std::ranges::find(all, "EN 1436 RR1", &RetroClass::name));
  for (const RetroClass& dry : markings) {
    for (const RetroClass& wet : markings) {
      const bool pair = !dry.name.starts_with("EN 1436 RW") && wet.name.starts_with("EN 1436 RW");
      if (!pair || wet.r_l_mcd_per_lx_m2 >= dry.r_l_mcd_per_lx_m2) continue;
      all.push_back(marking((dry.name + wet.name.substr(std::string_view("EN 1436").size())).c_str(),
                            dry.r_l_mcd_per_lx_m2, "EN 1436, type II: both classes", dry.confirmed && wet.confirmed));
      all.back().wet_mcd_per_lx_m2 = wet.r_l_mcd_per_lx_m2;
    }
  }
  // Microprisms. A says nothing beyond 0.33°; there as B: chosen.
  all.push_back({.name = "DIN 67520 RA3A white",
                 .kind = RetroKind::kSheeting,
                 .rows = {{0.2, {625, 450, 325, 200}},
                          {0.33, {425, 300, 225, 150}},
                          {1.0, {35, 30, 20, 3.5}},
                          {1.5, {15, 13, 9, 1.5}}},
                 .source = kRa3,
                 .confirmed = false});
  const RetroClass three_b{.name = "DIN 67520 RA3B white",
                           .kind = RetroKind::kSheeting,
                           .rows = {{0.33, {300, 240, 165, 30}}, {1.0, {35, 30, 20, 3.5}}, {1.5, {15, 13, 9, 1.5}}},
                           .source = kRa3,
                           .confirmed = false};
  for (const RetroClass& made :
       {three_b, tinted("DIN 67520 RA3B yellow", three_b, 195.0 / 300.0),
        tinted("DIN 67520 RA3B red", three_b, 60.0 / 300.0), tinted("DIN 67520 RA3B green", three_b, 30.0 / 300.0),
        tinted("DIN 67520 RA3B blue", three_b, 19.0 / 300.0)})
    all.push_back(made);
  const RetroClass one =
      sheeting("ASTM D4956 I white", {{0.2, {70, 30, kNotGiven}}, {0.5, {30, 15, kNotGiven}}}, kD4956, true);
  const RetroClass three =
      sheeting("ASTM D4956 III white", {{0.2, {250, 150, kNotGiven}}, {0.5, {95, 65, kNotGiven}}}, kD4956, true);
  for (const RetroClass& made :
       {one, tinted("ASTM D4956 I yellow", one, 50.0 / 70.0), tinted("ASTM D4956 I red", one, 14.0 / 70.0),
        tinted("ASTM D4956 I green", one, 9.0 / 70.0), tinted("ASTM D4956 I blue", one, 4.0 / 70.0), three,
        tinted("ASTM D4956 III yellow", three, 170.0 / 250.0), tinted("ASTM D4956 III red", three, 45.0 / 250.0),
        tinted("ASTM D4956 III green", three, 45.0 / 250.0), tinted("ASTM D4956 III blue", three, 20.0 / 250.0),
        sheeting("ASTM D4956 IV white", {{0.2, {360, 170, kNotGiven}}, {0.5, {150, 72, kNotGiven}}}, kD4956Unread,
                 false),
        sheeting("ASTM D4956 VIII white", {{0.2, {700, 325, kNotGiven}}, {0.5, {250, 115, kNotGiven}}}, kD4956Unread,
                 false),
        sheeting("ASTM D4956 IX white",
                 {{0.2, {380, 215, kNotGiven}}, {0.5, {240, 135, kNotGiven}}, {1.0, {80, 45, kNotGiven}}}, kD4956Unread,
                 false),
        sheeting("ASTM D4956 XI white",
                 {{0.2, {580, 220, kNotGiven}}, {0.5, {420, 150, kNotGiven}}, {1.0, {120, 45, kNotGiven}}},
                 kD4956Unread, false)})
    all.push_back(made);
  all.push_back(
      {.name = "EN ISO 20471 tape",
       .kind = RetroKind::kSheeting,
       .rows = {{0.2, {330, 290, 180, 65}}, {0.33, {250, 200, 170, 60}}, {1.0, {25, 15, 12, 10}}, {1.5, {10, 7, 5, 4}}},
       .source = "EN ISO 20471, as one text has it"});
  // 300/200/100 mcd/lx head-on, at ±10° and at (±5°, ±20°); 1.5°: 5/2.8/2.5. Beyond 20° it asks for nothing: half and a
  // quarter of that at 20°, chosen.
  all.push_back({.name = "UN R3 IA red",
                 .kind = RetroKind::kSheeting,
                 .rows = {{0.33, {300, 100, 50, 25}}, {1.5, {5, 2.5, 1.25, 0.625}}},
                 .source = "UN R3, class IA, official text",
                 .whole_device = true});
  // mcd/lx at 0°, 20°, 30°, 40° to the side; ±10° up and down, where it has 1200 of white's 1800, is left out. For what
  // stands beside a road: of post reflectors (EN 12899-3) no figures were found.
  const RetroClass iva{.name = "UN R3 IVA white",
                       .kind = RetroKind::kSheeting,
                       .rows = {{0.33, {1800, 610, 540, 470}}, {1.5, {34, 15, 15, 15}}},
                       .source = kR3IvaWhite,
                       .confirmed = false,
                       .whole_device = true};
  all.push_back(iva);
  all.push_back({.name = "UN R3 IVA amber",
                 .kind = RetroKind::kSheeting,
                 .rows = {{0.33, {1125, 380, 335, 290}}, {1.5, {21, 10, 10, 10}}},
                 .source = kR3Iva,
                 .confirmed = false,
                 .whole_device = true});
  all.push_back({.name = "UN R3 IVA red",
                 .kind = RetroKind::kSheeting,
                 .rows = {{0.33, {450, 150, 135, 115}}, {1.5, {9, 4, 4, 4}}},
                 .source = kR3Iva,
                 .confirmed = false,
                 .whole_device = true});
  // A share of 0.3 of what enters the pupil into a cone 2° wide: 0.3/(pi·(1°)²) = 313 cd/(lx·m²) of the pupil's area,
  // rounded; aslant as the pupil's area is seen. How it ends beyond the cone is chosen.
  all.push_back({.name = "tapetum lucidum",
                 .kind = RetroKind::kPupil,
                 .rows = {{0.2, {300, 282, 260, 230}},
                          {1.0, {300, 282, 260, 230}},
                          {1.5, {60, 56, 52, 46}},
                          {2.0, {12, 11.3, 10.4, 9.2}}},
                 .source = "a guess of another night road renderer, of the share and the cone; no measurement was found",
                 .confirmed = false});
  all.push_back({.name = "upright facets",
                 .kind = RetroKind::kFacets,
                 .source = "own derivation; R_L of 10 to 30 mcd/(lx·m²) on dry asphalt is from memory",
                 .confirmed = false});
  return all;
}

/// The table on all angles, R_A: lines through what is given, logarithm over logarithm in observation, straight in
/// entrance.
std::array<std::array<double, 4>, kObservations_deg.size()> whole_table(const RetroClass& sheeting) {
  std::vector<RetroClass::Row> rows = sheeting.rows;
  const bool to_40 =
      std::ranges::any_of(rows, [](const RetroClass::Row& row) { return row.r_a_cd_per_lx_m2[3] >= 0.0; });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto& r = rows[i].r_a_cd_per_lx_m2;
    // Entrances that a class leaves out lie on the straight line through 5° and 30°.
    if (r[2] >= 0.0 && r[1] < 0.0) r[1] = r[0] + (r[2] - r[0]) * 0.6;
    if (r[2] >= 0.0 && r[3] < 0.0 && !to_40) r[3] = std::max(r[2] + (r[2] - r[0]) * 0.4, 0.0);
    // A single figure that is missing: as much less than at the observation angle before as head-on.
    for (double& figure : r) {
      const std::size_t e = static_cast<std::size_t>(&figure - r.data());
      if (figure < 0.0) figure = rows[i - 1].r_a_cd_per_lx_m2[e] * r[0] / rows[i - 1].r_a_cd_per_lx_m2[0];
    }
  }
  std::array<std::array<double, 4>, kObservations_deg.size()> table{};
  for (std::size_t e = 0; e < 4; ++e) {
    std::vector<std::pair<double, double>> known;  // ln angle, ln R_A
    for (const RetroClass::Row& row : rows)
      known.emplace_back(std::log(row.observation_deg), std::log(std::max(row.r_a_cd_per_lx_m2[e], kDarkest)));
    for (std::size_t o = 0; o < kObservations_deg.size(); ++o) {
      const double x = std::log(kObservations_deg[o]);
      std::size_t before = 0;
      while (before + 2 < known.size() && known[before + 1].first <= x) ++before;
      const auto& [x0, y0] = known[before];
      const auto& [x1, y1] = known[before + 1];
      // Nearer than the first angle a class gives, no more than there.
      const double at = std::max(x, known.front().first);
      table[o][e] = std::exp(y0 + (y1 - y0) * (at - x0) / (x1 - x0));
    }
  }
  return table;
}

}  // namespace

std::span<const RetroClass> retro_classes() {
  static const std::vector<RetroClass> all = make_classes();
  return all;
}

Result<Retroreflection> retroreflection(const std::string& class_name, std::optional<double> r_a,
                                        std::optional<double> r_l) {
  std::string name = class_name;
  if (name.empty() && r_a) name = "EN 12899-1 RA2 white";
  const RetroClass* found = nullptr;
  std::vector<std::string> known;
  for (const RetroClass& one : retro_classes()) {
    known.push_back(one.name);
    if (one.name == name) found = &one;
  }
  Retroreflection made;
  if (name.empty() && r_l) {
    made.kind = RetroKind::kMarking;
    made.r_l_mcd_per_lx_m2 = *r_l;
    return made;
  }
  if (found == nullptr) return Error{"", unknown_name_reason("retro", name, known)};
  made.kind = found->kind;
  made.class_name = class_name;
  if (found->kind != RetroKind::kSheeting && found->kind != RetroKind::kPupil) {
    if (r_a)
      return Error{"", "'" + name + "' is " + (found->kind == RetroKind::kMarking ? "a marking" : "ground") +
                           ": retroreflection_mcd_per_lx_m2 goes with it, not …_cd_per_lx_m2"};
    made.r_l_mcd_per_lx_m2 = r_l.value_or(found->r_l_mcd_per_lx_m2);
    if (found->wet_mcd_per_lx_m2 > 0.0)
      made.wet_mcd_per_lx_m2 = found->wet_mcd_per_lx_m2 * made.r_l_mcd_per_lx_m2 / found->r_l_mcd_per_lx_m2;
    return made;
  }
  if (r_l)
    return Error{"", "'" + name + "' is sheeting: retroreflection_cd_per_lx_m2 goes with it, not …_mcd_per_lx_m2"};
  if (found->whole_device && !r_a)
    return Error{"",
                 "'" + name + "' is of a whole reflector: retroreflection_cd_per_lx_m2 is needed, cd/lx over its area"};
  const auto table = whole_table(*found);
  const double scale = r_a ? *r_a / table[1][0] : 1.0;
  for (std::size_t o = 0; o < table.size(); ++o)
    for (int e = 0; e < 4; ++e)
      made.ln_r_a[o][e] =
          static_cast<float>(std::log(std::max(table[o][static_cast<std::size_t>(e)] * scale, kDarkest)));
  return made;
}

Retroreflection grooves(double roughness_deg) {
  if (roughness_deg <= 0.0) return {};
  return {.kind = RetroKind::kGrooves,
          .class_name = "Oren-Nayar",
          .roughness_rad = roughness_deg * std::numbers::pi / 180.0};
}

std::array<glm::vec4, 2> groove_terms(double roughness_rad, const glm::vec3& reflectance) {
  const double s = roughness_rad * roughness_rad;
  const glm::dvec3 rho(reflectance), weights(0.2126, 0.7152, 0.0722);
  const double seen = glm::dot(weights, rho), twice = seen > 0.0 ? glm::dot(weights, rho * rho) / seen : 0.0;
  const glm::dvec4 dry(-0.5 * s / (s + 0.33), 0.45 * s / (s + 0.09), 0.125 * s / (s + 0.09),
                       0.17 * twice * s / (s + 0.13));
  return {glm::vec4(dry), glm::vec4(dry * static_cast<double>(shader::kFacetsLeft))};
}

double sent_back_strength(const Retroreflection& retro, double rho) {
  if (retro.kind == RetroKind::kFacets && retro.r_l_mcd_per_lx_m2 == 0.0) return rho / std::numbers::pi;
  const double beside = std::max(1e-3 * retro.r_l_mcd_per_lx_m2 - rho / std::numbers::pi * kCosThirtyMetres, 0.0);
  return retro.kind == RetroKind::kFacets ? beside / static_cast<double>(shader::kFacetsAt30m) : beside;
}

double wet_share(const Retroreflection& marking, double rho) {
  const double wet_rho = static_cast<double>(shader::wet_reflectance(glm::vec3(static_cast<float>(rho))).x);
  const double beside = 1e-3 * marking.wet_mcd_per_lx_m2 - wet_rho / std::numbers::pi * kCosThirtyMetres;
  const double dry = sent_back_strength(marking, rho);
  return dry > 0.0 ? std::max(beside / dry, 0.0) : 0.0;
}

double sent_back_per_lx(const Retroreflection& retro, double rho, const glm::dvec3& to_lamp, const glm::dvec3& normal,
                        const glm::dvec3& to_eye) {
  const auto cos_incidence = static_cast<float>(glm::dot(to_lamp, normal));
  const auto cos_seen = static_cast<float>(glm::dot(to_eye, normal));
  if (retro.kind == RetroKind::kNone || cos_incidence <= 0.0f || cos_seen <= 0.0f) return 0.0;
  const auto cos_between = static_cast<float>(glm::dot(to_lamp, to_eye));
  const float observation_deg = shader::between_deg(glm::vec3(to_lamp), glm::vec3(to_eye));
  if (retro.kind == RetroKind::kSheeting || retro.kind == RetroKind::kPupil) {
    const float entrance_deg = shader::between_deg(glm::vec3(to_lamp), glm::vec3(normal));
    return sheeting_r_a(retro, static_cast<double>(observation_deg), static_cast<double>(entrance_deg)) /
           static_cast<double>(std::max(cos_seen, 0.1f));
  }
  const double per_unit = rho / std::numbers::pi;
  if (retro.kind == RetroKind::kGrooves)
    return per_unit * static_cast<double>(shader::grooves_beside(
                          groove_terms(retro.roughness_rad, glm::vec3(static_cast<float>(rho)))[0], cos_incidence,
                          cos_seen, cos_between));
  const auto whole = static_cast<float>(sent_back_strength(retro, rho) / per_unit);
  return per_unit * static_cast<double>(
                        retro.kind == RetroKind::kFacets
                            ? whole * shader::facets_share(cos_incidence, cos_seen, cos_between)
                            : shader::marking_sent_back(whole, observation_deg, cos_incidence, cos_seen, cos_between));
}

double sheeting_r_a(const Retroreflection& sheeting, double observation_deg, double entrance_deg) {
  const shader::SheetingRow at = shader::sheeting_row(static_cast<float>(observation_deg));
  return static_cast<double>(shader::sheeting_between(sheeting.ln_r_a[at.before], sheeting.ln_r_a[at.before + 1],
                                                      at.part, static_cast<float>(entrance_deg)));
}

}  // namespace phare
