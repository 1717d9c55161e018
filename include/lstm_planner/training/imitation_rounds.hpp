#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/training/sequence.hpp"
#include "lstm_planner/training/trainer.hpp"
#include "lstm_planner/training/training_loop.hpp"

namespace lstm_planner {

/// Where imitation learns: collects steps, and what a teacher answers in them. The same for the same arguments.
class ImitationCourse {
 public:
  virtual ~ImitationCourse() = default;

  /// Collects what is learned from in round `round` (from 0). The teacher leads; `learner`, null only in the first
  /// round, leads some of the episodes.
  virtual std::vector<Sequence> collectTraining(int round, const LayerStack* learner) = 0;

  /// Collects what the round's best epoch is chosen with, on another course. The learner leads if there is one.
  virtual std::vector<Sequence> collectValidation(int round, const LayerStack* learner) = 0;
};

/// How many rounds there are, and how each one trains.
struct ImitationRoundsParameters {
  int rounds = 1;
  int batch_steps = 0;        ///< approximate steps per update, which set trainer.batch_size; 0: that is used as it is
  TrainerParameters trainer;  ///< for each round
};

/// Imitation between two epochs: what the next epochs depend on besides the arguments.
struct ImitationState {
  std::vector<Eigen::VectorXf> learners;  ///< weights after each earlier round
  std::vector<EpochReport> curve;         ///< of the earlier rounds, one after the other
  TrainingState training;                 ///< of this round
};

std::vector<std::uint8_t> toBytes(const ImitationState& state);
/// Throws std::invalid_argument if the bytes are not those of a state.
ImitationState imitationStateFrom(const std::vector<std::uint8_t>& bytes);

/// Learning to act from a teacher, in rounds: collect, then train on everything that was collected so far. In the first
/// round only the teacher leads, later also the learner: so it also learns what to do in places that it reaches only by
/// its own mistakes (DAgger: Ross, Gordon and Bagnell, "A reduction of imitation learning and structured prediction to
/// no-regret online learning", AISTATS 2011).
///
/// With one round, and a course that holds what was recorded, it is plain supervised learning.
///
/// A step is an epoch; a judgement is due after the last epoch of each round. A checkpoint does not hold what was
/// collected: restore() collects it again.
class ImitationRounds : public SteppedTraining {
 public:
  /// Starts from the weights of `layers`. Throws std::invalid_argument for fewer than one round; step() throws as
  /// Trainer.
  ImitationRounds(const ImitationRoundsParameters& parameters, const LayerStack& layers,
                  std::unique_ptr<ImitationCourse> course);

  int round() const { return static_cast<int>(state_.learners.size()) + 1; }            ///< from 1; the current one
  int epochsOfRound() const { return static_cast<int>(state_.training.curve.size()); }  ///< done
  const EpochReport& epoch() const { return state_.training.curve.back(); }             ///< the last one
  /// Number of collected steps with a weight above 0.
  std::size_t collectedSteps() const { return countWeighted(training_); }
  TrainingResult roundResult() const { return trainer_->result(); }    ///< of its epochs so far
  std::vector<EpochReport> curve() const;                              ///< of all rounds, one after the other
  const TrainingState& state() const { return state_.training; }       ///< of this round, after its last epoch
  const std::vector<Sequence>& training() const { return training_; }  ///< all that was collected to learn from
  double progress() const;                                             ///< share of the epochs that are done

  bool done() const override { return roundDone() && round() == parameters_.rounds; }
  void step() override;
  /// Of the round's best epoch so far.
  const LayerStack& layers() const override { return layers_; }
  bool judgementDue() const override { return roundDone(); }
  std::vector<std::uint8_t> checkpoint() const override { return toBytes(state_); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override;

 protected:
  ImitationCourse& course() { return *course_; }

 private:
  bool roundDone() const { return epochsOfRound() >= parameters_.trainer.epochs; }
  void startRound();
  void endRound();
  void collect(int round);

  ImitationRoundsParameters parameters_;
  LayerStack first_layers_;
  LayerStack layers_;
  std::unique_ptr<ImitationCourse> course_;
  std::vector<Sequence> training_;
  std::vector<Sequence> validation_;
  ImitationState state_;
  std::unique_ptr<Trainer> trainer_;  ///< of this round; null before the first
};

}  // namespace lstm_planner
