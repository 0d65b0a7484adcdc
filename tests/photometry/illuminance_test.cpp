// Illuminance by hand, and the points and angles files of `phare measure`.
#include "visual/photometry/table/illuminance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "photometry_test_files.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/readers/points_file.h"

namespace phare {
namespace {

/// 1,000 cd everywhere in a ±90° square.
IntensityTable constant_table() {
  IntensityTable table;
  table.first_deg = {-90, 90};
  table.second_deg = {-90, 90};
  table.candela.assign(4, 1000.0);
  return table;
}

TEST(Illuminance, DistanceLawByHand) {
  const IntensityTable table = constant_table();
  const glm::dvec3 lamp{0, 0, 3};
  const glm::dmat3 ahead{1.0};
  EXPECT_DOUBLE_EQ(illuminance_lx(lamp, ahead, table, 1.0, {5, 0, 3}, {-1, 0, 0}), 40.0);
  EXPECT_DOUBLE_EQ(illuminance_lx(lamp, ahead, table, 0.25, {5, 0, 3}, {-1, 0, 0}), 10.0);
  EXPECT_NEAR(illuminance_lx(lamp, ahead, table, 1.0, {4, 0, 0}, {0, 0, 1}), 1000.0 * 0.6 / 25.0, 1e-12);  // 3-4-5
  EXPECT_EQ(illuminance_lx(lamp, ahead, table, 1.0, {5, 0, 3}, {1, 0, 0}), 0.0);                           // faces away
  EXPECT_EQ(illuminance_lx(lamp, ahead, table, 1.0, {5, 0, 3}, {0, 1, 0}), 0.0);                           // edge on
  EXPECT_EQ(illuminance_lx(lamp, ahead, table, 1.0, lamp, {-1, 0, 0}), 0.0);       // in the lamp
  EXPECT_EQ(illuminance_lx(lamp, ahead, table, 1.0, {-5, 0, 3}, {1, 0, 0}), 0.0);  // behind it
}

TEST(Illuminance, SumsByLamp) {
  const IntensityTable table = constant_table();
  const std::vector<PlacedSource> sources{{&table, {0, 0, 0}, glm::dmat3{1.0}, 1.0, 0},
                                          {&table, {0, 0, 0}, glm::dmat3{1.0}, 0.5, 0},
                                          {&table, {5, 0, 0}, glm::dmat3{1.0}, 1.0, 1}};
  const Illuminance e = illuminance_lx(sources, 2, {10, 0, 0}, {-1, 0, 0});
  EXPECT_DOUBLE_EQ(e.lamps_lx[0], 15.0);
  EXPECT_DOUBLE_EQ(e.lamps_lx[1], 40.0);
  EXPECT_DOUBLE_EQ(e.total_lx, 55.0);
}

// yaw > 0 left, pitch > 0 up, roll > 0 right side down.
TEST(AimRotation, Signs) {
  const double a = 0.1;
  EXPECT_GT(aim_rotation(a, 0, 0)[0].y, 0.0);
  EXPECT_GT(aim_rotation(0, a, 0)[0].z, 0.0);
  EXPECT_GT(aim_rotation(0, 0, a)[1].z, 0.0);  // the left rises
  const glm::dmat3 r = aim_rotation(0.3, -0.2, 0.7);
  EXPECT_NEAR(glm::distance(glm::cross(r[0], r[1]), r[2]), 0.0, 1e-15);
  EXPECT_NEAR(glm::length(r[1]), 1.0, 1e-15);
}

TEST(PointsFile, KeepsColumnsAndAddsItsOwn) {
  const auto path = test::temporary_file("points.csv",
                                         "\xEF\xBB\xBFname,x_m,y_m,z_m,nx,ny,nz,note\r\n\r\n# a remark\r\n\"a, "
                                         "b\",1,2,3,0,0,-2,\r\nq,1e1,+2,3.5,1,1,0,x\r\n");
  const auto points = read_points(path);
  ASSERT_TRUE(points.ok()) << points.error().text();
  ASSERT_EQ(points->rows.size(), 2u);
  EXPECT_EQ(points->rows[0].position_m, (glm::dvec3{1, 2, 3}));
  EXPECT_EQ(points->rows[0].normal, (glm::dvec3{0, 0, -1}));
  EXPECT_EQ(points->rows[0].line, 4u);
  EXPECT_NEAR(glm::length(points->rows[1].normal), 1.0, 1e-15);

  const std::vector<Illuminance> results{{0.1, {0.1, 0.0}}, {3.0, {1.0, 2.0}}};
  const auto out = path.parent_path() / "out.csv";
  ASSERT_TRUE(write_illuminance(out, *points, 2, results).ok());
  EXPECT_EQ(test::content_of(out),
            "name,x_m,y_m,z_m,nx,ny,nz,note,illuminance_lx,illuminance_lx_1,illuminance_lx_2\n"
            "\"a, b\",1,2,3,0,0,-2,,0.10000000000000001,0.10000000000000001,0\n"
            "q,1e1,+2,3.5,1,1,0,x,3,1,2\n");
  EXPECT_FALSE(write_illuminance("/nowhere/out.csv", *points, 2, results).ok());
}

TEST(PointsFile, OfNoPointHasAllColumns) {
  const PointsFile none{"x_m,y_m,z_m,nx,ny,nz", {}};
  const auto out = test::temporary_file("none.csv", "");
  ASSERT_TRUE(write_illuminance(out, none, 2, {}, std::vector<HiddenBy>{}).ok());
  EXPECT_EQ(test::content_of(out),
            "x_m,y_m,z_m,nx,ny,nz,illuminance_lx,illuminance_lx_1,illuminance_lx_2,hidden_by_1,hidden_by_2\n");
}

TEST(PointsFile, RefusalsSayWhereAndWhy) {
  const auto reason = [](const std::string& text) {
    const auto points = read_points(test::temporary_file("p.csv", text));
    return points.ok() ? "read" : points.error().text().substr(points.error().text().find("p.csv"));
  };
  const std::string head = "x_m,y_m,z_m,nx,ny,nz\n";
  EXPECT_EQ(reason(""), "p.csv: is empty: expected a header line with x_m …");
  EXPECT_EQ(reason("x_m,y_m,nx,ny,nz\n"), "p.csv:1: column z_m is missing");
  EXPECT_EQ(reason("x_m,x_m,y_m,z_m,nx,ny,nz\n"), "p.csv:1: column x_m is there twice");
  EXPECT_EQ(reason(head + "1,2,3,0,0,1\n1,2,nan,0,0,1\n"), "p.csv:3: z_m is not a finite number: \"nan\"");
  EXPECT_EQ(reason(head + "1,2,3,0,0,0\n"), "p.csv:2: the normal nx, ny, nz is zero");
  EXPECT_EQ(reason(head + "1,2,3,0,0,1e-300\n"), "read") << "of any length but 0";
  EXPECT_EQ(reason(head + "1,-1e8,3,0,0,1\n"), "p.csv:2: the point is not within 1e8 m of the origin");
  EXPECT_EQ(reason(head + "1e200,2,3,0,0,1\n"), "p.csv:2: the point is not within 1e8 m of the origin");
  EXPECT_EQ(reason(head + "1,2,3,0,0\n"), "p.csv:2: expected 6 columns, got 5");
  EXPECT_EQ(reason(head + "1,2,,0,0,1\n"), "p.csv:2: z_m is not a finite number: \"\"");
  EXPECT_EQ(reason("x_m,y_m,z_m,nx,ny,nz,illuminance_lx\n"),
            "p.csv:1: column illuminance_lx is there already; the result would have it twice");
  EXPECT_FALSE(read_points("/nowhere.csv").ok());
}

TEST(AnglesFile, GivesTheTableValues) {
  const auto path = test::temporary_file("a.csv", "h_deg,v_deg\n0,0\n91,0\n");
  const auto angles = read_angles(path);
  ASSERT_TRUE(angles.ok()) << angles.error().text();
  const auto out = path.parent_path() / "i.csv";
  ASSERT_TRUE(write_intensity(out, *angles, constant_table()).ok());
  EXPECT_EQ(test::content_of(out), "h_deg,v_deg,intensity_cd\n0,0,1000\n91,0,0\n");
}

// C goes round, so an angle outside 0 to 360 is that of the same plane.
TEST(Angles, OfTypeCGoRound) {
  IntensityTable table;
  table.type = PhotometricType::kC;
  table.first_deg = {0, 180, 350, 360};
  table.second_deg = {0, 90};
  table.candela = {5, 5, 5, 5, 10, 20, 40, 10};
  for (const auto& [c_deg, same_deg] : {std::pair{-10.0, 350.0}, {370.0, 10.0}, {-360.0, 0.0}, {710.0, 350.0}})
    EXPECT_EQ(intensity_of_row_cd(table, {c_deg, 90.0}), intensity_of_row_cd(table, {same_deg, 90.0})) << c_deg;
  EXPECT_EQ(intensity_of_row_cd(table, {-10.0, 90.0}), 40.0);
}

}  // namespace
}  // namespace phare
