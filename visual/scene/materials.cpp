#include "visual/scene/materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "config/formats/gltf_uri.h"
#include "config/formats/toml_table.h"
#include "shaders/lib/luminance.h"

namespace phare {
namespace {

/// Of a glTF colour without a unit that is to shine (KHR_materials_unlit): white is so bright. KHR_materials_emissive_
/// strength states emission in cd/m²; unlit says no unit.
constexpr float kUnlitWhite_cdm2 = 1.0f;
constexpr double kMostLuminance_cdm2 = 1e8;  ///< the sun has 1.6e9, an LED chip 1e8

const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double number_or(const tinygltf::Value& object, const char* key, double otherwise) {
  if (!object.Has(key) || !object.Get(key).IsNumber()) return otherwise;
  const double value = object.Get(key).GetNumberAsDouble();
  return std::isfinite(value) ? value : otherwise;
}

/// cd/m² of an emissive factor of 1.
double emissive_strength(const tinygltf::Material& source) {
  const tinygltf::Value* strength = extension_of(source.extensions, "KHR_materials_emissive_strength");
  return strength != nullptr ? number_or(*strength, "emissiveStrength", 1.0) : 1.0;
}

glm::dvec2 pair_or(const tinygltf::Value& object, const char* key, glm::dvec2 otherwise) {
  if (!object.Has(key) || !object.Get(key).IsArray() || object.Get(key).ArrayLen() != 2) return otherwise;
  glm::dvec2 pair = otherwise;
  for (int i = 0; i < 2; ++i) {
    const tinygltf::Value& value = object.Get(key).Get(i);
    if (value.IsNumber() && std::isfinite(value.GetNumberAsDouble())) pair[i] = value.GetNumberAsDouble();
  }
  return pair;
}

/// As KHR_texture_transform has it: scaled, turned, moved.
template <typename Info>
glm::dmat3 transform_of(const Info& info) {
  const tinygltf::Value* transform = extension_of(info.extensions, "KHR_texture_transform");
  if (transform == nullptr) return glm::dmat3(1.0);
  const glm::dvec2 offset = pair_or(*transform, "offset", {0.0, 0.0}), scale = pair_or(*transform, "scale", {1.0, 1.0});
  const double turn = number_or(*transform, "rotation", 0.0), c = std::cos(turn), s = std::sin(turn);
  return glm::dmat3{{c * scale.x, -s * scale.x, 0.0}, {s * scale.y, c * scale.y, 0.0}, {offset.x, offset.y, 1.0}};
}

template <typename Info>
int uv_set_of(const Info& info) {
  const tinygltf::Value* transform = extension_of(info.extensions, "KHR_texture_transform");
  return transform == nullptr ? info.texCoord
                              : static_cast<int>(number_or(*transform, "texCoord", static_cast<double>(info.texCoord)));
}

TextureWrap wrap_of(int gltf) {
  if (gltf == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::kClamp;
  return gltf == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::kMirror : TextureWrap::kRepeat;
}

}  // namespace

void SceneNotes::add(const std::string& reason, const std::string& what) {
  std::vector<std::string>& names = of_[reason];
  if (std::ranges::find(names, what) == names.end()) names.push_back(what);
}

std::vector<std::string> SceneNotes::lines() const {
  constexpr std::size_t kNamed = 6;
  std::vector<std::string> lines;
  for (const auto& [reason, names] : of_) {
    std::string line = reason;
    for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i)
      if (!names[i].empty()) line += (i == 0 ? ": " : ", ") + names[i];
    if (names.size() > kNamed) line += " and " + std::to_string(names.size() - kNamed) + " more";
    lines.push_back(line);
  }
  return lines;
}

void note_what_is_not_read(const tinygltf::Model& model, SceneNotes& notes) {
  // Of the last two each texture tells that is there by them only.
  static const std::array<std::string_view, 9> kRead{"KHR_materials_unlit",     "KHR_materials_emissive_strength",
                                                     "KHR_texture_transform",   "KHR_mesh_quantization",
                                                     "EXT_meshopt_compression", "KHR_lights_punctual",
                                                     "EXT_lights_ies",          "KHR_texture_basisu",
                                                     "EXT_texture_webp"};
  for (const std::string& extension : model.extensionsUsed)
    if (std::ranges::find(kRead, extension) == kRead.end() && !extension.starts_with("KHR_materials_"))
      notes.add("extensions that are not read", extension);
  if (!model.animations.empty())
    notes.add("animations stand still", std::to_string(model.animations.size()) + " of them");
  if (!model.skins.empty())
    notes.add("skins stand as they were modelled", std::to_string(model.skins.size()) + " of them");
  std::size_t lines = 0;
  bool morphed = false;
  for (const tinygltf::Mesh& mesh : model.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      lines += primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES ? 1u : 0u;
      morphed |= !primitive.targets.empty();
    }
  if (lines > 0) notes.add("points and lines are not drawn", std::to_string(lines) + " meshes of them");
  if (morphed) notes.add("morph targets are not applied", "");
}

Result<ReadMaterial> MaterialReader::read(const tinygltf::Material& source) {
  ReadMaterial read;
  SceneMaterial& material = read.material;
  const auto bad = [&source](const std::string& what) { return Error{"", "material '" + source.name + "': " + what}; };
  material.name = source.name;
  material.double_sided = source.doubleSided;
  const std::vector<double>& color = source.pbrMetallicRoughness.baseColorFactor;
  if (color.size() < 3) return bad("baseColorFactor needs 4 numbers");
  for (std::size_t i = 0; i < std::min<std::size_t>(color.size(), 4); ++i) {
    if (!(color[i] >= 0.0 && color[i] <= 1.0)) return bad("baseColorFactor is outside 0 … 1");
    material.look.base[static_cast<int>(i)] = static_cast<float>(color[i]);
  }
  for (const double part : source.emissiveFactor)
    if (!(part >= 0.0 && part <= 1.0)) return bad("emissiveFactor is outside 0 … 1");
  if (const double times = emissive_strength(source); !(times >= 0.0 && times <= kMostLuminance_cdm2))
    return bad("emissiveStrength is outside 0 … 1e8 cd/m²");
  material.reflectance = glm::vec3(material.look.base);

  read_look(source, read);
  const bool told = source.extras.IsObject() && source.extras.Has("phare");
  if (told) {
    if (Status done = read_extras(source, read); !done) return bad(done.error().reason);
  } else if (const LibraryMaterial* fits = library_.fitting(source.name); fits != nullptr && !material.look.unlit) {
    const bool colourless = !material.look.base_texture && material.reflectance == glm::vec3(1.0f);
    if (colourless) material.reflectance = fits->reflectance;
    // Of foliage whole triangles are left out far away, which of leaves in a picture would be half of each.
    const bool pictured = fits->surface == Surface::kFoliage && material.look.base_texture;
    material.surface = pictured ? Surface::kPlain : fits->surface;
    material.retro = fits->retro;
    material.r_table = fits->r_table;
    notes_.add("materials by words in their names (config/materials/surfaces.toml)",
               "'" + source.name + "' as " + fits->name);
  }
  note_what_is_left_out(source);
  return read;
}

Status MaterialReader::read_extras(const tinygltf::Material& source, ReadMaterial& read) {
  SceneMaterial& material = read.material;
  const auto bad = [](const std::string& what) { return Error{"", what}; };
  const tinygltf::Value& extras = source.extras.Get("phare");
  if (!extras.IsObject()) return bad("extras.phare is not an object");
  static const std::vector<std::string> keys{"material",
                                             "surface",
                                             "retro",
                                             "r_table",
                                             "roughness_deg",
                                             "emission_cdm2",
                                             "sky_share",
                                             "retroreflection_cd_per_lx_m2",
                                             "retroreflection_mcd_per_lx_m2",
                                             "luminance_cdm2"};
  for (const std::string& key : extras.Keys())
    if (std::ranges::find(keys, key) == keys.end())
      return bad("extras.phare: " + unknown_name_reason("key", key, keys));
  const auto text = [&](const char* key, std::string& value) -> std::string {
    if (!extras.Has(key)) return "";
    if (!extras.Get(key).IsString()) return std::string("extras.phare.") + key + " is not a text";
    value = extras.Get(key).Get<std::string>();
    return "";
  };
  std::string name, surface_name, class_name;
  for (const std::string& wrong : {text("material", name), text("surface", surface_name), text("retro", class_name)})
    if (!wrong.empty()) return bad(wrong);

  if (!name.empty()) {
    const Result<const LibraryMaterial*> found = library_.named(name);
    if (!found) return bad(found.error().reason);
    const LibraryMaterial& known = **found;
    if (material.look.base_texture) {
      // A picture says where a surface is darker; how dark it is on the whole says the library.
      const glm::vec4& base = material.look.base;
      const float seen = shader::luminance_of(material.reflectance), most = std::max({base.x, base.y, base.z, 1e-6f});
      const float scale = seen > 0.0f ? std::min(shader::luminance_of(known.reflectance) / seen, 1.0f / most) : 1.0f;
      for (int i = 0; i < 3; ++i) material.look.base[i] *= scale;
      material.reflectance *= scale;
    } else {
      material.reflectance = known.reflectance;
    }
    material.surface = known.surface;
    material.retro = known.retro;
    material.r_table = known.r_table;
  }
  if (!surface_name.empty()) {
    const Result<Surface> surface = surface_named(surface_name);
    if (!surface) return bad(surface.error().reason);
    material.surface = *surface;
    material.r_table = *surface == Surface::kAsphalt;
  }
  if (extras.Has("r_table")) {
    if (!extras.Get("r_table").IsBool()) return bad("extras.phare.r_table is neither true nor false");
    material.r_table = extras.Get("r_table").Get<bool>();
  }
  if (extras.Has("emission_cdm2")) {
    const tinygltf::Value& given = extras.Get("emission_cdm2");
    if (!given.IsArray() || given.ArrayLen() != 3) return bad("extras.phare.emission_cdm2 is not [r, g, b]");
    for (int i = 0; i < 3; ++i) {
      const tinygltf::Value& value = given.Get(i);
      const double c = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
      if (!(c >= 0.0 && c <= kMostLuminance_cdm2)) return bad("extras.phare.emission_cdm2 is outside 0 … 1e8 cd/m²");
      material.emission_cdm2[i] = static_cast<float>(c);
    }
    // It is drawn as what a diffuse surface would send (visual/fixed_light.h), so none of these is quite black.
    material.reflectance = glm::max(material.reflectance, 1e-3f);
  }
  if (extras.Has("sky_share")) {
    const tinygltf::Value& given = extras.Get("sky_share");
    const double share = given.IsNumber() ? given.GetNumberAsDouble() : -1.0;
    if (!(share >= 0.0 && share <= 1.0)) return bad("extras.phare.sky_share is not a number from 0 to 1");
    material.sky_share = static_cast<float>(share);
  }
  const auto figure = [&](const char* key, double most, std::optional<double>& value) -> std::string {
    if (!extras.Has(key)) return "";
    const tinygltf::Value& given = extras.Get(key);
    const double r = given.IsNumber() ? given.GetNumberAsDouble() : -1.0;
    if (!(r >= 0.0 && r <= most))
      return std::string(key) + " is not a number from 0 to " + std::to_string(std::lround(most));
    if (r > 0.0) value = r;
    return "";
  };
  std::optional<double> r_a, r_l, shining_cdm2, rough_deg;
  for (const std::string& wrong :
       {figure("retroreflection_cd_per_lx_m2", 1e4, r_a), figure("retroreflection_mcd_per_lx_m2", 1e5, r_l),
        figure("luminance_cdm2", kMostLuminance_cdm2, shining_cdm2), figure("roughness_deg", kRoughest_deg, rough_deg)})
    if (!wrong.empty()) return bad(wrong);
  if (r_a && r_l) return bad("a material has an R_A or an R_L, not both");
  const bool told_rough = extras.Has("roughness_deg");
  if (told_rough && (!class_name.empty() || r_a || r_l))
    return bad("a material has a roughness_deg or sends light back by a class or figure, not both");
  if (told_rough) material.retro = grooves(rough_deg.value_or(0.0));
  if (!class_name.empty() || r_a || r_l) {
    auto retro = retroreflection(class_name, r_a, r_l);
    if (!retro) return bad(retro.error().reason);
    material.retro = std::move(*retro);
  }
  if (shining_cdm2) {
    glm::vec3& emitted = material.look.emitted_cdm2;
    const float own = shader::luminance_of(emitted);
    emitted = own > 0.0f ? emitted * static_cast<float>(*shining_cdm2 / static_cast<double>(own))
                         : glm::vec3(static_cast<float>(*shining_cdm2));
  }
  return Done{};
}

void MaterialReader::read_look(const tinygltf::Material& source, ReadMaterial& read) {
  SceneMaterial& material = read.material;
  PixelLook& look = material.look;
  const std::string name = "'" + source.name + "'";
  const tinygltf::TextureInfo& base = source.pbrMetallicRoughness.baseColorTexture;
  const auto lay_by = [&read](const auto& info) {
    read.uv_set = uv_set_of(info);
    read.uv_from_file = transform_of(info);
  };
  // All lie as the first of these does.
  if (base.index >= 0)
    lay_by(base);
  else if (source.emissiveTexture.index >= 0)
    lay_by(source.emissiveTexture);
  else if (source.normalTexture.index >= 0)
    lay_by(source.normalTexture);
  else
    lay_by(source.pbrMetallicRoughness.metallicRoughnessTexture);
  look.base_texture = texture_of(base, name, look.sampler);

  // What it sends out itself.
  for (std::size_t i = 0; i < std::min<std::size_t>(source.emissiveFactor.size(), 3); ++i)
    look.emitted_cdm2[static_cast<int>(i)] = static_cast<float>(source.emissiveFactor[i] * emissive_strength(source));
  if (look.emitted_cdm2 != glm::vec3(0.0f)) {
    TextureSampler sampler = look.sampler;
    look.emissive_texture = texture_of(source.emissiveTexture, name, sampler);
    if (!look.base_texture) look.sampler = sampler;
    if (look.emissive_texture && look.base_texture &&
        (uv_set_of(source.emissiveTexture) != read.uv_set || transform_of(source.emissiveTexture) != read.uv_from_file))
      notes_.add("emissive textures laid by other coordinates than the base colour lie as that does", name);
  }
  look.unlit = extension_of(source.extensions, "KHR_materials_unlit") != nullptr;
  if (!look.unlit) read_relief(source, read);
  if (look.unlit) {
    look.emitted_cdm2 = glm::vec3(look.base) * kUnlitWhite_cdm2;
    look.emissive_texture = look.base_texture;
    look.base = glm::vec4(glm::vec3(0.0f), look.base.w);
    notes_.add("unlit materials shine with 1 cd/m² where they are white (KHR_materials_unlit says no unit)", name);
  }

  // Where it is not there.
  glm::vec4 mean(1.0f);
  if (look.base_texture) mean = mean_of(scene_.textures[*look.base_texture]);
  if (source.alphaMode == "MASK") look.cut_below = static_cast<float>(std::clamp(source.alphaCutoff, 0.0, 1.0));
  if (source.alphaMode == "BLEND") {
    look.cut_below = 0.5f;
    notes_.add("what is see-through (alphaMode BLEND) is there where it is at least half opaque, else not", name);
  }
  // Nothing is cut from what is opaque all over.
  if (look.cut_below && mean.w >= 1.0f && look.base.w >= *look.cut_below) look.cut_below.reset();
  material.reflectance = glm::vec3(look.base) * glm::vec3(mean);
}

void MaterialReader::read_relief(const tinygltf::Material& source, ReadMaterial& read) {
  PixelLook& look = read.material.look;
  const std::string name = "'" + source.name + "'";
  const auto take = [&](const auto& info, std::optional<std::size_t>& into) {
    TextureSampler sampler = look.sampler;
    const bool first = !look.base_texture && !look.emissive_texture && !look.relief();
    into = texture_of(info, name, sampler);
    if (!into) return;
    if (first) look.sampler = sampler;
    if (uv_set_of(info) != read.uv_set || transform_of(info) != read.uv_from_file)
      notes_.add("normal and roughness textures laid by other coordinates than a material's first texture lie as that "
                 "does",
                 name);
  };
  take(source.normalTexture, look.normal_texture);
  look.normal_scale = static_cast<float>(std::clamp(source.normalTexture.scale, -100.0, 100.0));
  const auto& pbr = source.pbrMetallicRoughness;
  take(pbr.metallicRoughnessTexture, look.rough_texture);
  look.roughness = static_cast<float>(std::clamp(pbr.roughnessFactor, 0.0, 1.0));
  look.metal = static_cast<float>(std::clamp(pbr.metallicFactor, 0.0, 1.0));
}

void MaterialReader::note_what_is_left_out(const tinygltf::Material& source) {
  const std::string name = "'" + source.name + "'";
  const auto& pbr = source.pbrMetallicRoughness;
  if (pbr.metallicRoughnessTexture.index < 0 && pbr.metallicFactor > 0.5 && pbr.roughnessFactor < 0.5)
    notes_.add("smooth metal is drawn as a diffuse surface of its colour", name);
  if (source.occlusionTexture.index >= 0) notes_.add("occlusion textures are not drawn", name);
  for (const auto& [extension, value] : source.extensions)
    if (extension != "KHR_materials_unlit" && extension != "KHR_materials_emissive_strength")
      notes_.add("extension " + extension + " is not read", name);
}

template <typename Info>
std::optional<std::size_t> MaterialReader::texture_of(const Info& info, const std::string& material,
                                                      TextureSampler& sampler) {
  if (info.index < 0) return std::nullopt;
  const std::string wanted = "a texture that cannot be had is left out";
  if (static_cast<std::size_t>(info.index) >= model_.textures.size()) {
    notes_.add(wanted, "texture " + std::to_string(info.index) + " of " + material + " does not exist");
    return std::nullopt;
  }
  const tinygltf::Texture& texture = model_.textures[static_cast<std::size_t>(info.index)];
  if (texture.source < 0) {
    std::string by = "has no image";
    if (texture.extensions.contains("KHR_texture_basisu"))
      by = "is there by KHR_texture_basisu only, which no package of Debian 12 reads";
    else if (!texture.extensions.empty())
      by = "is there by " + texture.extensions.begin()->first + " only, which is not read";
    notes_.add(wanted, "texture " + std::to_string(info.index) + " of " + material + " " + by);
    return std::nullopt;
  }
  if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) < model_.samplers.size()) {
    const tinygltf::Sampler& given = model_.samplers[static_cast<std::size_t>(texture.sampler)];
    sampler = {wrap_of(given.wrapS), wrap_of(given.wrapT), given.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST};
  }
  return image_of(texture.source);
}

std::optional<std::size_t> MaterialReader::image_of(int index) {
  const auto [found, fresh] = images_.try_emplace(index);
  if (!fresh) return found->second;
  const std::string wanted = "a texture that cannot be had is left out";
  const std::string number = "image " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= model_.images.size()) {
    notes_.add(wanted, number + " does not exist");
    return std::nullopt;
  }
  const tinygltf::Image& image = model_.images[static_cast<std::size_t>(index)];
  std::vector<unsigned char> of_file;
  std::span<const unsigned char> bytes(image.image);
  std::string name = image.name.empty() ? number : number + " '" + image.name + "'";
  if (image.bufferView >= 0) {
    const Result<std::span<const unsigned char>> view = bytes_of_view(model_, image.bufferView);
    if (!view) {
      notes_.add(wanted, name + ": " + view.error().reason);
      return std::nullopt;
    }
    bytes = *view;
  } else if (!image.uri.empty()) {
    name = decoded_uri(image.uri);
    const std::filesystem::path path = folder_ / name;
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed)) {
      notes_.add(wanted, name + ": no such file beside the scene");
      return std::nullopt;
    }
    std::ifstream stream(path, std::ios::binary);
    of_file.assign(std::istreambuf_iterator<char>(stream), {});
    bytes = of_file;
  }
  Result<SceneTexture> texture = decode_texture(bytes, name);
  if (!texture) {
    notes_.add(wanted, texture.error().text());
    return std::nullopt;
  }
  scene_.textures.push_back(std::move(*texture));
  return found->second = scene_.textures.size() - 1;
}

}  // namespace phare
