#include "lstm_planner/base/common/picture_file.hpp"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "lstm_planner/base/common/output_file.hpp"

namespace lstm_planner {

void writePicture(const std::string& path, const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  bool is_encoded = false;
  try {
    is_encoded = cv::imencode(std::filesystem::path(path).extension().string(), picture, bytes);
  } catch (const cv::Exception&) {
    // An extension that OpenCV does not know; said below like any other failure.
  }
  if (!is_encoded) {
    throw std::runtime_error("picture '" + path + "' cannot be written (expected a path to a .png or .jpg)");
  }
  writeOutputFile("picture", path, [&](std::ostream& file) {
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  });
}

}  // namespace lstm_planner
