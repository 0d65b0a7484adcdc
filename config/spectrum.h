// The colour of a light by its spectrum: a CSV file of power over wavelength to CIE 1931 x, y.
//
// X = Σ ∫ S(λ)·x̄(λ) dλ and so on with the 2° colour matching functions of CIE 015 at 5 nm (360 to 830 nm, 7 decimals),
// cubic between them; the spectrum is straight between its rows and 0 beyond them. Against the functions at 1 nm x and
// y are off by less than 2e-6 for smooth light (black bodies from 1700 K on) and by 2.1e-4 at most for a line of 2 to
// 25 nm. Left out: what the wavelengths' own bandwidth widens. Checked by tests/tools/spectrum_test.cpp.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "config/base/result.h"

namespace phare {

struct SpectrumRow {
  double wavelength_nm = 0.0;
  double power = 0.0;  ///< for each nm, in any unit
};

/// Wider steps say too little of a light. CIE's own tables have 5 and 10 nm.
inline constexpr double kWidestStep_nm = 10.0;

/// X, Y, Z in the unit of power times nm. `rows`: by rising wavelength.
glm::dvec3 xyz_of_spectrum(std::span<const SpectrumRow> rows);

/// x, y of a file with the columns wavelength_nm and power. Error: file:line and reason.
Result<glm::dvec2> read_spectrum_xy(const std::filesystem::path& file);

}  // namespace phare
