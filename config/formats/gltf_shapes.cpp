#include "config/formats/gltf_shapes.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "config/base/input_files.h"
#include "config/formats/gltf_uri.h"

namespace phare {

namespace {

using Json = nlohmann::json;

/// Of one object: what is wrong with it first.
class Shapes {
 public:
  Shapes(const Json& object, std::string place) : object_(object), place_(std::move(place)) {
    if (!object.is_object()) {
      fail("is no object");
      return;
    }
    if (const auto name = object.find("name"); name != object.end() && name->is_string())
      place_ += " \"" + name->get<std::string>() + "\"";
  }

  void numbers(const char* key, std::size_t count) {
    const Json* value = find(key);
    if (value == nullptr) return;
    const bool all =
        value->is_array() && std::ranges::all_of(*value, [](const Json& number) { return number.is_number(); });
    if (!all) return fail(std::string(key) + " is no array of numbers");
    if (value->size() != count)
      fail(std::string(key) + " has " + std::to_string(value->size()) + " numbers, not " + std::to_string(count));
  }
  void number(const char* key, double least) {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (!value->is_number()) return fail(std::string(key) + " is no number");
    if (value->get<double>() < least) fail(std::string(key) + " is below " + Json(least).dump());
  }
  void index(const char* key) {
    if (const Json* value = find(key); value != nullptr && !is_index(*value)) fail(std::string(key) + " is no index");
  }
  void indices(const char* key) {
    const Json* value = find(key);
    if (value != nullptr && !(value->is_array() && std::ranges::all_of(*value, is_index)))
      fail(std::string(key) + " is no array of indices");
  }
  void word_of(const char* key, std::initializer_list<const char*> words) {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (!std::ranges::any_of(words, [&](const char* word) { return *value == word; }))
      fail(std::string(key) + " is " + value->dump() + ", which glTF does not know");
  }
  void whether(const char* key) {
    if (const Json* value = find(key); value != nullptr && !value->is_boolean())
      fail(std::string(key) + " is neither true nor false");
  }

  const Json* find(const char* key) const {
    if (!object_.is_object()) return nullptr;
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }
  void fail(const std::string& reason) {
    if (status_) status_ = Error{place_, reason};
  }
  const std::string& place() const { return place_; }
  Status status() const { return status_; }

 private:
  static bool is_index(const Json& value) {
    return value.is_number() && value >= 0 && std::floor(value.get<double>()) == value.get<double>();
  }

  const Json& object_;
  std::string place_;
  Status status_ = Done{};
};

Status asset(const Json& object) {
  Shapes shapes(object, "asset");
  if (const Json* version = shapes.find("version"))
    if (!version->is_string() || !version->get<std::string>().starts_with("2."))
      shapes.fail("version is " + version->dump() + "; glTF 2 is read");
  if (const Json* least = shapes.find("minVersion"); least != nullptr && *least != "2.0")
    shapes.fail("minVersion is " + least->dump() + "; glTF 2.0 is read");
  return shapes.status();
}

Status node(const Json& object, const std::string& place) {
  Shapes shapes(object, place);
  shapes.numbers("translation", 3), shapes.numbers("scale", 3), shapes.numbers("rotation", 4);
  shapes.numbers("matrix", 16);
  shapes.index("mesh"), shapes.indices("children");
  const Json* matrix = shapes.find("matrix");
  if (shapes.status() && matrix != nullptr)
    if ((*matrix)[3] != 0 || (*matrix)[7] != 0 || (*matrix)[11] != 0 || (*matrix)[15] != 1)
      shapes.fail("matrix has no last row 0, 0, 0, 1; columns follow each other");
  for (const char* part : {"translation", "rotation", "scale"})
    if (matrix != nullptr && shapes.find(part) != nullptr)
      shapes.fail(std::string("has matrix and ") + part + " both, of which one would be left out");
  if (const Json* rotation = shapes.find("rotation"); rotation != nullptr && shapes.status()) {
    double length2 = 0.0;
    for (const Json& part : *rotation) length2 += part.get<double>() * part.get<double>();
    constexpr double kRounded = 0.01;  // as exporters leave it; 0, 0, 0, 0 is refused where it would turn
    if (length2 != 0.0 && !(std::abs(std::sqrt(length2) - 1.0) <= kRounded))
      shapes.fail("rotation is no unit quaternion");
  }
  return shapes.status();
}

Status mesh(const Json& object, const std::string& place) {
  Shapes shapes(object, place);
  const Json* primitives = shapes.find("primitives");
  if (primitives == nullptr || !primitives->is_array()) {
    shapes.fail("primitives is no array");
    return shapes.status();
  }
  for (std::size_t i = 0; i < primitives->size(); ++i) {
    Shapes primitive((*primitives)[i], shapes.place() + ": primitives[" + std::to_string(i) + "]");
    primitive.index("indices"), primitive.index("material"), primitive.index("mode");
    if (const Json* attributes = primitive.find("attributes")) {
      Shapes each(*attributes, primitive.place() + ": attributes");
      if (attributes->is_object())
        for (const auto& [name, unused] : attributes->items()) each.index(name.c_str());
      if (!each.status()) return each.status();
    }
    if (!primitive.status()) return primitive.status();
  }
  return shapes.status();
}

Status material(const Json& object, const std::string& place) {
  Shapes shapes(object, place);
  shapes.numbers("emissiveFactor", 3);
  shapes.word_of("alphaMode", {"OPAQUE", "MASK", "BLEND"});
  shapes.number("alphaCutoff", 0.0);
  shapes.whether("doubleSided");
  if (!shapes.status()) return shapes.status();
  if (const Json* pbr = shapes.find("pbrMetallicRoughness")) {
    Shapes of_pbr(*pbr, shapes.place() + ": pbrMetallicRoughness");
    of_pbr.numbers("baseColorFactor", 4);
    of_pbr.number("metallicFactor", 0.0), of_pbr.number("roughnessFactor", 0.0);
    if (!of_pbr.status()) return of_pbr.status();
  }
  const Json::json_pointer strength("/extensions/KHR_materials_emissive_strength");
  if (object.contains(strength)) {
    Shapes emissive(object[strength], shapes.place() + ": KHR_materials_emissive_strength");
    emissive.number("emissiveStrength", 0.0);
    return emissive.status();
  }
  return Done{};
}

Status accessor(const Json& object, const std::string& place) {
  Shapes shapes(object, place);
  shapes.index("bufferView"), shapes.index("byteOffset"), shapes.index("componentType"), shapes.index("count");
  return shapes.status();
}

Status buffer_view(const Json& object, const std::string& place) {
  Shapes shapes(object, place);
  shapes.index("buffer"), shapes.index("byteOffset"), shapes.index("byteLength"), shapes.index("byteStride");
  return shapes.status();
}

Status scene(const Json& object, const std::string& place) {
  Shapes shapes(object, place);
  shapes.indices("nodes");
  return shapes.status();
}

}  // namespace

Status check_gltf_shapes(std::string_view json, const std::filesystem::path& folder) {
  // Buffers and pictures may hold the whole scene in their text: of pictures nothing is asked, and of buffers that are
  // files the name.
  constexpr std::size_t kLongestName = 4096;
  const auto wanted = [](int depth, Json::parse_event_t event, const Json& value) {
    if (depth == 1 && event == Json::parse_event_t::key) return value != "images";
    return event != Json::parse_event_t::value || !value.is_string() ||
           value.get_ref<const std::string&>().size() <= kLongestName;
  };
  const Json root = Json::parse(json, wanted, false);
  if (root.is_discarded() || !root.is_object()) return Done{};
  if (const auto found = root.find("asset"); found != root.end())
    if (const Status fit = asset(*found); !fit) return fit;
  for (const std::filesystem::path& buffer : buffers_beside(root))
    if (const std::string why = why_no_file(folder / buffer); !why.empty())
      return Error{"its buffer " + buffer.string(), why};
  using Check = Status (*)(const Json&, const std::string&);
  for (const auto& [key, check] : {std::pair<const char*, Check>{"scenes", scene},
                                   {"nodes", node},
                                   {"meshes", mesh},
                                   {"materials", material},
                                   {"accessors", accessor},
                                   {"bufferViews", buffer_view}}) {
    const auto list = root.find(key);
    if (list == root.end()) continue;
    if (!list->is_array()) return Error{key, "is no array"};
    for (std::size_t i = 0; i < list->size(); ++i)
      if (const Status fit = check((*list)[i], std::string(key) + "[" + std::to_string(i) + "]"); !fit) return fit;
  }
  return Done{};
}

}  // namespace phare
