#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/base/learning/optimiser.hpp"
#include "lstm_planner/base/network/layers.hpp"

namespace lstm_planner {

/// The weights of a network of values while it learns, whatever the course is: the target network, optimiser and
/// schedule, and the checkpoint of it all. The rate sinks to 0 by half a cosine.
class QLearner {
 public:
  /// What a checkpoint says it is, and what the course calls an update.
  struct CheckpointNames {
    std::string format;
    std::string updates;
  };
  /// The length of a training, and its steps.
  struct Schedule {
    int updates = 1;          ///< of the whole training
    int target_interval = 1;  ///< updates between copies of the weights into the target network
    double learning_rate = 0.0;
    double max_gradient_norm = 0.0;
  };

  /// The layers with the weights to start from. Throws std::invalid_argument as validate(OptimiserParameters).
  QLearner(const CheckpointNames& names, const Schedule& schedule, const LayerStack& layers);

  const Eigen::VectorXf& weights() const { return weights_; }
  const Eigen::VectorXf& targetWeights() const { return target_weights_; }
  double progress() const;  ///< share of the training that is done

  /// Copies the weights into the target network where it is time to.
  void startUpdate();
  /// One step of the optimiser.
  void update(const Eigen::VectorXf& gradient);
  /// An update is done, with so many steps of the agents.
  void finishUpdate(double steps);
  int updates() const { return updates_; }
  double steps() const { return steps_; }  ///< of all updates

  /// Everything that the next update depends on.
  std::vector<std::uint8_t> checkpoint() const;
  /// Throws std::invalid_argument when it is not a checkpoint of the same course and network.
  void restore(const std::vector<std::uint8_t>& checkpoint);

 private:
  CheckpointNames names_;
  Schedule schedule_;
  Eigen::VectorXf weights_;
  Eigen::VectorXf target_weights_;
  Optimiser optimiser_;
  double steps_ = 0.0;
  int updates_ = 0;
};

/// What its optimiser is told.
OptimiserParameters optimiserParameters(const QLearner::Schedule& schedule);

/// Of the parameters of a course, which name these alike.
template <typename Parameters>
QLearner::Schedule qLearningSchedule(const Parameters& parameters, int updates) {
  return {updates, parameters.target_interval, parameters.learning_rate, parameters.max_gradient_norm};
}

}  // namespace lstm_planner
