#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/base/learning/trainer.hpp"
#include "lstm_planner/robot/driving/drive_policy.hpp"
#include "lstm_planner/robot/learning/drive_course.hpp"
#include "lstm_planner/robot/learning/drive_judge.hpp"

namespace lstm_planner {

/// Learning to drive from a teacher that knows the map, in generated worlds and under random conditions, in the rounds
/// of ImitationRounds.
struct ImitationParameters {
  PolicyDescription policy;
  DriveCourseParameters course;
  NetworkShape shape;
  int rounds = 10;             ///< collect, then train on everything collected so far
  int worlds = 120;            ///< generated worlds a round
  int goals = 2;               ///< a world
  int starts = 2;              ///< drives to a goal
  int validation_worlds = 60;  ///< worlds that are never trained on
  double learner_share = 0.8;  ///< share of drives with the learner at the wheel, from the second round on
  int stuck_steps = 24;        ///< steps without progress after which the teacher takes the wheel
  int rescue_steps = 16;       ///< and for how long
  int max_steps = 300;         ///< of a drive
  int sequence_steps = 96;     ///< length of a training sequence
  int burn_in_steps = 32;      ///< of these, steps that only bring the hidden state up to date
  std::uint64_t seed = 1;
  int threads = 2;
  TrainerParameters trainer;  ///< for each round
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const ImitationParameters& parameters);

/// What one round brought.
struct ImitationRound {
  int round = 0;          ///< from 1
  std::size_t steps = 0;  ///< collected so far
  DriveScore score;       ///< of the validation drives, by the learner alone, after the round
  TrainingResult training;
};

/// What all rounds brought.
struct ImitationResult {
  LayerStack layers;  ///< of the most efficient round
  std::vector<ImitationRound> rounds;
  std::vector<EpochReport> curve;  ///< of all rounds, one after the other
};

/// Reports of progress: share of the whole work that is done, in [0, 1]. Called from the calling thread.
using ProgressCallback = std::function<void(double)>;
using RoundCallback = std::function<void(const ImitationRound&)>;

/// Runs all rounds. The same parameters give the same weights, whatever the number of threads.
ImitationResult imitate(const ImitationParameters& parameters, const ProgressCallback& progress = {},
                        const RoundCallback& round_done = {});

}  // namespace lstm_planner
