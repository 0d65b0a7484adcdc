#include "visual/frame_facts.h"

namespace phare {

EffectFacts facts_of(const FrameInput& input, std::size_t lit_lamps, bool software_device) {
  return {.lit_lamps = lit_lamps,
          .software_device = software_device,
          .hdr_wanted = input.want_hdr,
          .false_colour = input.view == View::kFalseColour,
          .overlay_lines = input.overlay.size() + input.instruments.size() + input.panel.rows.size() +
                           (input.panel.title.empty() ? 0u : 1u)};
}

}  // namespace phare
