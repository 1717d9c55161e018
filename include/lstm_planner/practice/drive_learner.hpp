#pragma once

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/practice/drive_course.hpp"
#include "lstm_planner/training/reinforcement_learner.hpp"
#include "lstm_planner/training/training_loop.hpp"

namespace lstm_planner {

/// What every learner from practice drives needs besides its way of learning. Lengths are in m.
struct PracticeParameters {
  PolicyDescription policy;
  DriveCourseParameters course;
  int iterations = 60;        ///< collect, then update
  int worlds = 16;            ///< an iteration, new ones each time
  int goals = 2;              ///< a world
  int starts = 8;             ///< drives to a goal
  int passes = 4;             ///< over what was collected
  double contact_cost = 0.5;  ///< m; of the reward by progress
};

/// Visits what all learners from practice drives have in common, named as the options; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitPracticeParameters(Parameters& p, const Visitor& visit) {
  visit("iterations", p.iterations, {1, 1e6}, "", "iterations of collecting drives and learning");
  visit("worlds", p.worlds, {1, 1e5}, "", "worlds per iteration");
  visit("goals", p.goals, {1, 1e4}, "", "goals per world");
  visit("starts", p.starts, {1, 1e4}, "", "drives per goal");
  visit("window", p.window, {1, 1e5}, "", "largest number of steps of backpropagation through time");
  visit("passes", p.passes, {1, 1e4}, "", "passes over the collected drives");
  visit("contact-cost", p.contact_cost, {0.0, 1e6}, "m", "cost of a contact, where the reward is the progress");
}

/// A network that learns from practice drives: makeDriveActorCritic(). An update of it is an iteration.
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
