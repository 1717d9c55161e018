#include "lstm_planner/common/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lstm_planner {
namespace {

constexpr int kFineBits = 4;
constexpr double kFine = 1 << kFineBits;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

}  // namespace

Canvas::Canvas(const cv::Mat& cells, int longest_side) {
  const double fitting = longest_side / static_cast<double>(std::max(cells.cols, cells.rows));
  scale_ = fitting >= 1.0 ? std::floor(fitting) : fitting;
  cv::resize(cells, image_, cv::Size(), scale_, scale_, scale_ < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
}

cv::Point Canvas::fine(double column, double row) {
  return {cv::saturate_cast<int>(column * kFine), cv::saturate_cast<int>(row * kFine)};
}

cv::Point Canvas::pixelOf(const cv::Point& place) { return {place.x >> kFineBits, place.y >> kFineBits}; }

void Canvas::polyline(const std::vector<cv::Point>& places, const cv::Scalar& color, int width) {
  if (places.empty()) return;
  cv::polylines(image_, places, false, color, width, cv::LINE_AA, kFineBits);
}

void Canvas::circle(const cv::Point& center, double radius, const cv::Scalar& color, int width) {
  cv::circle(image_, center, static_cast<int>(radius * kFine), color, width, cv::LINE_AA, kFineBits);
}

void Canvas::cross(const cv::Point& center, double reach, const cv::Scalar& color, int width) {
  for (const double side : {1.0, -1.0}) {
    const cv::Point corner = fine(reach, side * reach);
    polyline({center - corner, center + corner}, color, width);
  }
}

void writeText(const std::string& text, const cv::Point& left_bottom, double size, const cv::Scalar& color, int width,
               cv::Mat* picture) {
  cv::putText(*picture, text, left_bottom, kFont, size, color, width, cv::LINE_AA);
}

cv::Size sizeOfText(const std::string& text, double size, int width) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, size, width, &baseline);
}

}  // namespace lstm_planner
