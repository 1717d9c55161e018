#include "tools/drive_states.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "lstm_planner/common/canvas.hpp"
#include "lstm_planner/common/picture_file.hpp"
#include "lstm_planner/training/policy_gradient.hpp"

namespace lstm_planner {
namespace {

constexpr int kTextHeight = 28;  // pixels
constexpr int kPreferenceRow = 22;
constexpr int kCellsHeight = 400;
constexpr int kLargestCellRow = 6;

/// White at 0, red upwards, blue downwards; `value` in [-1, 1].
cv::Vec3b colorOf(float value) {
  const float size = std::min(1.0f, std::abs(value));
  const auto pale = static_cast<unsigned char>(255.0f * (1.0f - size));
  const auto full = static_cast<unsigned char>(255.0f - 25.0f * size);
  return value >= 0.0f ? cv::Vec3b(pale, pale, full) : cv::Vec3b(full, pale, pale);
}

std::vector<float> probabilities(const std::vector<float>& preferences) {
  std::vector<float> shares(preferences.size());
  const float sum = fillChances(
      static_cast<int>(shares.size()), [](int) { return true; },
      [&](int action) { return preferences[static_cast<std::size_t>(action)]; }, shares.data());
  for (float& share : shares) share /= sum;
  return shares;
}

/// A row a value, a column a step, each row so many pixels high; the first row is the uppermost.
template <typename ValueOf>
cv::Mat heatmap(int rows, int steps, int row_height, int width, const ValueOf& value_of) {
  cv::Mat small(rows, steps, CV_8UC3);
  for (int row = 0; row < rows; ++row) {
    for (int step = 0; step < steps; ++step) small.at<cv::Vec3b>(row, step) = colorOf(value_of(row, step));
  }
  cv::Mat large;
  cv::resize(small, large, {width, rows * row_height}, 0.0, 0.0, cv::INTER_NEAREST);
  return large;
}

cv::Mat line(const std::string& text, int width) {
  cv::Mat strip(kTextHeight, width, CV_8UC3, cv::Scalar(255, 255, 255));
  writeText(text, {8, kTextHeight - 9}, 0.5, cv::Scalar(0, 0, 0), 1, &strip);
  return strip;
}

}  // namespace

void DriveStates::watch(NavigationAgent* agent) {
  agent->setStepListener([this, agent](const Situation&, const Observation&) -> std::optional<int> {
    steps_.push_back({agent->decision().preferences, agent->policy().hiddenState()});
    return std::nullopt;
  });
}

void DriveStates::drawBelow(const std::string& path) const {
  if (steps_.empty()) throw std::invalid_argument("no step of the drive was noted");
  const cv::Mat drive = readPicture(path);
  const int steps = static_cast<int>(steps_.size());
  const int actions = static_cast<int>(steps_.front().preferences.size());
  const int cells = static_cast<int>(steps_.front().hidden.size());
  std::vector<std::vector<float>> shares;
  for (const Step& step : steps_) shares.push_back(probabilities(step.preferences));
  const cv::Mat preferences = heatmap(actions, steps, kPreferenceRow, drive.cols, [&](int row, int step) {
    return shares[static_cast<std::size_t>(step)][static_cast<std::size_t>(actions - 1 - row)];
  });
  const int cell_row = std::clamp(kCellsHeight / cells, 1, kLargestCellRow);
  const cv::Mat hidden = heatmap(cells, steps, cell_row, drive.cols, [&](int row, int step) {
    return std::tanh(steps_[static_cast<std::size_t>(step)].hidden[row]);
  });
  cv::Mat all;
  cv::vconcat(
      std::vector<cv::Mat>{drive, line("preferences, step by step: leftmost angle above, rightmost below", drive.cols),
                           preferences, line("hidden state: red positive, blue negative, a row a cell", drive.cols),
                           hidden},
      all);
  writePicture(path, all);
}

}  // namespace lstm_planner
