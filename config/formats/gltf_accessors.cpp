// Accessors of glTF: what a buffer holds as numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "config/formats/gltf_file.h"

namespace phare {
namespace {

/// An accessor without a buffer view is zeros: nothing but this bounds what a small file asks for.
constexpr std::size_t kMostZeros = std::size_t{1} << 26;

Error bad(std::string place, std::string reason) {
  return Error{std::move(place), std::move(reason)};
}

// The bytes of an accessor: first element, stride and count, proven to lie inside the buffer.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
};

Result<Elements> elements_in_view(const tinygltf::Model& model, int view_index, std::size_t offset, std::size_t count,
                                  std::size_t element_bytes, const std::string& place) {
  const Result<std::span<const unsigned char>> bytes = bytes_of_view(model, view_index);
  if (!bytes) return bad(place, bytes.error().reason);
  const std::size_t given = model.bufferViews[static_cast<std::size_t>(view_index)].byteStride;
  const std::size_t stride = given == 0 ? element_bytes : given;
  if (stride < element_bytes) return bad(place, "stride " + std::to_string(stride) + " is smaller than an element");
  if (count == 0) return Elements{bytes->data(), stride};
  if (offset > bytes->size() || bytes->size() - offset < element_bytes ||
      count - 1 > (bytes->size() - offset - element_bytes) / stride)
    return bad(place, std::to_string(count) + " elements do not fit into its bufferView of " +
                          std::to_string(bytes->size()) + " bytes");
  return Elements{bytes->data() + offset, stride};
}

std::size_t bytes_of_component(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

template <typename T>
T number_at(const unsigned char* at) {
  T value;  // glTF and we are little-endian
  std::memcpy(&value, at, sizeof value);
  return value;
}

// glTF 2.0, 3.11: normalized integers as it converts them.
float component_at(const unsigned char* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const auto value = static_cast<float>(number_at<std::int8_t>(at));
      return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const auto value = static_cast<float>(*at);
      return normalized ? value / 255.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const auto value = static_cast<float>(number_at<std::int16_t>(at));
      return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const auto value = static_cast<float>(number_at<std::uint16_t>(at));
      return normalized ? value / 65535.0f : value;
    }
    default:
      return number_at<float>(at);
  }
}

Result<const tinygltf::Accessor*> accessor_of(const tinygltf::Model& model, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size())
    return bad("accessor " + std::to_string(index), "does not exist");
  return &model.accessors[static_cast<std::size_t>(index)];
}

Result<std::vector<std::uint32_t>> unsigned_numbers(const Elements& elements, std::size_t count, int type,
                                                    const std::string& place) {
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    return bad(place, "expected unsigned SCALAR indices");
  std::vector<std::uint32_t> out(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(&out[i], elements.first + i * elements.stride, bytes_of_component(type));
  return out;
}

// Which elements a sparse accessor replaces: rising, all of them there.
Result<std::vector<std::uint32_t>> sparse_indices(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                                                  const std::string& place) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count || sparse.indices.byteOffset < 0 ||
      sparse.values.byteOffset < 0)
    return bad(place, "its sparse part is none");
  const auto count = static_cast<std::size_t>(sparse.count);
  const Result<Elements> at =
      elements_in_view(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                       std::max<std::size_t>(bytes_of_component(sparse.indices.componentType), 1), place);
  if (!at) return at.error();
  Result<std::vector<std::uint32_t>> indices = unsigned_numbers(*at, count, sparse.indices.componentType, place);
  if (!indices) return indices.error();
  for (std::size_t i = 0; i < count; ++i)
    if ((*indices)[i] >= accessor.count || (i > 0 && (*indices)[i] <= (*indices)[i - 1]))
      return bad(place, "its sparse indices do not rise, or reach beyond its " + std::to_string(accessor.count) +
                            " elements");
  return indices;
}

// `components` numbers an element; of an accessor with one fewer the last is 1 where `fill` allows that.
template <typename Vector>
Result<std::vector<Vector>> read_vectors(const tinygltf::Model& model, int index, bool fill) {
  constexpr int kComponents = Vector::length();
  constexpr std::array kShapes{TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
  const std::string place = "accessor " + std::to_string(index);
  const Result<const tinygltf::Accessor*> found = accessor_of(model, index);
  if (!found) return found.error();
  const tinygltf::Accessor& accessor = **found;
  const int type = accessor.componentType;
  int components = kComponents;
  if (fill && accessor.type == kShapes[kComponents - 3]) --components;
  if (accessor.type != kShapes[static_cast<std::size_t>(components - 2)] || bytes_of_component(type) == 0 ||
      type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    return bad(place, "expected VEC" + std::to_string(kComponents) + " of float, or of integers of 8 or 16 bit");

  const std::size_t component_bytes = bytes_of_component(type);
  const std::size_t element_bytes = static_cast<std::size_t>(components) * component_bytes;
  std::vector<Vector> out;
  const auto take = [&](Vector& into, const unsigned char* at) {
    for (int c = 0; c < components; ++c) {
      into[c] = component_at(at + static_cast<std::size_t>(c) * component_bytes, type, accessor.normalized);
      if (!std::isfinite(into[c])) return false;
    }
    if (components < kComponents) into[kComponents - 1] = 1.0f;
    return true;
  };
  const auto not_finite = [&](std::size_t i) { return bad(place, "element " + std::to_string(i) + " is not finite"); };
  if (accessor.bufferView != -1) {  // as tinygltf has one that is not there
    const Result<Elements> elements =
        elements_in_view(model, accessor.bufferView, accessor.byteOffset, accessor.count, element_bytes, place);
    if (!elements) return elements.error();
    out.resize(accessor.count);
    for (std::size_t i = 0; i < out.size(); ++i)
      if (!take(out[i], elements->first + i * elements->stride)) return not_finite(i);
  } else {
    if (accessor.count > kMostZeros) return bad(place, "more than 67 million elements without a bufferView");
    out.assign(accessor.count, Vector(0.0f));
  }
  if (!accessor.sparse.isSparse) return out;
  const Result<std::vector<std::uint32_t>> replaced = sparse_indices(model, accessor, place);
  if (!replaced) return replaced.error();
  const auto& given = accessor.sparse.values;
  const Result<Elements> values = elements_in_view(
      model, given.bufferView, static_cast<std::size_t>(given.byteOffset), replaced->size(), element_bytes, place);
  if (!values) return values.error();
  for (std::size_t i = 0; i < replaced->size(); ++i)
    if (!take(out[(*replaced)[i]], values->first + i * values->stride)) return not_finite((*replaced)[i]);
  return out;
}

}  // namespace

Result<std::span<const unsigned char>> bytes_of_view(const tinygltf::Model& model, int index) {
  const std::string place = "bufferView " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= model.bufferViews.size())
    return bad(place, place + " does not exist");
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
    return bad(place, "buffer " + std::to_string(view.buffer) + " does not exist");
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    return bad(place, "its bufferView reaches beyond the buffer of " + std::to_string(data.size()) + " bytes");
  return std::span<const unsigned char>(data).subspan(view.byteOffset, view.byteLength);
}

Result<std::vector<glm::vec2>> read_vec2(const tinygltf::Model& model, int accessor) {
  return read_vectors<glm::vec2>(model, accessor, false);
}

Result<std::vector<glm::vec3>> read_vec3(const tinygltf::Model& model, int accessor) {
  return read_vectors<glm::vec3>(model, accessor, false);
}

Result<std::vector<glm::vec4>> read_vec4(const tinygltf::Model& model, int accessor) {
  return read_vectors<glm::vec4>(model, accessor, true);
}

Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int index) {
  const std::string place = "accessor " + std::to_string(index);
  const Result<const tinygltf::Accessor*> found = accessor_of(model, index);
  if (!found) return found.error();
  const tinygltf::Accessor& accessor = **found;
  if (accessor.type != TINYGLTF_TYPE_SCALAR) return bad(place, "expected unsigned SCALAR indices");
  if (accessor.sparse.isSparse) return bad(place, "sparse indices are not supported");
  const Result<Elements> elements =
      elements_in_view(model, accessor.bufferView, accessor.byteOffset, accessor.count,
                       std::max<std::size_t>(bytes_of_component(accessor.componentType), 1), place);
  if (!elements) return elements.error();
  return unsigned_numbers(*elements, accessor.count, accessor.componentType, place);
}

}  // namespace phare
