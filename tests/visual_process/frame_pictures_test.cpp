// The pictures of a drive's frames: what is made of them does not depend on who writes them.
#include "visual/process/frame_pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/photometry/photometry_test_files.h"

namespace phare {
namespace {

Image8 stripes(int number) {
  Image8 image{640, 360, std::vector<std::uint8_t>(std::size_t{640} * 360 * 4, 255)};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    image.rgba[i] = static_cast<std::uint8_t>(i / 4 * 7 + static_cast<std::size_t>(number) * 13);
  return image;
}

void expect_written(const std::vector<Status>& pictures) {
  for (const Status& written : pictures) EXPECT_TRUE(written);
}

TEST(FramePictures, WrittenBesideTheDrawingTheyAreThoseWrittenAtOnce) {
  const test::TemporaryFolder folder;
  std::array<FramePictures, 2> ways;
  ways[1].write_beside();
  constexpr int kFrames = 40;
  for (int i = 0; i < kFrames; ++i)
    for (std::size_t way = 0; way < 2; ++way)
      expect_written(ways[way].keep(folder.path() / (std::to_string(way) + "-" + std::to_string(i) + ".png"),
                                    stripes(i), std::to_string(i)));
  for (FramePictures& way : ways) {
    expect_written(way.finish());
    EXPECT_EQ(way.kept(), std::uint64_t{kFrames});
    EXPECT_EQ(way.hash(), ways[0].hash());
    const std::vector<LabelledImage> thumbnails = way.thumbnails(16), expected = ways[0].thumbnails(16);
    ASSERT_EQ(thumbnails.size(), 16u);
    for (std::size_t i = 0; i < thumbnails.size(); ++i) {
      EXPECT_EQ(thumbnails[i].label, expected[i].label);
      EXPECT_EQ(thumbnails[i].image.rgba, expected[i].image.rgba);
    }
  }
  for (const int i : {0, kFrames - 1}) {
    const std::string at_once = test::content_of(folder.path() / ("0-" + std::to_string(i) + ".png"));
    EXPECT_GT(at_once.size(), 1000u);
    EXPECT_EQ(test::content_of(folder.path() / ("1-" + std::to_string(i) + ".png")), at_once);
  }
}

// The same pictures in another order are another drive.
TEST(FramePictures, TheHashIsOfTheirOrderToo) {
  const test::TemporaryFolder folder;
  std::array<FramePictures, 2> orders;
  for (const int first : {0, 1}) {
    FramePictures& pictures = orders[static_cast<std::size_t>(first)];
    pictures.write_beside();
    for (const int number : {first, 1 - first})
      expect_written(pictures.keep(folder.path() / std::to_string(number), stripes(number), ""));
    expect_written(pictures.finish());
  }
  EXPECT_NE(orders[0].hash(), orders[1].hash());
}

TEST(FramePictures, OneThatTheDiskDoesNotTakeIsTold) {
  const test::TemporaryFolder folder;
  for (const bool beside : {false, true}) {
    FramePictures pictures;
    if (beside) pictures.write_beside();
    std::vector<Status> told = pictures.keep(folder.path() / "no folder" / "0.png", stripes(0), "");
    for (Status& of_the_rest : pictures.finish()) told.push_back(std::move(of_the_rest));
    ASSERT_EQ(told.size(), 1u);
    EXPECT_FALSE(told[0]);
  }
}

}  // namespace
}  // namespace phare
