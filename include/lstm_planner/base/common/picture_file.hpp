#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace lstm_planner {

/// Writes a picture in the format that the end of its name says (.png, .jpg). Throws std::runtime_error if it cannot be
/// written.
void writePicture(const std::string& path, const cv::Mat& picture);

}  // namespace lstm_planner
