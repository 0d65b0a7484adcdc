#include "config/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <string>
#include <vector>

#include "config/formats/csv_table.h"

namespace phare {
namespace {

constexpr double kFirst_nm = 360.0, kLast_nm = 830.0, kStep_nm = 5.0;

/// x̄, ȳ, z̄ from 360 nm on, every 5 nm.
constexpr std::array<std::array<double, 3>, 95> kObserver{
    {{0.0001299, 0.0000039, 0.0006061}, {0.0002321, 0.0000070, 0.0010860}, {0.0004149, 0.0000124, 0.0019460},
     {0.0007416, 0.0000220, 0.0034860}, {0.0013680, 0.0000390, 0.0064500}, {0.0022360, 0.0000640, 0.0105500},
     {0.0042430, 0.0001200, 0.0200500}, {0.0076500, 0.0002170, 0.0362100}, {0.0143100, 0.0003960, 0.0678500},
     {0.0231900, 0.0006400, 0.1102000}, {0.0435100, 0.0012100, 0.2074000}, {0.0776300, 0.0021800, 0.3713000},
     {0.1343800, 0.0040000, 0.6456000}, {0.2147700, 0.0073000, 1.0390501}, {0.2839000, 0.0116000, 1.3856000},
     {0.3285000, 0.0168400, 1.6229600}, {0.3482800, 0.0230000, 1.7470600}, {0.3480600, 0.0298000, 1.7826000},
     {0.3362000, 0.0380000, 1.7721100}, {0.3187000, 0.0480000, 1.7441000}, {0.2908000, 0.0600000, 1.6692000},
     {0.2511000, 0.0739000, 1.5281000}, {0.1953600, 0.0909800, 1.2876400}, {0.1421000, 0.1126000, 1.0419000},
     {0.0956400, 0.1390200, 0.8129501}, {0.0579500, 0.1693000, 0.6162000}, {0.0320100, 0.2080200, 0.4651800},
     {0.0147000, 0.2586000, 0.3533000}, {0.0049000, 0.3230000, 0.2720000}, {0.0024000, 0.4073000, 0.2123000},
     {0.0093000, 0.5030000, 0.1582000}, {0.0291000, 0.6082000, 0.1117000}, {0.0632700, 0.7100000, 0.0782500},
     {0.1096000, 0.7932000, 0.0572500}, {0.1655000, 0.8620000, 0.0421600}, {0.2257499, 0.9148501, 0.0298400},
     {0.2904000, 0.9540000, 0.0203000}, {0.3597000, 0.9803000, 0.0134000}, {0.4334499, 0.9949501, 0.0087500},
     {0.5120501, 1.0000000, 0.0057500}, {0.5945000, 0.9950000, 0.0039000}, {0.6784000, 0.9786000, 0.0027500},
     {0.7621000, 0.9520000, 0.0021000}, {0.8425000, 0.9154000, 0.0018000}, {0.9163000, 0.8700000, 0.0016500},
     {0.9786000, 0.8163000, 0.0014000}, {1.0263000, 0.7570000, 0.0011000}, {1.0567000, 0.6949000, 0.0010000},
     {1.0622000, 0.6310000, 0.0008000}, {1.0456000, 0.5668000, 0.0006000}, {1.0026000, 0.5030000, 0.0003400},
     {0.9384000, 0.4412000, 0.0002400}, {0.8544499, 0.3810000, 0.0001900}, {0.7514000, 0.3210000, 0.0001000},
     {0.6424000, 0.2650000, 0.0000500}, {0.5419000, 0.2170000, 0.0000300}, {0.4479000, 0.1750000, 0.0000200},
     {0.3608000, 0.1382000, 0.0000100}, {0.2835000, 0.1070000, 0.0000000}, {0.2187000, 0.0816000, 0.0000000},
     {0.1649000, 0.0610000, 0.0000000}, {0.1212000, 0.0445800, 0.0000000}, {0.0874000, 0.0320000, 0.0000000},
     {0.0636000, 0.0232000, 0.0000000}, {0.0467700, 0.0170000, 0.0000000}, {0.0329000, 0.0119200, 0.0000000},
     {0.0227000, 0.0082100, 0.0000000}, {0.0158400, 0.0057230, 0.0000000}, {0.0113592, 0.0041020, 0.0000000},
     {0.0081109, 0.0029290, 0.0000000}, {0.0057903, 0.0020910, 0.0000000}, {0.0041095, 0.0014840, 0.0000000},
     {0.0028993, 0.0010470, 0.0000000}, {0.0020492, 0.0007400, 0.0000000}, {0.0014400, 0.0005200, 0.0000000},
     {0.0009999, 0.0003611, 0.0000000}, {0.0006901, 0.0002492, 0.0000000}, {0.0004760, 0.0001719, 0.0000000},
     {0.0003323, 0.0001200, 0.0000000}, {0.0002348, 0.0000848, 0.0000000}, {0.0001662, 0.0000600, 0.0000000},
     {0.0001174, 0.0000424, 0.0000000}, {0.0000831, 0.0000300, 0.0000000}, {0.0000587, 0.0000212, 0.0000000},
     {0.0000415, 0.0000150, 0.0000000}, {0.0000294, 0.0000106, 0.0000000}, {0.0000207, 0.0000075, 0.0000000},
     {0.0000146, 0.0000053, 0.0000000}, {0.0000103, 0.0000037, 0.0000000}, {0.0000072, 0.0000026, 0.0000000},
     {0.0000051, 0.0000018, 0.0000000}, {0.0000036, 0.0000013, 0.0000000}, {0.0000025, 0.0000009, 0.0000000},
     {0.0000018, 0.0000006, 0.0000000}, {0.0000013, 0.0000005, 0.0000000}}};
static_assert(kFirst_nm + kStep_nm * (kObserver.size() - 1) == kLast_nm);

/// Through the four rows around, which is what is off of 5 nm in narrow lines; never below 0.
glm::dvec3 observer(double wavelength_nm) {
  const double x = (wavelength_nm - kFirst_nm) / kStep_nm;
  const auto first = static_cast<std::size_t>(std::clamp(std::floor(x) - 1.0, 0.0, kObserver.size() - 4.0));
  const double u = x - static_cast<double>(first);
  const std::array<double, 4> weights{-(u - 1.0) * (u - 2.0) * (u - 3.0) / 6.0, u * (u - 2.0) * (u - 3.0) / 2.0,
                                      -u * (u - 1.0) * (u - 3.0) / 2.0, u * (u - 1.0) * (u - 2.0) / 6.0};
  glm::dvec3 sum{0.0};
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) sum[k] += weights[i] * kObserver[first + i][static_cast<std::size_t>(k)];
  return glm::max(sum, glm::dvec3(0.0));
}

}  // namespace

glm::dvec3 xyz_of_spectrum(std::span<const SpectrumRow> rows) {
  glm::dvec3 xyz{0.0};
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const SpectrumRow &from = rows[i], &to = rows[i + 1];
    const double begin_nm = std::max(from.wavelength_nm, kFirst_nm), end_nm = std::min(to.wavelength_nm, kLast_nm);
    if (!(end_nm > begin_nm)) continue;
    const auto at = [&](double nm) {
      const double part = (nm - from.wavelength_nm) / (to.wavelength_nm - from.wavelength_nm);
      return (from.power + (to.power - from.power) * part) * observer(nm);
    };
    // Simpson's rule over pieces of 1 nm at most.
    const double pieces = std::ceil(end_nm - begin_nm), width_nm = (end_nm - begin_nm) / pieces;
    for (double piece = 0.0; piece < pieces; ++piece) {
      const double nm = begin_nm + piece * width_nm;
      xyz += (at(nm) + 4.0 * at(nm + 0.5 * width_nm) + at(nm + width_nm)) * (width_nm / 6.0);
    }
  }
  return xyz;
}

Result<glm::dvec2> read_spectrum_xy(const std::filesystem::path& file) {
  const auto table = CsvTable::read(file);
  if (!table) return table.error();
  const auto wavelength = table->find({"wavelength_nm"}), power = table->find({"power"});
  if (!wavelength || !power)
    return Error{file.string() + ":" + std::to_string(table->header_line()),
                 std::string("expected the columns wavelength_nm and power; there is no ") +
                     (wavelength ? "power" : "wavelength_nm")};
  std::vector<SpectrumRow> rows;
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const SpectrumRow row{table->at(i, *wavelength), table->at(i, *power)};
    if (row.power < 0.0) return Error{table->place(i), "power is negative"};
    if (!rows.empty() && !(row.wavelength_nm > rows.back().wavelength_nm))
      return Error{table->place(i), "wavelength_nm does not rise"};
    if (!rows.empty() && row.wavelength_nm - rows.back().wavelength_nm > kWidestStep_nm)
      return Error{table->place(i), "wavelength_nm is more than 10 nm beyond the row before"};
    rows.push_back(row);
  }
  if (rows.size() < 2)
    return Error{file.string() + ":" + std::to_string(table->header_line()),
                 "expected two rows or more below this line, between which power is linear"};
  const glm::dvec3 xyz = xyz_of_spectrum(rows);
  const double sum = xyz.x + xyz.y + xyz.z;
  if (!(sum > 0.0)) return Error{file.string(), "has no power within 360 to 830 nm"};
  // As of chromaticity_xy: bright enough in y to divide by it.
  if (!(xyz.y >= 0.01 * sum)) return Error{file.string(), "is next to no light: its y is below 0.01"};
  return glm::dvec2{xyz.x / sum, xyz.y / sum};
}

}  // namespace phare
