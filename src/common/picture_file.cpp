#include "lstm_planner/common/picture_file.hpp"

#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "common/image_codecs.hpp"
#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/common/output_file.hpp"

namespace lstm_planner {
namespace {

constexpr std::uintmax_t kLargestPicture = std::uintmax_t{1} << 29;  ///< bytes

}  // namespace

cv::Mat readPicture(const std::string& path) {
  cv::Mat picture;
  std::string reason = "expected a .png or .jpg";
  try {
    picture = imageCodecs().decode(readInputFile(path, kLargestPicture), cv::IMREAD_COLOR);
  } catch (const InputFileError& error) {
    reason = error.what();
  } catch (const cv::Exception& error) {
    reason = error.err;
  }
  if (picture.empty()) throw std::runtime_error("picture '" + path + "' cannot be read: " + reason);
  return picture;
}

void writePicture(const std::string& path, const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  bool is_encoded = false;
  try {
    is_encoded = imageCodecs().encode(std::filesystem::path(path).extension().string(), picture, &bytes);
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
