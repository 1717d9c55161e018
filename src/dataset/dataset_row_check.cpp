#include "dataset/dataset_row_check.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "dataset/step_quantities.hpp"
#include "lstm_planner/drive/perception/sectors.hpp"

namespace lstm_planner {

void checkRow(const RecordingDescription& description) { validate(description.parameters); }

void checkRow(const ScanGeometry& geometry) {
  if (geometry.beams < 1 || geometry.beams > kMostBeams) {
    throw std::invalid_argument("it has " + std::to_string(geometry.beams) + " beams, expected 1 to " +
                                std::to_string(kMostBeams));
  }
  LaserScan scan = scanOf(geometry, std::vector<float>(static_cast<std::size_t>(geometry.beams)));
  checkScan(scan, geometry.mount);
  const double somewhere = std::clamp(1.0, geometry.range_min, geometry.range_max);
  std::fill(scan.ranges.begin(), scan.ranges.end(), static_cast<float>(somewhere));
  averageSectors(scan, geometry.mount, {}, 1.0);
}

namespace {

void checkNumbers(const DriveStep& step) {
  visitColumns(step, [&](const std::string& name, const char*, const auto& number) {
    const double value = static_cast<double>(number);
    const bool is_missing = name.rfind("minimum_range_", 0) == 0 && std::isinf(value) && value > 0.0;
    if (std::abs(value) <= kLargestNumber || is_missing) return;
    std::ostringstream sentence;
    sentence << "its " << name << " is " << value << ", expected a number from -" << kLargestNumber << " to "
             << kLargestNumber;
    throw std::invalid_argument(sentence.str());
  });
}

}  // namespace

void checkRow(const DriveStep& step, std::size_t angles) {
  checkNumbers(step);
  if (step.label < 0 || static_cast<std::size_t>(step.label) >= angles) {
    throw std::invalid_argument("its label is " + std::to_string(step.label) + ", expected 0 to " +
                                std::to_string(angles - 1));
  }
}

}  // namespace lstm_planner
