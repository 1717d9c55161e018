#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace lstm_planner::test {

/// Number of pixels that are not grey: axes, text and an empty page are.
inline int countColoured(const cv::Mat& picture) {
  constexpr int kColourful = 40;
  int coloured = 0;
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const auto& pixel = picture.at<cv::Vec3b>(row, column);
      const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
      coloured += most - least > kColourful ? 1 : 0;
    }
  }
  return coloured;
}

/// Expects a picture in which something is drawn in colour, at least as much as a line across half of it.
inline void expectPicture(const std::string& path) {
  const cv::Mat picture = cv::imread(path, cv::IMREAD_COLOR);
  ASSERT_FALSE(picture.empty()) << path << " is no picture";
  EXPECT_GE(countColoured(picture), picture.cols / 2) << path;
}

/// The same of a picture of that size.
inline void expectPicture(const std::string& path, int width, int height) {
  expectPicture(path);
  const cv::Mat picture = cv::imread(path, cv::IMREAD_COLOR);
  EXPECT_EQ(picture.cols, width) << path;
  EXPECT_EQ(picture.rows, height) << path;
}

}  // namespace lstm_planner::test
