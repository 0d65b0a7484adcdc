#include "visual/picture_effect.h"

#include <utility>
#include <vector>

#include "visual/passes/windscreen.h"

namespace phare {
namespace {

template <typename Pass>
std::unique_ptr<PictureEffect> make(gpu::Device& device) {
  return std::make_unique<Pass>(device);
}

std::vector<PictureEffectKind>& kinds() {
  static std::vector<PictureEffectKind> kinds{{Effect::kWindscreen, DrawsOver::kLuminance, make<WindscreenPass>}};
  return kinds;
}

}  // namespace

std::span<const PictureEffectKind> picture_effects() {
  return kinds();
}

AddedEffect::AddedEffect(const EffectRow& row, std::function<std::unique_ptr<PictureEffect>(gpu::Device&)> make)
    : row_(row) {
  kinds().push_back({row_.effect(), row.over_luminance ? DrawsOver::kLuminance : DrawsOver::kDisplay, std::move(make)});
}

AddedEffect::~AddedEffect() {
  kinds().pop_back();
}

void PictureEffects::begin_frame() {
  for (const auto& [effect, pass] : made_) pass->begin_frame();
}

void PictureEffects::draw(const PictureEffectKind& kind, const PictureDraw& at) {
  std::unique_ptr<PictureEffect>& pass = made_[kind.effect];
  if (!pass) pass = kind.make(device_);
  pass->draw(at);
}

}  // namespace phare
