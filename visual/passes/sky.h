// The sky behind everything: a clear colour below the horizon, bands of elevation above it, drawn first within the lit
// pass. A view that sees no sky draws none.
//
// What is shown at once has a band for each step of 8 bits, and a pixel costs no more than writing it. With several
// samples a pixel, where the picture counts more than its time, it blends from edge to edge of even bands and is
// dithered (shaders/lib/tone.h), for the gradient is so slow that steps show: 0.15 floors of a straight road under the
// sky. An HDR image blends too, and is dithered when it is shown.
#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "visual/gpu/frame_graph.h"
#include "visual/passes/pipeline.h"
#include "visual/view.h"

namespace phare {

enum class LampOutput : std::uint32_t;

/// The moon as it is seen: a disc of half a degree.
struct MoonDisc {
  glm::dvec3 toward{0.0, 0.0, 1.0};
  glm::vec3 luminance_cdm2{0.0f};

  friend bool operator==(const MoonDisc&, const MoonDisc&) = default;
};
inline constexpr double kMoonRadius_rad = 0.00452;  ///< of its mean size in the sky, 31.1 minutes of arc across

/// Of one view.
struct Sky {
  glm::vec3 exposure_per_cdm2{1.0f};
  double zenith_cdm2 = 0.0;
  std::optional<MoonDisc> moon{};

  /// rgb cd/m² at the zenith, bluish; w: factor at the horizon, 3. A clear night far from towns, brightened enough to
  /// be seen on a display; chosen by eye.
  glm::vec4 zenith() const;

  friend bool operator==(const Sky&, const Sky&) = default;
};

/// From the sine of one elevation to that of another.
struct SkyBand {
  float low = 0.0f, high = 0.0f;
  glm::vec3 colour_low{0.0f}, colour_high{0.0f};
};

/// Signals 0 to 1 of the display, flat or blended; cd/m².
enum class SkyKind { kFlat, kBlended, kHdr };

/// From the horizon to the zenith. Flat: a band for each of 8 bits in the channel that changes most; the others are
/// rounded in its middle, so all are within one step. Else 28 bands, closer to one another at the horizon, where the
/// sky changes fastest: within half a step, or 0.4 % of the formula.
std::vector<SkyBand> sky_bands(const Sky& sky, SkyKind kind);

/// What of the dome a view sees: sectors of at most 22.5°, whose straight edges rise above their circle by a fiftieth
/// of the tangent of its elevation at most.
struct SkySectors {
  double first_rad = 0.0, step_rad = 0.0;
  std::uint32_t count = 0;     ///< 0: no sky in view
  double highest_sine = -1.0;  ///< of the elevations in view
};
SkySectors sky_sectors(const ViewGeometry& view);

class SkyPass {
 public:
  explicit SkyPass(gpu::Device& device);

  /// What the colour target is cleared to: the sky at the horizon (and below it, where no ground is).
  static vk::ClearValue clear_value(const Sky& sky, LampOutput output, const ViewGeometry& view);

  /// Before the views of a frame; the frame before is done.
  void begin_frame();
  /// The dome, inside a pass that has begun rendering and set its area. Nothing if the view sees no sky.
  void draw(gpu::Recorder& commands, const Sky& sky, const ViewGeometry& view, LampOutput output, vk::Format format,
            vk::SampleCountFlagBits samples);

 private:
  /// Of a view of the frame; its bands stay while the next frame's view has the same sky.
  struct Dome {
    Sky sky;
    SkyKind kind = SkyKind::kFlat;
    std::vector<SkyBand> bands;
  };
  Dome& dome_of(const Sky& sky, SkyKind kind);

  gpu::Device& device_;
  vk::raii::PipelineLayout layout_{nullptr};
  std::array<vk::raii::ShaderModule, 2> vertex_, fragment_;  ///< blended, flat
  std::map<std::tuple<LampOutput, vk::Format, vk::SampleCountFlagBits>, vk::raii::Pipeline> pipelines_;
  std::vector<Dome> domes_;
  /// Of all views of a frame, one after the other.
  struct Vertices {
    gpu::HostBuffer buffer;
    std::vector<gpu::HostBuffer> outgrown;
    std::size_t used_bytes = 0;
  };
  gpu::PerFrame<Vertices> vertices_{device_};
  std::size_t views_ = 0;  ///< of this frame
};

}  // namespace phare
