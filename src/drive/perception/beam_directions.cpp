#include "lstm_planner/drive/perception/beam_directions.hpp"

#include <cmath>

namespace lstm_planner {

void BeamDirections::set(double first, double increment, std::size_t beams) {
  if (first == first_ && increment == increment_ && beams == vectors_.size()) {
    return;
  }
  first_ = first;
  increment_ = increment;
  vectors_.resize(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const double direction = first + static_cast<double>(i) * increment;
    vectors_[i] = {std::cos(direction), std::sin(direction)};
  }
}

}  // namespace lstm_planner
