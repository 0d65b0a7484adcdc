// The ladder of beam images.
// Computes: what each way of storing and filtering a table gives, with the arithmetic of that way. Sources: Lecocq,
// Kelada, Kemeny 1999 (normalised 8-bit texture F = I/Imax); Vulkan 1.3 §16.8 (texel filtering; at least 4, in practice
// 8 bits of weight); IEEE 754 binary16. Frame: the table's own angles. Leaves out: the projection of the 1999 texture
// (perspective in place of angles), which moves its error about, not its size. Checked by image_levels_test.cpp.
#include "visual/photometry/beam/image_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace phare {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

float to_eighth_bits(float weight) {
  return std::round(weight * 256.0f) / 256.0f;
}

}  // namespace

std::string level_name(ImageLevel level) {
  return std::string(kImageLevelNames[static_cast<std::size_t>(level)]);
}

std::vector<std::string> level_names() {
  return {kImageLevelNames.begin(), kImageLevelNames.end()};
}

std::optional<ImageLevel> level_named(std::string_view name) {
  const auto found = std::find(kImageLevelNames.begin(), kImageLevelNames.end(), name);
  if (found == kImageLevelNames.end()) return std::nullopt;
  return static_cast<ImageLevel>(found - kImageLevelNames.begin());
}

std::uint16_t half_from_float(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits >> 16 & 0x8000u;
  const float magnitude = std::abs(value);
  if (!(magnitude < 65520.0f)) return static_cast<std::uint16_t>(sign | 0x7c00u);  // too large, or no number: infinite
  if (magnitude < 6.103515625e-05f)  // below the smallest normal: steps of 2^-24
    return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(std::nearbyint(magnitude * 16777216.0f)));
  const std::uint32_t rounded = (bits & 0x7fffffffu) + 0xfffu + (bits >> 13 & 1u);
  return static_cast<std::uint16_t>(sign | ((rounded >> 13) - (112u << 10)));
}

float float_from_half(std::uint16_t half) {
  const float sign = (half & 0x8000u) != 0 ? -1.0f : 1.0f;
  const int exponent = half >> 10 & 0x1f;
  const float fraction = static_cast<float>(half & 0x3ffu);
  if (exponent == 0) return sign * fraction * 5.9604644775390625e-08f;
  if (exponent == 31) return sign * INFINITY;
  return sign * std::ldexp(1024.0f + fraction, exponent - 25);
}

LevelImage::LevelImage(const IntensityTable& table, ImageLevel level, std::size_t columns, std::size_t rows)
    : level_(level), screen_(table.screen_distance_m > 0.0) {
  // On a screen what is bilinear is candela over the factor of its tangents.
  std::vector<double> own_first = table.first_deg, own_second = table.second_deg;
  for (std::vector<double>* nodes : {&own_first, &own_second})
    for (double& node : *nodes) node = screen_ ? std::tan(node * kRadians) : node;
  const auto degrees = [&](double node) { return screen_ ? std::atan(node) / kRadians : node; };
  const auto factor = [&](double t, double u) { return screen_ ? screen_factor(t, u) : 1.0; };
  const bool even = level == ImageLevel::kNormalised8 || level == ImageLevel::kHalfEven;
  // A 16-bit float ends at 65,504: brighter tables are stored in units of more than one candela.
  const double peak = table.peak_cd();
  if (level == ImageLevel::kNormalised8) scale_ = static_cast<float>(peak);
  if ((level == ImageLevel::kHalfEven || level == ImageLevel::kHalfNodes) && peak > 60000.0)
    scale_ = static_cast<float>(peak / 60000.0);
  const auto stored = [&](double cd) {
    const float value = static_cast<float>(cd) / scale_;
    if (level == ImageLevel::kNormalised8) return std::round(value * 255.0f) / 255.0f;
    return level == ImageLevel::kFloatNodes ? value : float_from_half(half_from_float(value));
  };
  const std::size_t texel = level == ImageLevel::kNormalised8 ? 1 : level == ImageLevel::kFloatNodes ? 4 : 2;
  if (even) {
    const auto nodes = [](const std::vector<double>& own, std::size_t count) {
      std::vector<float> result;
      for (std::size_t i = 0; i < count; ++i)
        result.push_back(static_cast<float>(own.front() + (own.back() - own.front()) * static_cast<double>(i) /
                                                              static_cast<double>(count - 1)));
      return result;
    };
    first_ = nodes(own_first, columns);
    second_ = nodes(own_second, rows);
    for (const float s : second_) {
      for (const float f : first_) {
        const TableAngles at{
            std::clamp(degrees(static_cast<double>(f)), table.first_deg.front(), table.first_deg.back()),
            std::clamp(degrees(static_cast<double>(s)), table.second_deg.front(), table.second_deg.back())};
        values_.push_back(stored(table.intensity_at_cd(at) / factor(f, s)));
      }
    }
    bytes_ = values_.size() * texel;
  } else {
    first_.assign(own_first.begin(), own_first.end());
    second_.assign(own_second.begin(), own_second.end());
    for (std::size_t k = 0; k < table.candela.size(); ++k)
      values_.push_back(stored(table.candela[k] / factor(own_first[k % first_.size()], own_second[k / first_.size()])));
    bytes_ =
        (first_.size() + 1) * (second_.size() + 1) * 4 * texel;  // a cell of four nodes about each (beam_packing.h)
  }
}

float LevelImage::filtered(float first_deg, float second_deg) const {
  const std::size_t columns = first_.size(), rows = second_.size();
  const auto place = [](const std::vector<float>& nodes, float at, std::size_t& i, float& weight) {
    const float x = (at - nodes.front()) / (nodes.back() - nodes.front()) * static_cast<float>(nodes.size() - 1);
    const float whole = std::clamp(std::floor(x), 0.0f, static_cast<float>(nodes.size() - 2));
    i = static_cast<std::size_t>(whole);
    weight = to_eighth_bits(std::clamp(x - whole, 0.0f, 1.0f));
  };
  std::size_t i = 0, j = 0;
  float u = 0.0f, v = 0.0f;
  place(first_, first_deg, i, u);
  place(second_, second_deg, j, v);
  (void)rows;
  const float* row = values_.data() + j * columns + i;
  const float low = row[0] * (1.0f - u) + row[1] * u;
  const float high = row[columns] * (1.0f - u) + row[columns + 1] * u;
  return scale_ * (low * (1.0f - v) + high * v);
}

float LevelImage::own_weights(float first_deg, float second_deg) const {
  const auto place = [](const std::vector<float>& nodes, float at, std::size_t& i, float& weight) {
    i = static_cast<std::size_t>(std::upper_bound(nodes.begin() + 1, nodes.end() - 1, at) - nodes.begin()) - 1;
    weight = (at - nodes[i]) / (nodes[i + 1] - nodes[i]);
  };
  std::size_t i = 0, j = 0;
  float u = 0.0f, v = 0.0f;
  place(first_, first_deg, i, u);
  place(second_, second_deg, j, v);
  const std::size_t columns = first_.size();
  const float* row = values_.data() + j * columns + i;
  const float low = row[0] + (row[1] - row[0]) * u;
  const float high = row[columns] + (row[columns + 1] - row[columns]) * u;
  return scale_ * (low + (high - low) * v);
}

float LevelImage::intensity_cd(float first_deg, float second_deg) const {
  const auto coordinate = [&](float deg, const std::vector<float>& nodes) {
    if (!screen_) return deg;
    // A screen's rim is no round angle: what misses it by a rounding is on it, as on the device.
    const auto tangent = static_cast<float>(std::tan(static_cast<double>(deg) * kRadians));
    const float within = std::clamp(tangent, nodes.front(), nodes.back());
    return std::abs(tangent - within) < 1e-6f ? within : tangent;
  };
  const float first = coordinate(first_deg, first_), second = coordinate(second_deg, second_);
  if (!(first >= first_.front() && first <= first_.back() && second >= second_.front() && second <= second_.back()))
    return 0.0f;
  const float value = level_ == ImageLevel::kNormalised8 || level_ == ImageLevel::kHalfEven
                          ? filtered(first, second)
                          : own_weights(first, second);
  if (!screen_) return value;
  const float s = 1.0f + first * first + second * second;
  return value * (s * std::sqrt(s));
}

LevelError level_error(const IntensityTable& table, const LevelImage& image, double floor_cd) {
  LevelError error;
  error.floor_cd = floor_cd;
  error.bytes = image.bytes();
  const auto at = [](const std::vector<double>& nodes, std::size_t k) {
    const std::size_t i = k / 4;
    return i + 1 >= nodes.size() ? nodes.back()
                                 : nodes[i] + (nodes[i + 1] - nodes[i]) * 0.25 * static_cast<double>(k % 4);
  };
  const std::size_t columns = 4 * (table.first_deg.size() - 1) + 1, rows = 4 * (table.second_deg.size() - 1) + 1;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      // The angles a float32 renderer has; the truth at these very angles.
      const float first = static_cast<float>(at(table.first_deg, i)),
                  second = static_cast<float>(at(table.second_deg, j));
      const double truth =
          table.intensity_at_cd({std::clamp<double>(first, table.first_deg.front(), table.first_deg.back()),
                                 std::clamp<double>(second, table.second_deg.front(), table.second_deg.back())});
      const double off = std::abs(static_cast<double>(image.intensity_cd(first, second)) - truth);
      ++error.looked_at;
      if (off > error.worst_cd) {
        error.worst_cd = off;
        error.worst_at = {first, second};
      }
      if (truth > floor_cd && 100.0 * off / truth > error.worst_percent) {
        error.worst_percent = 100.0 * off / truth;
        error.worst_percent_at = {first, second};
      }
    }
  }
  return error;
}

}  // namespace phare
