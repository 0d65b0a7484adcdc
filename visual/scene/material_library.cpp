#include "visual/scene/material_library.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "config/base/paths.h"
#include "config/formats/toml_table.h"

namespace phare {
namespace {

constexpr std::array<std::pair<const char*, Surface>, 5> kSurfaceNames{{{"plain", Surface::kPlain},
                                                                        {"asphalt", Surface::kAsphalt},
                                                                        {"grass", Surface::kGrass},
                                                                        {"paint", Surface::kPaint},
                                                                        {"foliage", Surface::kFoliage}}};

/// Letters of a name in words, lower case: "RoadSurface_01" is road, surface.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  bool within = false, lower = false;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) == 0) {
      within = false;
      continue;
    }
    const bool upper = std::isupper(letter) != 0;
    if (!within || (upper && lower)) words.emplace_back();
    words.back() += static_cast<char>(std::tolower(letter));
    within = true;
    lower = !upper;
  }
  return words;
}

LibraryMaterial read_one(TomlTable& table) {
  LibraryMaterial material;
  material.name = table.text("name");
  const std::vector<double> reflectance = table.numbers("reflectance", 3);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(reflectance[i] >= 0.0 && reflectance[i] <= 1.0)) table.fail("reflectance", "outside 0 … 1");
    material.reflectance[static_cast<int>(i)] = static_cast<float>(reflectance[i]);
  }
  if (const Result<Surface> surface = surface_named(table.text_or("surface", "plain")); surface)
    material.surface = *surface;
  else
    table.fail("surface", surface.error().reason);
  material.r_table = table.flag_or("r_table", material.surface == Surface::kAsphalt);
  if (const std::string retro = table.text_or("retro", ""); !retro.empty()) {
    std::optional<double> r_a;
    if (table.has("retroreflection_cd_per_lx_m2")) r_a = table.number("retroreflection_cd_per_lx_m2", 1e-3, 1e4);
    Result<Retroreflection> read = retroreflection(retro, r_a, std::nullopt);
    if (read)
      material.retro = std::move(*read);
    else
      table.fail("retro", read.error().reason);
  }
  if (table.has("roughness_deg")) {
    if (material.retro.kind != RetroKind::kNone) table.fail("roughness_deg", "goes without retro");
    material.retro = grooves(table.number("roughness_deg", 0.0, kRoughest_deg));
  }
  material.words = table.texts_or_empty("words");
  for (const std::string& word : material.words)
    if (words_of(word) != std::vector{word}) table.fail("words", "'" + word + "' is not one word of small letters");
  material.source = table.text("source");
  material.confirmed = table.flag_or("confirmed", true);
  return material;
}

}  // namespace

Result<Surface> surface_named(const std::string& name) {
  for (const auto& [known, surface] : kSurfaceNames)
    if (name == known) return surface;
  return Error{"", "unknown surface '" + name + "'; known are plain, asphalt, grass, paint, foliage"};
}

Result<MaterialLibrary> MaterialLibrary::read(const std::filesystem::path& file) {
  Result<TomlTable> root = TomlTable::read(file);
  if (!root) return root.error();
  MaterialLibrary library;
  for (TomlTable& table : root->tables("material")) {
    library.materials_.push_back(read_one(table));
    const auto same = [&](const LibraryMaterial& other) { return other.name == library.materials_.back().name; };
    if (std::ranges::count_if(library.materials_, same) > 1) table.fail("name", "stands here twice");
  }
  if (const Status done = root->finish(); !done) return done.error();
  return library;
}

Result<MaterialLibrary> MaterialLibrary::read() {
  return read(config_dir() / "materials" / "surfaces.toml");
}

Result<const LibraryMaterial*> MaterialLibrary::named(const std::string& name) const {
  const auto found = std::ranges::find(materials_, name, &LibraryMaterial::name);
  if (found != materials_.end()) return &*found;
  std::vector<std::string> known;
  for (const LibraryMaterial& material : materials_) known.push_back(material.name);
  return Error{"", unknown_name_reason("material", name, known)};
}

const LibraryMaterial* MaterialLibrary::fitting(std::string_view material_name) const {
  const std::vector<std::string> words = words_of(material_name);
  for (const LibraryMaterial& material : materials_)
    for (const std::string& wanted : material.words)
      if (std::ranges::any_of(words, [&](const std::string& word) { return word == wanted || word == wanted + "s"; }))
        return &material;
  return nullptr;
}

}  // namespace phare
