// What stands in the light of lamps that stand still, kept from frame to frame: at a crossing, in a garage, while a
// picture is looked at. While lamp, eye and all that moves are where they were, it is the same object, and maps made of
// it hold; where only others move, what stands in the light is kept and they are added. Pure: no device. Checked by
// tests/visual/kept_casters_test.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "visual/shadow_casters.h"

namespace phare {

class KeptCasters {
 public:
  using Casts = std::vector<std::shared_ptr<const CastBy>>;

  /// A lamp, and a number that is another when its beam is.
  struct Lamp {
    LampReach reach;
    glm::dmat3 world_from_image{1.0};
    std::size_t carried_by = SIZE_MAX, beam = 0;
    std::uint64_t version = 0;
    const LightPeaks* peaks = nullptr;
  };

  /// Before the views of a frame: what the frame before did not ask for is forgotten.
  void begin_frame();
  /// After another scene: forgets all.
  void clear() { kept_.clear(), asked_ = 0; }
  /// Of each lamp what casts, as casters.by() says. Views are told apart by their order in the frame.
  Casts find(const ShadowCasters& casters, std::span<const Lamp> lamps, std::span<const PlacedMesh> moving,
             const CastersFor& wanted);

  /// How often standing and moving things were looked for, since it was made.
  struct Counts {
    std::uint64_t standing = 0, moving = 0;
  };
  const Counts& counts() const { return counts_; }

 private:
  struct Kept {
    std::vector<double> source{};  ///< numbers that what stands comes from: lamp, eye, what is asked for
    std::vector<double> placed{};  ///< and what moves
    std::shared_ptr<const CastBy> standing{}, all{};
  };
  std::vector<Kept> kept_;
  std::size_t asked_ = 0;  ///< of them, by this frame
  Counts counts_;
};

}  // namespace phare
