// What lamps do to one pair of eyes: the veil they lay, how much more contrast is then needed, and how it feels.
//
// Veil: the sum over the lamps of E·(CIE 146:2002 general equation, veil.h). Threshold increment: CIE 150 (veil.h).
// Discomfort on de Boer's scale (9 just noticeable, 7 satisfactory, 5 just acceptable, 3 disturbing, 1 unbearable):
// Schmidt-Clausen & Bindels 1974, W = 5 − 2·log10 Σ E/(0.003·(1 + √(L_a/0.04))·θ^0.46), E in lx, θ in minutes of arc,
// L_a in cd/m²; the constants are unconfirmed (from memory, not from print). W runs on past the scale without end
// (2.5e-35 lx at 2°: 72.6); what the scale has no word for is told as its end. Left out: how long a lamp is seen, its
// size and colour, the windscreen. All in float64. Checked by tests/photometry/glare_test.cpp.
#pragma once

#include <optional>
#include <span>

#include "visual/photometry/table/veil.h"

namespace phare {

/// One lamp as an eye has it.
struct GlareSource {
  double illuminance_lx = 0.0;  ///< on the plane through the eye across the line of sight; 0 or more
  double angle_deg = 0.0;       ///< from the line of sight; nearer than 0.1° counts as 0.1°, as in veil.h
};

/// Ends of de Boer's scale: unbearable, just noticeable.
inline constexpr double kDeBoerWorst = 1.0, kDeBoerBest = 9.0;

struct Glare {
  double illuminance_lx = 0.0;  ///< of all sources
  double veil_cdm2 = 0.0;
  double threshold_increment_percent = 0.0;
  std::optional<double> de_boer;  ///< 1 to 9, held to the scale's ends; none where no light comes
};

/// `adaptation_cdm2`: luminance of the scene that the eye is adapted to, above 0; it stands for the background of the
/// threshold increment (CIE 150: 0.05 to 5 cd/m²; beyond that the figure is the same formula carried on) and for L_a.
Glare glare_at_eye(const Viewer& viewer, std::span<const GlareSource> sources, double adaptation_cdm2);

}  // namespace phare
