// Each instrument of the picture off and on, over the rig of the country road: what the device draws for it and what
// the processor computes.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "visual/renderer.h"

namespace phare::bench {

class Instruments {
 public:
  using View = std::function<FrameInput(int round)>;

  /// Throws std::runtime_error where rig, scene or lamps cannot be read.
  Instruments();
  ~Instruments();
  Instruments(const Instruments&) = delete;
  Instruments& operator=(const Instruments&) = delete;

  /// Its scene, what moves there, and the beams of two designs.
  void load_into(Renderer& renderer);
  /// Every case, by its name. The views live as long as this.
  void add_to(const std::function<void(const std::string& name, const View& view)>& add);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace phare::bench
