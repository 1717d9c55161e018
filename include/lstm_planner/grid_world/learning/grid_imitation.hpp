#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lstm_planner/base/learning/trainer.hpp"
#include "lstm_planner/base/network/layers.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/grid_world/learning/grid_dataset.hpp"

namespace lstm_planner {

/// A round draws hundreds of paths, not millions: a few goals will do.
inline GridCourseParameters imitationCourse() {
  GridCourseParameters course;
  course.goals = 150;
  return course;
}

/// Learning to walk the grid world from a supervisor that knows the map (thesis 2.3.1 and 3.2).
///
/// One round is the thesis's way: the supervisor leads, the network learns to answer as it does. Every further round
/// collects paths that the network leads itself and learns from everything collected so far (DAgger: Ross, Gordon and
/// Bagnell, AISTATS 2011), so that it also learns what to do where only its own mistakes bring it.
struct GridImitationParameters {
  GridEncoderParameters encoder{GridEncoderParameters::Inputs::kTrace, 1};
  GridCourseParameters course = imitationCourse();
  GridDatasetParameters dataset;  ///< of each round
  int validation_steps = 10240;   ///< thesis Table 3.1; after each round as many again, of paths that the network leads
  int rounds = 1;
  double learner_share = 0.8;  ///< of the paths, from the second round on
  int batch_steps = 4096;      ///< steps an update; the thesis's are sequence_steps. Sets trainer.batch_size
  TrainerParameters trainer;   ///< for each round
  std::uint64_t seed = 1;
  int threads = 2;  ///< does not change the result
};

/// The training of the thesis: Tables 3.1 and 3.2, 500 epochs.
GridImitationParameters thesisImitation();

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridImitationParameters& parameters);

/// A training between two epochs.
struct GridImitationState {
  std::vector<Eigen::VectorXf> learners;  ///< weights after each round that is done
  std::vector<EpochReport> curve;         ///< of these rounds, one after the other
  TrainingState training;                 ///< of the round that goes on
};

std::vector<std::uint8_t> toBytes(const GridImitationState& state);
/// Throws std::invalid_argument when the bytes are not those of a state.
GridImitationState gridImitationStateFrom(const std::vector<std::uint8_t>& bytes);

/// What one round brought.
struct GridImitationRound {
  int round = 0;          ///< from 1
  std::size_t steps = 0;  ///< collected so far
  TrainingResult training;
};

/// Called after each epoch with the state so far; learning ends early when it returns false.
using GridImitationEpochCallback = std::function<bool(int round, const EpochReport&, const GridImitationState&)>;
using GridImitationRoundCallback = std::function<void(const GridImitationRound&)>;

struct GridImitationResult {
  LayerStack layers;                       ///< of the last round's best epoch on the validation set
  std::vector<GridImitationRound> rounds;  ///< without those that were done before
  std::vector<EpochReport> curve;          ///< of all rounds
};

/// Runs all rounds, from the weights of `layers`, or goes on from `state`, where given and begun; collecting what was
/// collected before is done again, as it is not kept. The same arguments give the same weights, bit for bit, with and
/// without a break, for any number of threads. Throws std::invalid_argument for what does not fit together.
GridImitationResult imitateOnGrid(const GridImitationParameters& parameters, const LayerStack& layers,
                                  const std::vector<GridCourse::Set>& training,
                                  const std::vector<GridCourse::Set>& validation,
                                  const GridImitationEpochCallback& epoch_done = {},
                                  const GridImitationRoundCallback& round_done = {},
                                  const GridImitationState& state = {});

}  // namespace lstm_planner
