#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace lstm_planner {

/// Writes a picture whose kind its name's end tells (.png, .jpg). Throws std::runtime_error when it cannot be written.
void writePicture(const std::string& path, const cv::Mat& picture);

}  // namespace lstm_planner
