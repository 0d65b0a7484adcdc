#include "visual/frame_facts.h"

namespace phare {

EffectFacts facts_of(const ViewInput& view, std::size_t lit_lamps, std::size_t casters, std::size_t lines,
                     bool software_device) {
  return {.lit_lamps = lit_lamps,
          .casters = casters,
          .software_device = software_device,
          .hdr_wanted = view.want_hdr,
          .false_colour = view.view == View::kFalseColour,
          .overlay_lines = lines};
}

std::size_t text_lines(const FrameInput& input) {
  return input.overlay.size() + input.instruments.size() + input.panel.rows.size() +
         (input.panel.title.empty() ? 0u : 1u);
}

}  // namespace phare
