#include "lstm_planner/grid_world/learning/grid_reinforcement.hpp"

#include <utility>

#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {
namespace {

/// Updates between replacements of one of the course's goals.
constexpr int kRenewalInterval = 8;

}  // namespace

void validate(const GridReinforcementParameters& parameters) {
  validate(parameters.course);
  checkParameter(parameters.epochs >= 1, "epochs", parameters.epochs, "at least 1");
  checkParameter(parameters.updates >= parameters.epochs, "updates", parameters.updates,
                 "at least one for each of the epochs");
  checkParameter(parameters.threads >= 1, "threads", parameters.threads, "at least 1");
}

GridReinforcement::GridReinforcement(const GridReinforcementParameters& parameters, std::vector<GridCourse::Set> maps,
                                     GridLearner* learner)
    : parameters_((validate(parameters), parameters)), maps_(std::move(maps)), learner_(*learner) {}

double GridReinforcement::progress() const {
  return static_cast<double>(learner_.updates()) / static_cast<double>(parameters_.updates);
}

int GridReinforcement::firstUpdate(int epoch) const {
  return static_cast<int>(static_cast<std::int64_t>(parameters_.updates) * epoch / parameters_.epochs);
}

void GridReinforcement::step() {
  if (!course_) {
    course_.emplace(parameters_.course, maps_, parameters_.seed + static_cast<std::uint64_t>(epoch_),
                    parameters_.threads);
    learner_.startEpoch(epoch_, *course_);
  }
  learner_.update();
  epoch_done_ = learner_.updates() == firstUpdate(epoch_ + 1);
  if (epoch_done_) {
    ++epoch_;
    course_.reset();
  } else if (learner_.updates() % kRenewalInterval == 0) {
    course_->renew(1);
  }
}

void GridReinforcement::restore(const std::vector<std::uint8_t>& checkpoint) {
  learner_.restore(checkpoint);
  course_.reset();
  epoch_done_ = false;
  epoch_ = 0;
  while (epoch_ < parameters_.epochs && firstUpdate(epoch_ + 1) <= learner_.updates()) ++epoch_;
}

}  // namespace lstm_planner
