#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace lstm_planner {

/// OpenCV's readers and writers of image files. They come with 110 other libraries (GDAL, HDF5, PDF, databases),
/// which take four times as long to load as everything else. So they are in a library of their own, loaded with the
/// first image: a robot that drives needs none.
struct ImageCodecs {
  /// The image in the bytes of a file, empty where there is none; `mode`: of cv::imdecode(). Throws cv::Exception.
  cv::Mat (*decode)(const std::string& bytes, int mode);
  /// The bytes of a file whose name ends in `suffix`, such as ".png"; false where they cannot be made. Throws
  /// cv::Exception for a suffix that OpenCV does not know.
  bool (*encode)(const std::string& suffix, const cv::Mat& image, std::vector<unsigned char>* bytes);
};

/// Loads the library when called first. Throws std::runtime_error that names it when it cannot be loaded.
const ImageCodecs& imageCodecs();

}  // namespace lstm_planner

/// The library's entry point; extern "C", because dlsym() looks it up by name.
extern "C" const lstm_planner::ImageCodecs* lstmPlannerImageCodecs();
