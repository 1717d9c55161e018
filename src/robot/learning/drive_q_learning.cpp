#include "lstm_planner/robot/learning/drive_q_learning.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/common/parameter_visitors.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "lstm_planner/base/learning/q_learner.hpp"
#include "robot/learning/drive_practice.hpp"
#include "robot/learning/drive_q_tile.hpp"
#include "robot/learning/drive_queues.hpp"

namespace lstm_planner {
namespace {

const QLearner::CheckpointNames kQLearningNames{"lstm_planner drive q-learning 1", "iterations"};

/// m; a sector that sees less counts as this.
constexpr double kNearest = 0.1;

class DriveQLearning final : public DriveLearner {
 public:
  DriveQLearning(const DriveQLearningParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        layers_(std::move(layers)),
        learner_(kQLearningNames, parameters, parameters.iterations, layers_) {
    DrivePolicy(parameters.policy, layers_);  // throws when they do not fit together
  }

  ReinforcementReport iterate() override {
    learner_.startUpdate();
    const double epsilon = learner_.epsilon();
    const std::vector<PracticeEpisode> episodes = practise(rulesWith(epsilon), layers_, learner_.updates());
    const ValueSums values = learnFrom(episodes);
    setParameterVector(learner_.weights(), layers_);
    const PracticeSums sums = sumUp(episodes);
    learner_.finishUpdate(sums.steps);
    ReinforcementReport report = learner_.report(values);
    report.reward = sums.reward;
    report.arrival = sums.arrival;
    report.epsilon = epsilon;
    return report;
  }

  int updates() const override { return learner_.updates(); }
  const LayerStack& layers() const override { return layers_; }

  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override {
    learner_.restore(checkpoint);
    setParameterVector(learner_.weights(), layers_);
  }

 private:
  PracticeRules rulesWith(double epsilon) const {
    const ActionChances chances = epsilonGreedyChances(epsilon);
    if (parameters_.reward == DriveQLearningParameters::Reward::kProgress) {
      return practiceRules(parameters_, chances, progressReward(parameters_.step_cost, parameters_.contact_cost),
                           parameters_.arrival_bonus);
    }
    const auto reward = [weights = parameters_.thesis_reward](const PracticeOutcome& outcome) {
      return driveThesisReward(outcome.before, weights);
    };
    return practiceRules(parameters_, chances, reward, 0.0);
  }

  /// Returns what the values were before the first pass.
  ValueSums learnFrom(const std::vector<PracticeEpisode>& episodes) {
    ValueSums before;
    DriveTiles<DriveQTile> tiles(parameters_.communicator, parameters_.threads,
                                 [this] { return std::make_unique<DriveQTile>(parameters_, layers_); });
    const int windows = tiles.pack(episodes);
    for (int pass = 0; pass < parameters_.passes; ++pass) {
      const auto judge = [this](DriveQTile* tile) { return tile->judge(learner_.weights(), learner_.targetWeights()); };
      for (const ValueSums& some : tiles.each(ValueSums(), judge)) {
        if (pass == 0) before += some;
      }
      for (int window = 0; window < windows; ++window) {
        Eigen::VectorXf gradient;
        const double steps = tiles.addUp(
            learner_.weights().size(),
            [&](DriveQTile* tile) { return tile->valueGradient(window, learner_.weights()); }, &gradient);
        if (steps > 0.0) learner_.update(gradient * static_cast<float>(1.0 / steps));
      }
    }
    return before;
  }

  DriveQLearningParameters parameters_;
  LayerStack layers_;
  QLearner learner_;
};

}  // namespace

double driveThesisReward(const Observation& observation, const ThesisRewardWeights& weights) {
  double proximity = 0.0;
  for (const double range : observation.sector_ranges) proximity += 1.0 / std::max(kNearest, range);
  return -(weights.range * proximity + weights.distance * observation.goal_distance +
           weights.angle * std::abs(observation.goal_bearing));
}

void validate(const DriveQLearningParameters& parameters) {
  visitPracticeParameters(parameters, RangeCheck());
  validate(static_cast<const QLearningParameters&>(parameters));
  validate(parameters.policy.encoder);
  validate(parameters.course);
}

std::unique_ptr<DriveLearner> makeDriveQLearning(const DriveQLearningParameters& parameters, LayerStack layers) {
  return std::make_unique<DriveQLearning>(parameters, std::move(layers));
}

}  // namespace lstm_planner
