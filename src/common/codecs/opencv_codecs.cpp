#include <opencv2/imgcodecs.hpp>

#include "common/image_codecs.hpp"

extern "C" const lstm_planner::ImageCodecs* lstmPlannerImageCodecs() {
  static const lstm_planner::ImageCodecs codecs{
      [](const std::string& bytes, int mode) {
        const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
        return cv::imdecode(buffer, mode);
      },
      [](const std::string& suffix, const cv::Mat& image, std::vector<unsigned char>* bytes) {
        return cv::imencode(suffix, image, *bytes);
      }};
  return &codecs;
}
