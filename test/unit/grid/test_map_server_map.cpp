#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "support/folder_test.hpp"
#include "support/real_data.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_map_server_map {
namespace {

class MapServerMap : public test::FolderTest {
 protected:
  std::string write(const std::string& name, const std::string& content) { return scratch_.write(name, content); }

  std::string writeImage(const std::string& name, const cv::Mat& image) {
    cv::imwrite(in(name), image);
    return in(name);
  }

  std::string writeYaml(const std::string& image, const std::string& more = "negate: 0\n") {
    return write("map.yaml", "image: " + image + "\nresolution: 0.5\norigin: [1.0, 2.0, 3.14]\n" +
                                 "occupied_thresh: 0.65\nfree_thresh: 0.196\n" + more);
  }

  /// What reading says about a file that it refuses; empty when it does not.
  static std::string refusal(const std::string& yaml_path) {
    return test::refusalOf<MapFileError>([&] { readMapServerMap(yaml_path); });
  }
};

const std::string kImage("P5\n# a comment\n3 2\n255\n\xFE\xCD\x00\x00\xCE\xFF", 29);

TEST_F(MapServerMap, ReadsTheThreeStatesWithTheFirstLineOnTop) {
  write("map.pgm", kImage);
  const OccupancyGrid grid = readMapServerMap(writeYaml("map.pgm"));
  ASSERT_EQ(grid.columns(), 3);
  ASSERT_EQ(grid.rows(), 2);
  EXPECT_EQ(grid.at({0, 1}), Cell::kFree);      // 254
  EXPECT_EQ(grid.at({1, 1}), Cell::kUnknown);   // 205: 0.19608 is just above 0.196
  EXPECT_EQ(grid.at({2, 1}), Cell::kOccupied);  // 0
  EXPECT_EQ(grid.at({1, 0}), Cell::kFree);      // 206: 0.19216
  EXPECT_EQ(grid.resolution(), 0.5);
  EXPECT_EQ(grid.origin().yaw, 3.14);
}

TEST_F(MapServerMap, ReplacesTheFreeThreshold) {
  write("map.pgm", kImage);
  EXPECT_EQ(readMapServerMap(writeYaml("map.pgm"), 0.19).at({1, 0}), Cell::kUnknown);
}

TEST_F(MapServerMap, ClosesWhatWasNeverMapped) {
  write("map.pgm", kImage);
  const std::string yaml = writeYaml("map.pgm");
  EXPECT_EQ(readClosedMap(yaml).at({1, 1}), Cell::kOccupied);
  EXPECT_EQ(readClosedMap(yaml).at({1, 0}), Cell::kFree);
  EXPECT_EQ(readClosedMap(yaml + "=0.19").at({1, 0}), Cell::kOccupied);
  for (const std::string threshold : {"2", "-1"}) {
    EXPECT_EQ(
        test::refusalOf<MapFileError>([&] { readClosedMap(yaml + "=" + threshold); }),
        "the map " + yaml + "=" + threshold + " has free_thresh '" + threshold + "', expected a number in [0, 1]");
  }
}

TEST_F(MapServerMap, NegatesAndTakesAnAbsolutePath) {
  const std::string image = write("map.pgm", kImage);
  const OccupancyGrid grid = readMapServerMap(writeYaml(image, "negate: 1\nmode: trinary\n"));
  EXPECT_EQ(grid.at({0, 1}), Cell::kOccupied);
  EXPECT_EQ(grid.at({2, 1}), Cell::kFree);
}

TEST_F(MapServerMap, AveragesTheChannelsOfAColourImage) {
  cv::Mat image(1, 3, CV_8UC3);
  image.at<cv::Vec3b>(0, 0) = {255, 255, 255};
  image.at<cv::Vec3b>(0, 1) = {0, 0, 255};   // mean 85, p = 0.667
  image.at<cv::Vec3b>(0, 2) = {0, 90, 180};  // mean 90, p = 0.647
  writeImage("map.png", image);
  const OccupancyGrid grid = readMapServerMap(writeYaml("map.png"));
  EXPECT_EQ(grid.at({0, 0}), Cell::kFree);
  EXPECT_EQ(grid.at({1, 0}), Cell::kOccupied);
  EXPECT_EQ(grid.at({2, 0}), Cell::kUnknown);
}

TEST_F(MapServerMap, LeavesAlphaOutWithModeScale) {
  cv::Mat image(1, 2, CV_8UC4);
  image.at<cv::Vec4b>(0, 0) = {255, 255, 255, 255};
  image.at<cv::Vec4b>(0, 1) = {60, 60, 60, 255};  // mean of the colours 60, p = 0.765; with alpha 108.75, p = 0.574
  writeImage("map.png", image);
  EXPECT_EQ(readMapServerMap(writeYaml("map.png", "negate: 0\nmode: trinary\n")).at({1, 0}), Cell::kUnknown);
  EXPECT_EQ(readMapServerMap(writeYaml("map.png", "negate: 0\nmode: scale\n")).at({1, 0}), Cell::kOccupied);
}

TEST_F(MapServerMap, StretchesTheValuesOfABinaryImageUpToItsLargest) {
  write("map.pgm", std::string("P5\n4 1\n100\n\x64\x51\x50\x23", 15));  // 81 % is 206 of 255, 80 % 204, 35 % 89
  const OccupancyGrid grid = readMapServerMap(writeYaml("map.pgm"));
  EXPECT_EQ(grid.at({0, 0}), Cell::kFree);
  EXPECT_EQ(grid.at({1, 0}), Cell::kFree);
  EXPECT_EQ(grid.at({2, 0}), Cell::kUnknown);
  EXPECT_EQ(grid.at({3, 0}), Cell::kOccupied);
}

TEST_F(MapServerMap, StretchesValuesOfTwoBytes) {
  write("map.pgm", std::string("P5\n2 1\n1000\n\x03\xe8\x00\x00", 16));  // 1000 and 0
  write("text.pgm", "P2\n2 1\n1000\n1000 0\n");
  for (const char* image : {"map.pgm", "text.pgm"}) {
    const OccupancyGrid grid = readMapServerMap(writeYaml(image));
    EXPECT_EQ(grid.at({0, 0}), Cell::kFree) << image;
    EXPECT_EQ(grid.at({1, 0}), Cell::kOccupied) << image;
  }
}

TEST_F(MapServerMap, ReadsAJpeg) {
  writeImage("map.jpg", cv::Mat(40, 60, CV_8UC1, cv::Scalar(254.0)));
  const OccupancyGrid grid = readMapServerMap(writeYaml("map.jpg"));
  EXPECT_EQ(grid.columns(), 60);
  EXPECT_EQ(grid.rows(), 40);
  EXPECT_EQ(grid.at({59, 39}), Cell::kFree);
}

TEST_F(MapServerMap, NamesTheImageThatLiesBesideAMapFromAnotherComputer) {
  write("map.pgm", kImage);
  const std::string why = refusal(writeYaml("/home/somebody/maps/map.pgm"));
  EXPECT_NE(why.find("; beside the map there is one of that name: write image: map.pgm"), std::string::npos) << why;
}

TEST_F(MapServerMap, SaysWhyNoCellIsFree) {
  // Grey and alpha: whatever the grey, the mean with an opaque alpha is light, and light is occupied if negated.
  write("map.pgm", std::string("P5\n2 1\n255\n\xC0\xFF", 13));
  EXPECT_EQ(
      refusal(writeYaml("map.pgm", "negate: 1\n")),
      "the map " + in("map.yaml") +
          " has no free cell by map_server's rule: 2 of 2 are occupied (above occupied_thresh = 0.65), the others "
          "unknown, none is below free_thresh = 0.196; with negate = 1 light is occupied, and the mean of all "
          "channels counts, alpha included");
}

TEST_F(MapServerMap, NamesWhatIsWrongInTheYaml) {
  write("map.pgm", kImage);
  EXPECT_NE(refusal(in("absent.yaml")).find("absent.yaml"), std::string::npos);
  EXPECT_NE(refusal(write("map.yaml", "image: [unclosed")).find("cannot be read as yaml"), std::string::npos);
  EXPECT_NE(refusal(write("map.yaml", "just text")).find("no yaml mapping"), std::string::npos);
  EXPECT_NE(refusal(write("map.yaml", "image: map.pgm")).find("lacks the field resolution"), std::string::npos);
  EXPECT_NE(refusal(writeYaml("map.pgm", "")).find("lacks the field negate"), std::string::npos);
  EXPECT_NE(refusal(writeYaml("map.pgm", "negate: 2\n")).find("negate '2', expected 0 or 1"), std::string::npos);
  EXPECT_NE(refusal(writeYaml("map.pgm", "negate: 0\nmode: raw\n")).find("mode 'raw', expected trinary or scale"),
            std::string::npos);
  const std::string rest = "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const std::string image = "image: map.pgm\n";
  EXPECT_NE(refusal(write("map.yaml", image + "resolution: fine\norigin: [0, 0, 0]" + rest)).find("'fine'"),
            std::string::npos);
  EXPECT_NE(refusal(write("map.yaml", image + "resolution: -0.05\norigin: [0, 0, 0]" + rest)), "");
  EXPECT_NE(refusal(write("map.yaml", image + "resolution: 0.05\norigin: [0, 0]" + rest)).find("[x, y, yaw]"),
            std::string::npos);
  EXPECT_NE(refusal(write("map.yaml", image + "resolution: 0.05\norigin: [0, .nan, 0]" + rest)), "");
}

TEST_F(MapServerMap, RefusesAYamlThatIsTooLong) {
  const std::string nested = "image: " + std::string(5000, '[');
  const std::string said = refusal(write("map.yaml", nested));
  EXPECT_NE(said.find("the map's yaml file "), std::string::npos) << said;
  EXPECT_NE(said.find("it has 5007 bytes, expected at most 4096"), std::string::npos) << said;
}

TEST_F(MapServerMap, RefusesBrokenImages) {
  const auto refusalOf = [this](const std::string& content) {
    write("bad.pgm", content);
    return refusal(writeYaml("bad.pgm"));
  };
  EXPECT_NE(refusal(writeYaml("absent.pgm")).find("absent.pgm"), std::string::npos);
  EXPECT_NE(refusalOf(""), "");
  EXPECT_NE(refusalOf("no image at all"), "");
  EXPECT_NE(refusalOf("P5\n1000 1000\n255\nshort"), "");
  EXPECT_NE(refusalOf("P5\n-3 2\n255\n"), "");
  // 16 GB of pixels, refused before any of it is allocated.
  EXPECT_NE(refusalOf("P5\n131072 131072\n255\n").find("at most 2^26 pixels or 2^28 bytes"), std::string::npos);
  const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\1\0\0\0\1\0\0\x08\0\0\0\0", 29);
  EXPECT_NE(refusalOf(png).find("65536 x 65536"), std::string::npos);
  const std::string deep("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x20\0\0\0\x20\0\x10\x06\0\0\0", 29);
  EXPECT_NE(refusalOf(deep).find("8192 x 8192 pixels of 8 bytes"), std::string::npos) << refusalOf(deep);
  EXPECT_NE(refusalOf("P6\n8192 8192\n65535\n").find("pixels of 6 bytes"), std::string::npos);
  const std::string bmp = std::string("BM") + std::string(12, '\0') + std::string("\x28\0\0\0\0\0\1\0\0\0\1\0", 12);
  EXPECT_NE(refusalOf(bmp).find("65536 x 65536"), std::string::npos) << refusalOf(bmp);
  const std::string jpeg("\xff\xd8\xff\xe0\0\4\0\0\xff\xc2\0\x11\x08\xff\xff\xff\xfe\3", 18);
  EXPECT_NE(refusalOf(jpeg).find("65534 x 65535 pixels of 3 bytes"), std::string::npos) << refusalOf(jpeg);
  const std::string filled("\xff\xd8\xff\xff\xc0\0\x11\x08\xff\xff\xff\xfe\3", 13);  // a byte 0xff more
  EXPECT_NE(refusalOf(filled).find("65534 x 65535 pixels"), std::string::npos) << refusalOf(filled);
  EXPECT_NE(refusalOf("\xff\xd8\xff\xe0 JFIF").find("has 0 x 0 pixels"), std::string::npos);
  EXPECT_NE(refusalOf("GIF89a").find("is of no kind that is known here"), std::string::npos);
}

TEST_F(MapServerMap, ReadsBackWhatItWrote) {
  OccupancyGrid grid(17, 9, 0.05, {-1.0 / 3.0, 0.1, 0.7});
  Random random(1);
  for (const CellIndex cell : grid.cells()) grid.set(cell, static_cast<Cell>(uniformIndex(random, 3)));
  writeMapServerMap(in("written"), grid);
  const OccupancyGrid read = readMapServerMap(in("written.yaml"));
  ASSERT_EQ(read.columns(), 17);
  ASSERT_EQ(read.rows(), 9);
  EXPECT_EQ(read.resolution(), grid.resolution());
  EXPECT_EQ(read.origin().x, grid.origin().x);
  EXPECT_EQ(read.origin().yaw, grid.origin().yaw);
  for (const CellIndex cell : grid.cells()) EXPECT_EQ(read.at(cell), grid.at(cell));
  EXPECT_THROW(writeMapServerMap(in("absent/written"), grid), MapFileError);
}

TEST(RealMaps, CanAllBeRead) {
  const std::string folder = realData("maps/");
  SKIP_WITHOUT_REAL_DATA(folder);

  for (const std::string name : {"brsu-c069", "building_31", "dis-B1-2011-09-27", "etsidi_slam_real1", "home_small",
                                 "stata_basement", "zaki_2018may9_before"}) {
    const OccupancyGrid grid = readMapServerMap(folder + name + ".yaml");
    int free = 0;
    int occupied = 0;
    for (const CellIndex cell : grid.cells()) {
      free += grid.at(cell) == Cell::kFree ? 1 : 0;
      occupied += grid.at(cell) == Cell::kOccupied ? 1 : 0;
    }
    EXPECT_GT(free, occupied) << name << ": a building is mostly floor";
    EXPECT_GT(occupied, 1000) << name;
  }
  const auto isFree = [&folder](double free_threshold) {
    return readMapServerMap(folder + "stage_ros_willow-full.yaml", free_threshold).at({0, 0}) == Cell::kFree;
  };
  EXPECT_TRUE(isFree(-1.0)) << "Willow's surroundings are of the grey 206, free at its own threshold";
  EXPECT_FALSE(isFree(0.19));
}

}  // namespace
}  // namespace lstm_planner::test_map_server_map
