#include "config/light_colour.h"

#include <vector>

#include "config/base/paths.h"
#include "config/formats/toml_table.h"
#include "config/rig.h"
#include "config/spectrum.h"

namespace phare {

LightColour read_light_colour(TomlTable& table) {
  LightColour colour;
  // Asked for in any case, so that the key is known to who mistypes it.
  const double kelvin = table.number_or("colour_temperature_k", 0.0, kCoolestSource_k, kHottestSource_k);
  if (table.has("colour_temperature_k")) colour.colour_temperature_k = kelvin;
  if (table.has("chromaticity_xy")) {
    const std::vector<double> xy = table.numbers("chromaticity_xy", 2);
    if (colour.colour_temperature_k)
      table.fail("chromaticity_xy", "a light has a colour temperature or a chromaticity, not both");
    // Inside the triangle that holds every real colour, and bright enough in y to divide by it.
    if (xy.size() == 2 && !(xy[0] >= 0.0 && xy[1] >= 0.01 && xy[0] + xy[1] <= 1.0))
      table.fail("chromaticity_xy", "x and y of CIE 1931: x >= 0, y >= 0.01, x + y <= 1");
    if (xy.size() == 2) colour.chromaticity_xy = glm::dvec2{xy[0], xy[1]};
  }
  if (table.has("spectrum")) {
    colour.spectrum = resolve_path(table.text("spectrum"), table.file());
    for (const char* other : {"colour_temperature_k", "chromaticity_xy"})
      if (table.has(other))
        table.fail("spectrum", "a light has one of spectrum, colour_temperature_k, chromaticity_xy");
    const auto xy = read_spectrum_xy(colour.spectrum);
    if (xy)
      colour.chromaticity_xy = *xy;
    else
      table.fail("spectrum", xy.error().text());
  }
  return colour;
}

}  // namespace phare
