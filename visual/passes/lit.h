// The lit pass: every surface under every lamp, per pixel; the sky behind.
#pragma once

#include "visual/lit_scene.h"
#include "visual/passes/eyeshine.h"
#include "visual/passes/fog.h"
#include "visual/passes/precipitation.h"
#include "visual/passes/spray.h"

namespace phare {

/// Where a view is drawn to.
struct LitTarget {
  gpu::Image& colour;
  gpu::Image* resolved = nullptr;  ///< of a multisampled colour
  gpu::Image& depth;
  vk::Rect2D area{};          ///< what of them is the view's
  bool depth_done = false;    ///< the depth pass ran: only equal depth is drawn
  bool keep = false;          ///< what lies around the area stays
  bool black_around = false;  ///< or becomes black
};

class LitPass {
 public:
  explicit LitPass(gpu::Device& device)
      : sky_(device), fog_sky_(device), eyeshine_(device), spray_(device), drops_(device) {}

  /// Before the views of a frame; the frame before is done.
  void begin_frame() { sky_.begin_frame(); }
  void draw(gpu::FrameGraph& graph, LitScene& scene, const LitView& view, const LitTarget& target, LampOutput output);

 private:
  SkyPass sky_;
  FogSky fog_sky_;
  Eyeshine eyeshine_;
  Spray spray_;
  Drops drops_;
};

}  // namespace phare
