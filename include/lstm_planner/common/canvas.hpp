#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace lstm_planner {

/// The cells of a map as a picture to draw on. Colours are blue, green, red; widths and heights are in pixels.
///
/// Places are in sixteenths of a pixel, so that lines are smooth: fine() makes one of a place in pixels.
class Canvas {
 public:
  /// `cells`: a pixel of three bytes for each cell. They are enlarged by a whole number, so that the longer side has at
  /// most `longest_side` pixels. Larger maps are made smaller in a way that keeps thin walls.
  Canvas(const cv::Mat& cells, int longest_side);

  cv::Mat& image() { return image_; }
  double scale() const { return scale_; }  ///< pixels a cell

  /// The fine place for a place in pixels, and the pixel in which a fine place lies.
  static cv::Point fine(double column, double row);
  static cv::Point pixelOf(const cv::Point& place);

  void polyline(const std::vector<cv::Point>& places, const cv::Scalar& color, int width);
  /// `radius`, and `reach` of a cross to each side, in pixels.
  void circle(const cv::Point& center, double radius, const cv::Scalar& color, int width);
  void cross(const cv::Point& center, double reach, const cv::Scalar& color, int width);

 private:
  double scale_ = 1.0;
  cv::Mat image_;
};

/// Writes a line of text on a picture; `left_bottom` of its letters, in pixels.
void writeText(const std::string& text, const cv::Point& left_bottom, double size, const cv::Scalar& color, int width,
               cv::Mat* picture);

/// Width and height of a text, pixels.
cv::Size sizeOfText(const std::string& text, double size, int width);

}  // namespace lstm_planner
