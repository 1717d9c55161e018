#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/training/sequence.hpp"
#include "lstm_planner/training/trainer.hpp"
#include "lstm_planner/training/training_loop.hpp"

namespace lstm_planner {

/// Where imitation learns: collects steps, and what a teacher answers there. The same for the same arguments.
class ImitationCourse {
 public:
  virtual ~ImitationCourse() = default;

  /// To learn from in round `round` (from 0). The teacher leads; `learner`, null in the first round only, leads some of
  /// the episodes.
  virtual std::vector<Sequence> collectTraining(int round, const LayerStack* learner) = 0;

  /// To choose the round's best epoch by, on another course. The learner leads where there is one.
  virtual std::vector<Sequence> collectValidation(int round, const LayerStack* learner) = 0;
};

/// How often is collected, and how is trained between.
struct ImitationRoundsParameters {
  int rounds = 1;
  int batch_steps = 0;        ///< steps an update, about, which set trainer.batch_size; 0: as that says
  TrainerParameters trainer;  ///< for each round
};

/// Imitation between two epochs: what the epochs to come depend on besides the arguments.
struct ImitationState {
  std::vector<Eigen::VectorXf> learners;  ///< weights after each round before this one
  std::vector<EpochReport> curve;         ///< of these rounds, one after the other
  TrainingState training;                 ///< of this round
};

std::vector<std::uint8_t> toBytes(const ImitationState& state);
/// Throws std::invalid_argument when the bytes are not those of a state.
ImitationState imitationStateFrom(const std::vector<std::uint8_t>& bytes);

/// Learning to act from a teacher, in rounds: collect, then train on everything that was collected so far. In the first
/// round the teacher leads, later the learner too, so that it also learns what to do where only its own mistakes bring
/// it (DAgger: Ross, Gordon and Bagnell, "A reduction of imitation learning and structured prediction to no-regret
/// online learning", AISTATS 2011).
///
/// With one round, and a course that holds what was recorded, it is plain supervised learning.
///
/// A step is an epoch; after the last one of each round it is time to judge. What was collected before a checkpoint is
/// collected anew, as it is not kept.
class ImitationRounds : public SteppedTraining {
 public:
  /// From the weights of `layers`. Throws std::invalid_argument without rounds, later as Trainer.
  ImitationRounds(const ImitationRoundsParameters& parameters, const LayerStack& layers,
                  std::unique_ptr<ImitationCourse> course);

  int round() const { return static_cast<int>(state_.learners.size()) + 1; }  ///< from 1, that goes on or just ended
  int epochsOfRound() const { return static_cast<int>(state_.training.curve.size()); }  ///< that are done
  const EpochReport& epoch() const { return state_.training.curve.back(); }             ///< that was done last
  /// Collected so far, and with a weight.
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
