#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_reinforcement.hpp"
#include "tools/ranges.hpp"
#include "tools/ranks.hpp"
#include "tools/train_grid_options.hpp"
#include "tools/visited_settings.hpp"

namespace lstm_planner {

/// What is to be trained, and how.
struct GridReinforcementPlan {
  GridTrainingOptions options;
  GridReinforcementParameters training;
  nlohmann::json settings;  ///< what the result depends on
};

/// All options that ways of reinforcement have in common. `plan` and `parameters`, the learner's, hold the defaults and
/// take the values.
template <typename Parameters>
void addGridReinforcementOptions(const std::string& method, const std::vector<std::string>& arguments,
                                 GridReinforcementPlan* plan, Parameters* parameters, CommandLine* line) {
  Parameters& p = *parameters;
  GridCourseParameters& course = plan->training.course;
  plan->options.method = method;
  plan->options.epochs = plan->training.epochs;
  plan->options.encoder = p.encoder;
  addGridTrainingOptions(arguments, &plan->options, line);
  line->add("goals", &course.goals, {1, 1e5},
            "goals in memory at the same time; each needs 4 bytes per cell of its map");
  line->add("short-share", &course.short_share, kAnyShare,
            "share of the training episodes whose length is drawn with a probability proportional to 1 / length; the "
            "others uniformly");
  visitGridLearnerParameters(p, line->everyParameter());
}

/// Hands what was parsed to the training and to the learner's parameters, and notes it in the plan's settings. Throws
/// std::invalid_argument with a sentence for values that make no sense.
template <typename Parameters>
void finishGridReinforcement(GridReinforcementPlan* plan, Parameters* parameters) {
  Parameters& p = *parameters;
  GridTrainingOptions& options = plan->options;
  GridReinforcementParameters& training = plan->training;
  training.course.min_length = options.min_length;
  training.course.max_length = options.max_length;
  training.course.dead_end_share = options.dead_ends;
  training.updates = p.updates;
  training.epochs = options.epochs;
  training.seed = p.seed = options.seed;
  training.threads = p.threads = options.threads;
  p.communicator = ranks();
  validate(training);
  validate(p);
  plan->settings = settingsOf(options);
  plan->settings.update({{"goals", training.course.goals}, {"short-share", training.course.short_share}});
  visitGridLearnerParameters(p, noteIn(&plan->settings));
}

/// Learns epoch by epoch, with a line for each; see GridReinforcement and runTraining(). Returns the exit status.
int trainByReinforcement(const GridReinforcementPlan& plan, GridLearner* learner);

}  // namespace lstm_planner
