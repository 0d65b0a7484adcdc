// A matrix driving beam from formulas: 12 × 3 segments with soft edges that overlap, so that their sum is smooth.
// Computes: I = share(H, V)·beam(H, V), where `beam` is one driving beam and the shares of all segments, products of
// logistic steps at the borders between columns and rows, sum to 1 inside the field. Source: chosen by hand; widths as
// public descriptions of matrix headlamps have them (1.2° to 3° a segment). Frame: LM-63 type A. Leaves out: dark gaps
// and colour between pixels. Checked by tests/photometry/sample_lamps_test.cpp: the sum passes R149 driving class B.
#include <cmath>

#include "visual/photometry/bench/sample_lamps.h"

namespace phare {
namespace {

// Borders of the columns (deg right) and rows (deg up): narrow in the middle, where oncoming cars are masked.
constexpr double kColumns_deg[kMatrixColumns + 1] = {-15, -11, -8, -5.6, -3.6, -1.8, 0, 1.8, 3.6, 5.6, 8, 11, 15};
constexpr double kRows_deg[kMatrixRows + 1] = {-2.6, -0.3, 1.4, 4.2};
constexpr double kSoft_deg = 0.12;  // of the logistic step at a border: 10 % to 90 % in half a degree
constexpr double kReach_deg = 1.2;  // the file ends this far outside the borders: there e^-10 of the light is left
constexpr double kStep_deg = 0.1;

double step_up(double x, double at) {
  return 1.0 / (1.0 + std::exp(-(x - at) / kSoft_deg));
}

double beam_cd(double h, double v) {
  const auto bell = [&](double peak, double width, double height) {
    const double a = h / width, b = v / height;
    return peak * std::pow(1.0 + a * a + b * b, -2.0);
  };
  return bell(44000, 4.4, 2.6) + bell(19000, 13, 3.6) + bell(3500, 34, 7);
}

}  // namespace

std::vector<SampleLamp> matrix_segments() {
  std::vector<SampleLamp> segments;
  for (int r = 0; r < kMatrixRows; ++r) {
    for (int c = 0; c < kMatrixColumns; ++c) {
      SampleLamp lamp;
      const std::string column = std::to_string(c + 1);
      const std::string name = "matrix/r" + std::to_string(r + 1) + (c < 9 ? "_c0" : "_c") + column + ".ies";
      lamp.file = name;
      lamp.kind = SampleKind::kSegment;
      lamp.description = "Segment of a matrix driving beam, row " + std::to_string(r + 1) +
                         " of 3 from below, column " + std::to_string(c + 1) +
                         " of 12 from the left. All 36 together pass UN R149 driving beam class B";
      IntensityTable& table = lamp.table;
      table.name = name;
      table.version = "IES:LM-63-2019";
      const auto nodes = [](double low, double high) {
        std::vector<double> result;
        const int first = static_cast<int>(std::floor((low - kReach_deg) / kStep_deg));
        const int last = static_cast<int>(std::ceil((high + kReach_deg) / kStep_deg));
        for (int i = first; i <= last; ++i) result.push_back(i / 10.0);
        return result;
      };
      table.first_deg = nodes(kColumns_deg[c], kColumns_deg[c + 1]);
      table.second_deg = nodes(kRows_deg[r], kRows_deg[r + 1]);
      for (std::size_t j = 0; j < table.second_deg.size(); ++j) {
        for (std::size_t i = 0; i < table.first_deg.size(); ++i) {
          const double h = table.first_deg[i], v = table.second_deg[j];
          const double share = (step_up(h, kColumns_deg[c]) - step_up(h, kColumns_deg[c + 1])) *
                               (step_up(v, kRows_deg[r]) - step_up(v, kRows_deg[r + 1]));
          const bool edge = i == 0 || j == 0 || i + 1 == table.first_deg.size() || j + 1 == table.second_deg.size();
          table.candela.push_back(edge ? 0.0 : rounded_cd(share * beam_cd(h, v)));
        }
      }
      table.header = sample_header(lamp.file, lamp.description, table);
      segments.push_back(std::move(lamp));
    }
  }
  return segments;
}

}  // namespace phare
