#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "lstm_planner/base/network/layers.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "tools/train_grid_options.hpp"

namespace lstm_planner {

/// What a learner's agents did since the last report; see the learners' own reports.
struct ReinforcementReport {
  double steps = 0.0;
  double reward = 0.0;
  double arrival = 0.0;
  double ratio = 0.0;
};

/// A learner as the loop of epochs sees it: GridActorCritic, GridQLearning.
class ReinforcementLearner {
 public:
  virtual ~ReinforcementLearner() = default;
  virtual void beginEpoch(int epoch, const GridCourse& course) = 0;
  virtual void update() = 0;
  virtual ReinforcementReport report() = 0;
  virtual const LayerStack& layers() const = 0;
  virtual std::vector<std::uint8_t> checkpoint() const = 0;
  virtual void restore(const std::vector<std::uint8_t>& checkpoint) = 0;
};

/// What the loop is to do.
struct ReinforcementPlan {
  GridTrainingOptions options;
  GridCourseParameters course;
  nlohmann::json settings;  ///< what the result depends on
  int updates = 20000;      ///< over all epochs
};

/// --updates and the course's options; `plan` holds the method's defaults.
void addReinforcementOptions(ReinforcementPlan* plan, CommandLine* line);

/// Takes over what was parsed. Throws std::invalid_argument with a sentence for values that make no sense.
void finishReinforcementOptions(ReinforcementPlan* plan);

/// Learns epoch by epoch: each with a new course, judged after it, the best kept, a line printed and the checkpoint
/// written. Goes on from the checkpoint where there is one. Returns the exit status.
int trainByReinforcement(const ReinforcementPlan& plan, ReinforcementLearner* learner);

}  // namespace lstm_planner
