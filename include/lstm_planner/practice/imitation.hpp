#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/practice/drive_course.hpp"
#include "lstm_planner/practice/drive_judge.hpp"
#include "lstm_planner/training/imitation_rounds.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/trainer.hpp"

namespace lstm_planner {

/// Learning to drive from a teacher that knows the map, in generated worlds and under random conditions, in the rounds
/// of ImitationRounds.
struct ImitationParameters {
  PolicyDescription policy;
  DriveCourseParameters course;
  NetworkShape shape;
  int rounds = 10;             ///< collect, then train on everything collected so far; from the second round on the
                               ///< learner steers most of the drives
  int worlds = 120;            ///< generated worlds per round
  int goals = 2;               ///< per world
  int starts = 2;              ///< drives per goal
  int validation_worlds = 60;  ///< worlds that are never trained on
  int max_steps = 300;         ///< of a drive
  std::uint64_t seed = 1;
  int threads = 2;
  TrainerParameters trainer;  ///< for each round
};

/// Visits the parameters that have an option, by the option's name, except the loss; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitImitationParameters(Parameters& p, const Visitor& visit) {
  visit("rounds", p.rounds, {1, 1e6}, "", "rounds of collecting drives and training");
  visit("worlds", p.worlds, {1, 1e5}, "", "worlds per round");
  visit("goals", p.goals, {1, 1e4}, "", "goals per world");
  visit("starts", p.starts, {1, 1e4}, "", "drives per goal");
  visit("epochs", p.trainer.epochs, {1, 1e6}, "", "epochs per round");
  visit("rate", p.trainer.optimiser.learning_rate, {1e-9, 100.0}, "", "learning rate");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const ImitationParameters& parameters);

class DriveImitationCourse;

/// Reports of progress: share of the whole work that is done, in [0, 1]. Called from the calling thread.
using ProgressCallback = std::function<void(double)>;

/// A step is an epoch; the first one of each round first collects drives. A judgement is due after the last one of each
/// round. The same parameters give the same weights, for any number of threads.
class DriveImitation : public ImitationRounds {
 public:
  /// Throws as validate().
  explicit DriveImitation(const ImitationParameters& parameters, const ProgressCallback& progress = {});

  std::size_t drivenSteps() const;  ///< of all training drives so far, also steps without an answer of the teacher
  double drivenShare() const;       ///< share of worlds that are done: the simulation takes most of the time

  /// The score of these layers alone in the validation drives.
  DriveScore judge(const LayerStack& layers);

 private:
  DriveImitation(const ImitationParameters& parameters, std::unique_ptr<DriveImitationCourse> course);

  DriveImitationCourse& course_;  ///< the rounds own it
};

}  // namespace lstm_planner
