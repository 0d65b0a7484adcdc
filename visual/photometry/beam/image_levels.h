// Beam images on the ladder of accuracy, from the 1999 paper's texture to the native nodes, on the CPU: what each costs
// in bytes and is off by against the table itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// kNormalised8: I/Imax in 8 bits on an even grid, texture filter (Lecocq, Kelada, Kemeny 1999, pass two).
/// kHalfEven: 16-bit float candela on an even grid, texture filter. kHalfNodes: 16-bit float on the table's own nodes,
/// own weights. kFloatNodes: 32-bit float on the table's own nodes, own float32 weights.
inline constexpr ImageLevel kImageLevels[] = {ImageLevel::kNormalised8, ImageLevel::kHalfEven, ImageLevel::kHalfNodes,
                                              ImageLevel::kFloatNodes};
std::string level_name(ImageLevel level);
std::vector<std::string> level_names();
std::optional<ImageLevel> level_named(std::string_view name);

/// A table stored as a level stores it. An even grid spans the table's range with `columns` × `rows` texels.
class LevelImage {
 public:
  LevelImage(const IntensityTable& table, ImageLevel level, std::size_t columns = 1024, std::size_t rows = 512);

  /// Candela at the table's own angles (a flat screen: looked up by their tangents), computed as the level computes it:
  /// texture filters weigh in 1/256 (Vulkan asks for 8 bits at least, and lavapipe and GPUs have that), own weights are
  /// float32.
  float intensity_cd(float first_deg, float second_deg) const;
  std::size_t bytes() const { return bytes_; }  ///< on the device, where nodes are spaced evenly

 private:
  float filtered(float first_deg, float second_deg) const;
  float own_weights(float first_deg, float second_deg) const;

  ImageLevel level_;
  bool screen_ = false;
  std::vector<float> first_, second_;  ///< nodes, of a screen tangents; of an even grid only the ends count
  std::vector<float> values_;          ///< as they come out of the store: 8-bit and 16-bit values widened again
  float scale_ = 1.0f;
  std::size_t bytes_ = 0;
};

/// The largest differences of a level from the table.
struct LevelError {
  double worst_cd = 0.0;
  TableAngles worst_at;
  double worst_percent = 0.0;  ///< of the local intensity, where that is above `floor_cd`
  TableAngles worst_percent_at;
  double floor_cd = 1.0;
  std::size_t bytes = 0;
  std::size_t looked_at = 0;
};

/// Compares at every node and in the middle and the quarters of every cell of the whole table.
LevelError level_error(const IntensityTable& table, const LevelImage& image, double floor_cd = 1.0);

/// Nearest 16-bit float (round to even), and back.
std::uint16_t half_from_float(float value);
float float_from_half(std::uint16_t half);

}  // namespace phare
