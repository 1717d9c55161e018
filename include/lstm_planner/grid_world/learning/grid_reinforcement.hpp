#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_learner.hpp"
#include "lstm_planner/training/training_loop.hpp"

namespace lstm_planner {

/// On what is learned, and for how long.
struct GridReinforcementParameters {
  GridCourseParameters course;
  int updates = 20000;  ///< of the weights, over all epochs
  int epochs = 10;      ///< 1 to `updates`; each with goals and episodes of its own, checkpoints lie between them
  std::uint64_t seed = 1;
  int threads = 2;  ///< does not change the result
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridReinforcementParameters& parameters);

/// Reinforcement learning in the grid world: a step is an update of the learner, and after each epoch it is judged.
class GridReinforcement : public SteppedTraining {
 public:
  /// `learner` must outlive it. Throws as validate() and GridCourse.
  GridReinforcement(const GridReinforcementParameters& parameters, std::vector<GridCourse::Set> maps,
                    GridLearner* learner);

  int epoch() const { return epoch_; }  ///< done so far
  double progress() const;              ///< share of the updates that are done

  bool done() const override { return epoch_ == parameters_.epochs; }
  void step() override;
  const LayerStack& layers() const override { return learner_.layers(); }
  bool judgementDue() const override { return epoch_done_; }
  bool resumable() const override { return !course_; }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override;

 private:
  int firstUpdate(int epoch) const;

  GridReinforcementParameters parameters_;
  std::vector<GridCourse::Set> maps_;
  GridLearner& learner_;
  int epoch_ = 0;
  std::optional<GridCourse> course_;  ///< of the epoch that goes on
  bool epoch_done_ = false;           ///< by the last step
};

}  // namespace lstm_planner
