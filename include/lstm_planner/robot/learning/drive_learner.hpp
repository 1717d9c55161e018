#pragma once

#include "lstm_planner/base/learning/reinforcement_learner.hpp"
#include "lstm_planner/base/learning/training_loop.hpp"

namespace lstm_planner {

/// A network that learns from practice drives: DriveActorCritic, DriveQLearning. An update of it is an iteration.
class DriveLearner : public ReinforcementLearner {
 public:
  /// Collects drives and learns from them. What happens depends only on the weights, the seed, and how many iterations
  /// there were before.
  virtual ReinforcementReport iterate() = 0;
};

/// Reinforcement learning of the robot: a step is an iteration of the learner, which is judged before the first, after
/// the last, and as often as is told in between.
class DriveReinforcement : public SteppedTraining {
 public:
  /// `learner` must outlive it. Throws std::invalid_argument unless there is an iteration and a judgement.
  DriveReinforcement(int iterations, int judgements, DriveLearner* learner);

  const ReinforcementReport& report() const { return report_; }  ///< of the last step
  int iterations() const { return learner_.updates(); }          ///< done so far
  double progress() const { return static_cast<double>(learner_.updates()) / iterations_; }

  bool done() const override { return learner_.updates() >= iterations_; }
  void step() override { report_ = learner_.iterate(); }
  const LayerStack& layers() const override { return learner_.layers(); }
  bool judgementDue() const override { return done() || learner_.updates() % interval_ == 0; }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  int iterations_;
  int interval_;  ///< iterations from judgement to judgement
  DriveLearner& learner_;
  ReinforcementReport report_;
};

}  // namespace lstm_planner
