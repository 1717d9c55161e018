#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace lstm_planner {

/// Reads a picture, 8 bits each of blue, green and red. Throws std::runtime_error that says why if it cannot be read.
cv::Mat readPicture(const std::string& path);

/// Writes a picture in the format that the end of its name says (.png, .jpg). Throws std::runtime_error if it cannot be
/// written.
void writePicture(const std::string& path, const cv::Mat& picture);

}  // namespace lstm_planner
