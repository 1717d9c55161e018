#include "lstm_planner/practice/imitation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/practice/recorded_choices.hpp"
#include "lstm_planner/practice/step_simulator.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/teacher_rescue.hpp"

namespace lstm_planner {

namespace {

constexpr double kLearnerShare = 0.8;  ///< of the drives, from the second round on

/// m; a learner that comes less near to the goal than that makes no progress.
constexpr double kNearer = 0.1;
constexpr int kStuckSteps = 24;   ///< without progress, after which the teacher takes the wheel
constexpr int kRescueSteps = 16;  ///< and for how long

constexpr int kSequenceSteps = 96;  ///< length of a training sequence
constexpr int kBurnInSteps = 32;    ///< of these, steps that only bring the hidden state up to date

/// One drive as the learner saw it.
struct LabelledEpisode {
  std::vector<RecordedChoice> steps;  ///< with the teacher's answer, where it had one
  bool arrived = false;
  double efficiency = 0.0;  ///< best / driven path if it arrived, else 0; see DriveScore
};

/// Who is at the wheel.
enum class Driver {
  kTeacher,
  kRescuedLearner,  ///< the teacher takes over for a while when the learner is stuck
  kLearner
};

/// Drives once, asks the teacher at every step and lets the driver choose.
LabelledEpisode driveEpisode(const DriveExercise& exercise, const DriveTask& task,
                             const ImitationParameters& parameters, const LayerStack& layers, Driver driver,
                             std::uint64_t seed) {
  Random random(seed);
  const PracticeConditions conditions = drawConditions(random);
  PolicyDescription policy = parameters.policy;
  policy.footprint_radius = kPracticeRadius;
  NavigationAgent agent(DrivePolicy(policy, layers), practiceAgent(policy));
  StepSimulator drive(*exercise.world, task, conditions, random());
  LabelledEpisode episode;
  TeacherRescue rescue(kNearer, kStuckSteps, kRescueSteps);
  agent.setStepListener([&](const Situation&, const Observation& observation) -> std::optional<int> {
    const Pose2& pose = drive.truePose();
    double direction = 0.0;
    const bool known = exercise.teacher->direction({pose.x, pose.y}, &direction);
    const double wanted = normalizeAngle(direction - pose.yaw);
    const int label = known ? parameters.policy.actions.nearest(wanted) : -1;
    episode.steps.push_back({observation, label});
    const bool teacher_drives =
        driver == Driver::kTeacher ||
        (driver == Driver::kRescuedLearner && rescue.wanted(exercise.teacher->distanceToGo({pose.x, pose.y})));
    return known && teacher_drives ? std::optional<int>(label) : std::nullopt;
  });
  episode.arrived = drive.run(parameters.max_steps, &agent) == LoopEnd::kArrived;
  if (episode.arrived) episode.efficiency = drive.efficiency();
  return episode;
}

DriveScore scoreOf(const std::vector<LabelledEpisode>& episodes) {
  DriveScore score;
  score.drives = static_cast<int>(episodes.size());
  for (const LabelledEpisode& episode : episodes) {
    score.arrival += (episode.arrived ? 1.0 : 0.0) / score.drives;
    score.efficiency += episode.efficiency / score.drives;
  }
  return score;
}

LayerStack firstLayers(const ImitationParameters& parameters) {
  return initialised(
      makeNetwork(Encoder(parameters.policy.encoder).size(), parameters.shape, parameters.policy.actions.size()),
      parameters.seed);
}

ImitationRoundsParameters roundsOf(const ImitationParameters& parameters) {
  ImitationRoundsParameters rounds;
  rounds.rounds = parameters.rounds;
  rounds.trainer = parameters.trainer;
  return rounds;
}

}  // namespace

/// Drives in generated worlds. The same worlds judge every round: first as the teacher drives there, then, added to
/// that, as each learner did.
class DriveImitationCourse : public ImitationCourse {
 public:
  DriveImitationCourse(const ImitationParameters& parameters, const ProgressCallback& progress)
      : parameters_((validate(parameters), parameters)), layers_(firstLayers(parameters)), progress_(progress) {}

  std::vector<Sequence> collectTraining(int round, const LayerStack* learner) override {
    const auto driver = [&](Random& random) {
      if (learner == nullptr) return Driver::kTeacher;
      return uniform(random) < kLearnerShare ? Driver::kRescuedLearner : Driver::kTeacher;
    };
    const std::vector<LabelledEpisode> episodes = drive(learner != nullptr ? *learner : layers_, round, false, driver);
    for (const LabelledEpisode& episode : episodes) steps_ += episode.steps.size();
    return cut(episodes);
  }

  std::vector<Sequence> collectValidation(int /*round*/, const LayerStack* learner) override {
    if (learner == nullptr) return cut(drive(layers_, 0, true, [](Random&) { return Driver::kTeacher; }));
    // After a checkpoint nobody has judged it in this process.
    if (!wasJudged(*learner)) judge(*learner);
    return std::move(judged_);
  }

  /// By its own drives in the validation worlds, which are then the next to be validated by.
  DriveScore judge(const LayerStack& learner) {
    const std::vector<LabelledEpisode> episodes = drive(learner, 0, true, [](Random&) { return Driver::kLearner; });
    judged_ = cut(episodes);
    judged_learner_ = parameterVector(learner);
    return scoreOf(episodes);
  }

  std::size_t steps() const { return steps_; }  ///< of all drives to learn from

  double share() const { return shareOf(worlds_before_); }

 private:
  bool wasJudged(const LayerStack& learner) const {
    const Eigen::VectorXf weights = parameterVector(learner);
    return judged_learner_.size() == weights.size() && judged_learner_ == weights;
  }

  /// Calls `choose_driver` for each drive of a round and lets that driver drive it.
  template <typename ChooseDriver>
  std::vector<LabelledEpisode> drive(const LayerStack& layers, int round, bool validation,
                                     const ChooseDriver& choose_driver) {
    const int worlds = validation ? parameters_.validation_worlds : parameters_.worlds;
    std::vector<std::vector<LabelledEpisode>> episodes(static_cast<std::size_t>(worlds));
    std::atomic<int> done{0};
    const auto work = [&](int world, int thread) {
      const int number = round * parameters_.worlds + world;
      const WorldUse use = validation ? WorldUse::kValidation : WorldUse::kTraining;
      Random random(parameters_.seed * 1000003ULL + static_cast<std::uint64_t>(2 * number + (validation ? 1 : 0)));
      for (const DriveExercise& exercise : makeDriveExercises(parameters_.course, use, parameters_.seed, number,
                                                              parameters_.goals, parameters_.starts)) {
        for (const DriveTask& task : exercise.tasks) {
          const Driver driver = choose_driver(random);
          episodes[static_cast<std::size_t>(world)].push_back(
              driveEpisode(exercise, task, parameters_, layers, driver, random()));
        }
      }
      ++done;
      if (thread == 0) reportProgress(done);
    };
    parallelFor(worlds, parameters_.threads, work);
    worlds_before_ += worlds;
    std::vector<LabelledEpisode> all;
    for (std::vector<LabelledEpisode>& some : episodes) std::move(some.begin(), some.end(), std::back_inserter(all));
    return all;
  }

  double shareOf(double worlds) const {
    const double worlds_a_round = parameters_.worlds + parameters_.validation_worlds;
    return worlds / (parameters_.rounds * worlds_a_round + parameters_.validation_worlds);
  }

  void reportProgress(int worlds) const {
    if (progress_) progress_(shareOf(worlds_before_ + worlds));
  }

  std::vector<Sequence> cut(const std::vector<LabelledEpisode>& episodes) const {
    const Encoder encoder(parameters_.policy.encoder);
    const SequenceCut pieces = overlappingPieces(kSequenceSteps, kBurnInSteps);
    std::vector<Sequence> sequences;
    for (const LabelledEpisode& episode : episodes)
      cutIntoPieces(toSequence(episode.steps, encoder), pieces, &sequences);
    return sequences;
  }

  const ImitationParameters parameters_;
  const LayerStack layers_;  ///< not asked while the teacher drives
  const ProgressCallback progress_;
  std::vector<Sequence> judged_;    ///< drives of the learner that was judged last
  Eigen::VectorXf judged_learner_;  ///< its weights
  std::size_t steps_ = 0;
  double worlds_before_ = 0.0;
};

void validate(const ImitationParameters& parameters) {
  visitImitationParameters(parameters, RangeCheck());
  checkPositive("validation_worlds", parameters.validation_worlds);
  checkPositive("max_steps", parameters.max_steps);
  checkPositive("threads", parameters.threads);
  validate(parameters.policy.encoder);
  checkParameter(parameters.policy.encoder.views == 1, "views", parameters.policy.encoder.views,
                 "1: eight views learn by reinforcement only");
  validate(parameters.course);
  validate(parameters.trainer);
}

DriveImitation::DriveImitation(const ImitationParameters& parameters, const ProgressCallback& progress)
    : DriveImitation(parameters, std::make_unique<DriveImitationCourse>(parameters, progress)) {}

DriveImitation::DriveImitation(const ImitationParameters& parameters, std::unique_ptr<DriveImitationCourse> course)
    : ImitationRounds(roundsOf(parameters), firstLayers(parameters), std::move(course)),
      course_(static_cast<DriveImitationCourse&>(ImitationRounds::course())) {}

std::size_t DriveImitation::drivenSteps() const { return course_.steps(); }
double DriveImitation::drivenShare() const { return course_.share(); }
DriveScore DriveImitation::judge(const LayerStack& layers) { return course_.judge(layers); }

}  // namespace lstm_planner
