// Calls functions of OpenCV that the public headers name: the targets of the package must bring its library along.
#include <lstm_planner/common/canvas.hpp>

int main() {
  lstm_planner::Canvas canvas(cv::Mat(4, 6, CV_8UC3, cv::Scalar(255, 255, 255)), 600);
  return canvas.image().cols == 600 ? 0 : 1;
}
