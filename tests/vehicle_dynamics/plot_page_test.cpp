// unit, process: the page of a batch run: no peak is lost however long the run, the reference is compared at its own
// times, the page stands alone.
#include "vehicle_dynamics/plot_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "batch_files.h"
#include "test_car.h"

namespace phare {
namespace {

const batch::Quantity& pitch_line() {
  for (const batch::Panel& panel : batch::panels())
    if (std::string(panel.lines.front().column) == "pitch_rad") return panel.lines.front();
  throw std::runtime_error("no panel of pitch");
}

TEST(PlotPage, NoPeakIsLostHoweverLongTheRun) {
  batch::Traces traces(true, 0, nullptr);
  constexpr int kRows = 300'000;
  for (int i = 0; i < kRows; ++i) {
    batch::Row row;
    row.time_s = 0.01 * i;
    row.pitch_rad = i == 123'457 ? 0.25 : 1e-3 * std::sin(row.time_s);
    traces.add(row);
  }
  EXPECT_LE(traces.pieces().size(), 2000u);
  EXPECT_GE(traces.pieces().size(), 1000u);
  EXPECT_EQ(traces.pieces().front().from_s, 0.0);
  EXPECT_DOUBLE_EQ(traces.pieces().back().to_s, 0.01 * (kRows - 1));
  float largest = 0.0f;
  for (const auto& piece : traces.pieces()) largest = std::max(largest, piece.largest[pitch_line().at]);
  EXPECT_EQ(largest, 0.25f);
}

// pitch t against t + 0.001 t: largest at the end, a thousandth of the peak; at times between our rows.
TEST(PlotPage, DifferenceFromAReferenceAtItsOwnTimes) {
  std::string csv = "t,pitch,other\n";
  for (int i = 0; i <= 30; ++i) csv += std::to_string(i / 30.0) + "," + std::to_string(1.001 * i / 30.0) + ",1\n";
  const auto reference = batch::read_reference_run(test::written("reference.csv", csv));
  ASSERT_TRUE(reference.ok()) << reference.error().text();
  batch::Traces traces(true, 0, &*reference);
  for (int i = 0; i <= 10; ++i) {
    batch::Row row;
    row.time_s = row.pitch_rad = 0.1 * i;
    traces.add(row);
  }
  const batch::Difference* d = traces.difference(pitch_line());
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(d->count, 31u);
  EXPECT_NEAR(d->largest, 1e-3, 2e-6);  // six decimals in the file
  EXPECT_NEAR(d->at_s, 1.0, 1e-12);
  EXPECT_NEAR(std::sqrt(d->sum_of_squares / 31.0), 1e-3 * std::sqrt(61.0 / 180.0), 2e-6);  // mean of (i/30)^2
  const std::string page = batch::plot_page({.title = "<a>", .facts = {}, .figures = {}, .switched = {}}, traces);
  EXPECT_NE(page.find("&lt;a&gt;"), std::string::npos);
  EXPECT_NE(page.find("Against reference.csv"), std::string::npos);
  EXPECT_NE(page.find("0.10 %"), std::string::npos);
  for (const char* outside : {"http", "<script", "src=", "url("}) EXPECT_EQ(page.find(outside), std::string::npos);
}

TEST(PlotPage, BadReferencesAreRefused) {
  for (const auto& [text, says] : {std::pair{"x,pitch\n0,1\n", "has no column time_s or t"},
                                   {"t,nothing\n0,1\n", "has no column that a page shows"},
                                   {"t,pitch\n0,1\n0,2\n", "time does not rise"}}) {
    const auto read = batch::read_reference_run(test::written("bad.csv", text));
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().text().find(says), std::string::npos) << read.error().text();
  }
}

}  // namespace
}  // namespace phare
