// unit: how large a lamp is as seen from ahead, by the sizes in its file; the axes worked out by hand from the formats'
// own words (visual/photometry/table/opening.h).
#include "visual/photometry/table/opening.h"

#include <gtest/gtest.h>

namespace phare {
namespace {

IntensityTable of_sizes(PhotometricType type, double width_m, double length_m, double height_m,
                        const char* format = "LM-63", GammaAxis axis = GammaAxis::kGamma0) {
  IntensityTable table;
  table.type = type;
  table.axis = axis;
  table.header.format = format;
  table.header.width_m = width_m, table.header.length_m = length_m, table.header.height_m = height_m;
  return table;
}

constexpr auto kA = PhotometricType::kA, kB = PhotometricType::kB, kC = PhotometricType::kC;
constexpr LampOpening kBox{0.2, 0.1, false}, kEllipse{0.2, 0.1, true}, kDisc{0.2, 0.2, true};

TEST(LampOpening, IsWhatOneSeesFromAheadOfTheSizesOfLm63) {
  EXPECT_EQ(stated_opening(of_sizes(kA, 0.2, 0.0, 0.1)), kBox);
  EXPECT_EQ(stated_opening(of_sizes(kA, 0.2, 0.3, 0.1)), kBox);    // luminous along the axis too
  EXPECT_EQ(stated_opening(of_sizes(kA, 0.2, 0.1, 0.0)), kBox);    // its face as width and length
  EXPECT_EQ(stated_opening(of_sizes(kA, -0.2, 0.0, -0.1)), kEllipse);  // "vertical ellipse facing photometric horizontal"
  EXPECT_EQ(stated_opening(of_sizes(kB, 0.2, 0.1, 0.0)), kBox);
  EXPECT_EQ(stated_opening(of_sizes(kB, 0.2, 0.1, 0.3)), kBox);
  EXPECT_EQ(stated_opening(of_sizes(kC, 0.1, 0.2, 0.0)), kBox);  // length along C 0, to the right
  EXPECT_EQ(stated_opening(of_sizes(kC, -0.1, -0.2, 0.3)), kEllipse);
  EXPECT_EQ(stated_opening(of_sizes(kC, 0.2, 0.3, 0.1, "LM-63", GammaAxis::kGamma90)), kBox);
  for (const PhotometricType type : {kA, kB, kC}) {
    EXPECT_EQ(stated_opening(of_sizes(type, -0.2, -0.2, 0.0)), kDisc);
    EXPECT_EQ(stated_opening(of_sizes(type, -0.2, 0.0, 0.0)), kDisc);  // as editions before 2002 have it
  }
  IntensityTable turned = of_sizes(kC, 0.2, 0.1, 0.0);
  turned.header.read_c0_deg = 90.0;  // C 0 up
  EXPECT_EQ(stated_opening(turned), kBox);
}

TEST(LampOpening, IsWhatOneSeesFromAheadOfTheSizesOfEulumdat) {
  EXPECT_EQ(stated_opening(of_sizes(kC, 0.2, 0.1, 0.0, "EULUMDAT")), kBox);  // length along C 90, up
  EXPECT_EQ(stated_opening(of_sizes(kC, 0.0, 0.2, 0.0, "EULUMDAT")), kDisc);
  EXPECT_EQ(stated_opening(of_sizes(kC, 0.3, 0.2, 0.1, "EULUMDAT", GammaAxis::kGamma90)), kBox);
}

TEST(LampOpening, IsToldToBeChosenWhereAFileStatesNone) {
  EXPECT_EQ(stated_opening(of_sizes(kA, 0.0, 0.0, 0.0)), std::nullopt);
  EXPECT_EQ(stated_opening(of_sizes(kA, 70.0, 0.0, 40.0)), std::nullopt);  // millimetres as metres
  EXPECT_EQ(opening_text(of_sizes(kA, 0.0, 0.0, 0.0)), "round, 70 mm, chosen: the file states none");
  EXPECT_EQ(opening_text(of_sizes(kA, 70.0, 0.0, 40.0)), "round, 70 mm, chosen: the file's 70 m are more than 2 m");
  EXPECT_EQ(opening_text(of_sizes(kA, 0.06, 0.0, 0.04)), "60 x 40 mm, by the file");
  EXPECT_EQ(opening_text(of_sizes(kA, -0.06, 0.0, -0.04)), "elliptic, 60 x 40 mm, by the file");
}

}  // namespace
}  // namespace phare
