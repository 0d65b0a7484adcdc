#include "visual/scene/scene_lights.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "config/base/input_files.h"
#include "config/formats/gltf_uri.h"

namespace phare {
namespace {

constexpr const char* kPunctual = "KHR_lights_punctual";
constexpr const char* kIes = "EXT_lights_ies";
constexpr double kMost = 1e9;  ///< cd, lx, or a factor: a lighthouse has 1e7 cd
constexpr std::uintmax_t kMostProfileBytes = std::uintmax_t{1} << 28;

/// Of an object's member, with what is wrong with it told once.
class Members {
 public:
  Members(const tinygltf::Value& object, std::string place) : object_(object), place_(std::move(place)) {}

  double number(const char* key, double otherwise, double least, double most) {
    if (!object_.Has(key)) return otherwise;
    const tinygltf::Value& value = object_.Get(key);
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : std::nan("");
    if (!(number >= least && number <= most)) fail(std::string(key) + " is not a number in its range");
    return number;
  }
  glm::vec3 colour() {
    glm::vec3 rgb(1.0f);
    if (!object_.Has("color")) return rgb;
    const tinygltf::Value& value = object_.Get("color");
    const bool three = value.IsArray() && value.ArrayLen() == 3;
    for (int c = 0; c < 3; ++c) {
      const double part = three && value.Get(c).IsNumber() ? value.Get(c).GetNumberAsDouble() : -1.0;
      if (!(part >= 0.0 && part <= 1.0)) {
        fail("color is not three numbers from 0 to 1");
        break;
      }
      rgb[c] = static_cast<float>(part);
    }
    return rgb;
  }
  std::string text(const char* key) {
    if (!object_.Has(key)) return "";
    if (!object_.Get(key).IsString()) fail(std::string(key) + " is not a text");
    return object_.Get(key).IsString() ? object_.Get(key).Get<std::string>() : "";
  }
  std::optional<std::size_t> index(const char* key, std::size_t count) {
    if (!object_.Has(key) || !object_.Get(key).IsInt() || object_.Get(key).Get<int>() < 0) {
      fail(std::string(key) + " is not an index");
      return std::nullopt;
    }
    const auto at = static_cast<std::size_t>(object_.Get(key).Get<int>());
    if (at >= count) {
      fail(std::string(key) + " " + std::to_string(at) + " does not exist");
      return std::nullopt;
    }
    return at;
  }
  void fail(const std::string& reason) {
    if (!error_) error_ = Error{place_, reason};
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  const tinygltf::Value& object_;
  std::string place_;
  std::optional<Error> error_{};
};

const tinygltf::Value* object_of(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

/// Entries of the extension's `lights`.
Result<std::vector<const tinygltf::Value*>> lights_of(const tinygltf::Model& model, const char* extension) {
  std::vector<const tinygltf::Value*> lights;
  const tinygltf::Value* object = object_of(model.extensions, extension);
  if (object == nullptr) return lights;
  if (!object->Has("lights") || !object->Get("lights").IsArray())
    return Error{extension, "lights is not a list"};
  const tinygltf::Value& list = object->Get("lights");
  for (std::size_t i = 0; i < list.ArrayLen(); ++i) {
    const tinygltf::Value& light = list.Get(static_cast<int>(i));
    if (!light.IsObject()) return Error{std::string(extension) + ": light " + std::to_string(i), "is not an object"};
    lights.push_back(&light);
  }
  return lights;
}

Result<SceneLight> punctual(const tinygltf::Value& object, const std::string& place) {
  Members members(object, place);
  SceneLight light;
  light.name = members.text("name");
  const std::string type = members.text("type");
  if (type == "point")
    light.kind = SceneLight::Kind::kPoint;
  else if (type == "spot")
    light.kind = SceneLight::Kind::kSpot;
  else if (type == "directional")
    light.kind = SceneLight::Kind::kDirectional;
  else
    members.fail("type is none of point, spot, directional");
  light.colour = members.colour();
  light.intensity = members.number("intensity", 1.0, 0.0, kMost);
  if (object.Has("range") && light.kind != SceneLight::Kind::kDirectional) {
    light.range_m = members.number("range", light.range_m, 0.0, std::numeric_limits<double>::max());
    if (light.range_m == 0.0) members.fail("range is not more than 0");
  }
  if (light.kind == SceneLight::Kind::kSpot && object.Has("spot")) {
    if (object.Get("spot").IsObject()) {
      Members spot(object.Get("spot"), place);
      light.inner_rad = spot.number("innerConeAngle", light.inner_rad, 0.0, std::numbers::pi / 2.0);
      // glTF 2.0 gives π/2 in float32 too, which is a little more.
      light.outer_rad = spot.number("outerConeAngle", light.outer_rad, 0.0, std::numbers::pi / 2.0 + 1e-6);
      if (spot.error()) return *spot.error();
      if (!(light.inner_rad < light.outer_rad)) members.fail("innerConeAngle is not less than outerConeAngle");
    } else {
      members.fail("spot is not an object");
    }
  }
  if (members.error()) return *members.error();
  return light;
}

Result<LightProfile> profile(const tinygltf::Model& model, const tinygltf::Value& object,
                             const std::filesystem::path& folder, const std::string& place) {
  Members members(object, place);
  LightProfile profile;
  profile.name = place;
  const std::string uri = members.text("uri");
  if (!uri.empty() && !is_data_uri(uri)) {
    profile.file = folder / decoded_uri(uri);
    profile.name = profile.file.string();
    if (const std::string why = why_no_file(profile.file); !why.empty()) return Error{place, profile.name + ": " + why};
    std::error_code failed;
    if (std::filesystem::file_size(profile.file, failed) > kMostProfileBytes || failed)
      return Error{place, profile.name + ": cannot be read, or is larger than 256 MiB"};
    std::ifstream stream(profile.file, std::ios::binary);
    profile.bytes.assign(std::istreambuf_iterator<char>(stream), {});
    if (stream.bad()) return Error{place, profile.name + ": cannot be read"};
  } else if (!uri.empty()) {
    const std::optional<std::vector<unsigned char>> bytes = bytes_of_data_uri(uri);
    if (!bytes) return Error{place, "its data URI is no base64"};
    profile.bytes.assign(bytes->begin(), bytes->end());
  } else {
    if (!object.Has("bufferView")) return Error{place, "has neither uri nor bufferView"};
    const std::optional<std::size_t> view = members.index("bufferView", model.bufferViews.size());
    if (members.error()) return *members.error();
    const Result<std::span<const unsigned char>> bytes = bytes_of_view(model, static_cast<int>(*view));
    if (!bytes) return Error{place, bytes.error().text()};
    profile.bytes.assign(bytes->begin(), bytes->end());
  }
  if (members.error()) return *members.error();
  return profile;
}

/// Looks along the node's -z, up is its y; scale does not count.
Status place_at(SceneLight& light, const NodeInstance& node, const std::string& place) {
  const glm::dmat3 turn(node.world_from_node);
  const glm::dvec3 axis = -turn[2], up = turn[1];
  const double across = glm::length(glm::cross(axis, up)), size = glm::length(axis) * glm::length(up);
  if (!(across > 1e-9 * size) || !std::isfinite(size)) return Error{place, "its transform leaves a lamp no direction"};
  light.position_m = glm::dvec3(node.world_from_node[3]);
  const glm::dvec3 forward = glm::normalize(axis), left = glm::normalize(glm::cross(up, axis));
  light.world_from_light = {forward, left, glm::cross(forward, left)};
  return Done{};
}

}  // namespace

Status read_scene_lights(const tinygltf::Model& model, const std::filesystem::path& folder, Scene& scene) {
  const auto punctual_lights = lights_of(model, kPunctual);
  if (!punctual_lights) return punctual_lights.error();
  const auto profiles = lights_of(model, kIes);
  if (!profiles) return profiles.error();
  if (punctual_lights->empty() && profiles->empty()) return Done{};

  std::vector<SceneLight> known;
  for (std::size_t i = 0; i < punctual_lights->size(); ++i) {
    auto light = punctual(*(*punctual_lights)[i], std::string(kPunctual) + ": light " + std::to_string(i));
    if (!light) return light.error();
    known.push_back(std::move(*light));
  }
  for (std::size_t i = 0; i < profiles->size(); ++i) {
    auto read = profile(model, *(*profiles)[i], folder, std::string(kIes) + ": light " + std::to_string(i));
    if (!read) return read.error();
    scene.light_profiles.push_back(std::move(*read));
  }

  const Result<std::vector<NodeInstance>> nodes = node_instances(model);
  if (!nodes) return nodes.error();
  for (const NodeInstance& node : *nodes) {
    const tinygltf::ExtensionMap& extensions = model.nodes[static_cast<std::size_t>(node.node)].extensions;
    const std::string named = "node '" + node.name + "'";
    if (const tinygltf::Value* object = object_of(extensions, kPunctual)) {
      Members members(*object, named + ": " + kPunctual);
      const std::optional<std::size_t> index = members.index("light", known.size());
      if (members.error()) return *members.error();
      SceneLight light = known[*index];
      if (light.name.empty()) light.name = node.name;
      if (Status done = place_at(light, node, named); !done) return done;
      scene.lights.push_back(std::move(light));
    }
    if (const tinygltf::Value* object = object_of(extensions, kIes)) {
      Members members(*object, named + ": " + kIes);
      const std::optional<std::size_t> index = members.index("light", scene.light_profiles.size());
      SceneLight light{.name = node.name, .kind = SceneLight::Kind::kProfile};
      light.intensity = members.number("multiplier", 1.0, 0.0, kMost);
      light.colour = members.colour();
      if (members.error()) return *members.error();
      light.profile = *index;
      if (Status done = place_at(light, node, named); !done) return done;
      scene.lights.push_back(std::move(light));
    }
  }
  if (scene.lights.size() > kMostSceneLights)
    return Error{"lights", "more than " + std::to_string(kMostSceneLights) + " stand in the scene"};
  return Done{};
}

}  // namespace phare
