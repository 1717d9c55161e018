#include "lstm_planner/practice/drive_learner.hpp"

#include <algorithm>

#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {

DriveReinforcement::DriveReinforcement(int iterations, int judgements, DriveLearner* learner)
    : iterations_(iterations), interval_(std::max(1, iterations / std::max(1, judgements))), learner_(*learner) {
  checkParameter(iterations >= 1, "iterations", iterations, "at least 1");
  checkParameter(judgements >= 1, "judgements", judgements, "at least 1");
}

}  // namespace lstm_planner
