// Effects that draw over a picture that is there: a view's luminance, or what the display shows of it. The frame asks
// the plan for each of them and knows none by name. To add one to the program: its row in effects.cpp, its pass with
// its line in picture_effect.cpp, its test. A program that uses the renderer brings one as AddedEffect.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>

#include "visual/effects.h"
#include "visual/glare.h"
#include "visual/gpu/frame_graph.h"
#include "visual/renderer.h"

namespace phare {

enum class DrawsOver {
  kLuminance,  ///< RGBA16F: cd/m², alpha: lx; only where its row says so (EffectRow::over_luminance)
  kDisplay     ///< in the display's format
};

/// One view's picture, one sample a pixel.
struct PictureDraw {
  gpu::FrameGraph& graph;
  gpu::Image& picture;
  vk::Rect2D area{};  ///< the view's part of it
  const ViewInput& input;
  const ViewGeometry& geometry;
  std::span<const GlaringLamp> glare{};  ///< that shine into the eye, strongest first
  std::size_t level = 1;                 ///< of the effect, as planned
};

/// Lives from the first frame that calls for it to the end of the device.
class PictureEffect {
 public:
  virtual ~PictureEffect() = default;
  /// Before the views of a frame; the frame of the same number before is done.
  virtual void begin_frame() {}
  virtual void draw(const PictureDraw& at) = 0;
};

struct PictureEffectKind {
  Effect effect{};
  DrawsOver over = DrawsOver::kDisplay;
  std::function<std::unique_ptr<PictureEffect>(gpu::Device&)> make{};
};

/// In the order in which they draw.
std::span<const PictureEffectKind> picture_effects();

/// One more, as long as it lives: longer than each renderer that draws it. As AddedRow otherwise.
class AddedEffect {
 public:
  AddedEffect(const EffectRow& row, std::function<std::unique_ptr<PictureEffect>(gpu::Device&)> make);
  ~AddedEffect();
  AddedEffect(const AddedEffect&) = delete;
  AddedEffect& operator=(const AddedEffect&) = delete;

  Effect effect() const { return row_.effect(); }

 private:
  AddedRow row_;
};

/// Those of one renderer.
class PictureEffects {
 public:
  explicit PictureEffects(gpu::Device& device) : device_(device) {}

  void begin_frame();
  void draw(const PictureEffectKind& kind, const PictureDraw& at);

 private:
  gpu::Device& device_;
  std::map<Effect, std::unique_ptr<PictureEffect>> made_;
};

}  // namespace phare
