#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/grid_world/learning/grid_dataset.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/imitation_rounds.hpp"

namespace lstm_planner {

/// Learning to walk the grid world from a supervisor that knows the map (thesis 2.3.1 and 3.2).
///
/// One round is the thesis's way: the supervisor leads, and the network learns to give the same answers. Further rounds
/// are those of ImitationRounds.
struct GridImitationParameters {
  /// A round draws hundreds of paths, not millions: a few goals are enough.
  GridImitationParameters() { course.goals = 150; }

  GridCourseParameters course;
  GridDatasetParameters dataset;  ///< of each round
  int validation_steps = 10240;   ///< collected in each round (thesis Table 3.1); from the second on the network leads
  int rounds = 1;                 ///< from the second on the network leads most of the paths
  int batch_steps = 4096;         ///< steps an update; the thesis's are sequence_steps. Sets trainer.batch_size
  TrainerParameters trainer;      ///< for each round
  std::uint64_t seed = 1;
  int threads = 2;  ///< does not change the result
};

/// Visits the parameters of a round that have an option, by the option's name, except supervisor, loss and optimiser;
/// see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitGridImitationParameters(Parameters& p, const Visitor& visit) {
  visit("steps", p.dataset.steps, {1, 1e9}, "", "number of steps for training, each round");
  visit("validation-steps", p.validation_steps, {1, 1e9}, "",
        "number of steps on the validation maps, to choose the best epoch");
  visit("sequence", p.dataset.sequence_steps, {1, 1e5}, "",
        "largest number of steps of backpropagation through time: the thesis's time sequence");
  visit("burn-in", p.dataset.burn_in_steps, {0, 1e5}, "",
        "if a sequence starts in the middle of a path: steps before it that only set the hidden state");
  visit("batch-steps", p.batch_steps, {1, 1e9}, "", "steps per update");
  visit("goals", p.course.goals, {1, 1e5}, "", "number of goals of the paths of a round");
}

/// The training of the thesis: Tables 3.1 and 3.2, 500 epochs.
GridImitationParameters thesisImitation();

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridImitationParameters& parameters);

/// Rounds of imitation that start from the weights of `layers` and collect on these maps. The same arguments give the
/// same weights, bit for bit, for any number of threads. Throws std::invalid_argument if the arguments do not fit
/// together.
std::unique_ptr<ImitationRounds> gridImitation(const GridImitationParameters& parameters, const LayerStack& layers,
                                               std::vector<GridCourse::Set> training,
                                               const std::vector<GridCourse::Set>& validation);

}  // namespace lstm_planner
