#include "lstm_planner/drive/decision/action_set.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

ActionSet::ActionSet() : ActionSet({-M_PI_2, -M_PI_4, 0.0, M_PI_4, M_PI_2}) {}

ActionSet::ActionSet(std::vector<double> angles) : angles_(std::move(angles)) {
  if (angles_.size() < 2) {
    throw std::invalid_argument("the action set has " + std::to_string(angles_.size()) +
                                " steering angles, at least two are needed");
  }
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    if (!std::isfinite(angles_[i]) || std::abs(angles_[i]) > M_PI || (i > 0 && angles_[i] <= angles_[i - 1])) {
      throw std::invalid_argument("steering angle " + std::to_string(i) + " is " + std::to_string(angles_[i]) +
                                  ", expected ascending angles within [-pi, pi]");
    }
  }
}

int ActionSet::nearest(double angle) const {
  int best = 0;
  for (int action = 1; action < size(); ++action) {
    if (std::abs(normalizeAngle(angle - this->angle(action))) < std::abs(normalizeAngle(angle - this->angle(best)))) {
      best = action;
    }
  }
  return best;
}

}  // namespace lstm_planner
