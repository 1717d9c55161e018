#include "dataset/dataset_row_check.hpp"

#include <stdexcept>
#include <string>

namespace lstm_planner {

void checkRow(const RecordingDescription& description) { validate(description.parameters); }

void checkRow(const DriveStep& step, std::size_t angles) {
  if (step.label < 0 || static_cast<std::size_t>(step.label) >= angles) {
    throw std::invalid_argument("its label is " + std::to_string(step.label) + ", expected 0 to " +
                                std::to_string(angles - 1));
  }
}

}  // namespace lstm_planner
