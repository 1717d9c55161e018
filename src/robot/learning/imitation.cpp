#include "lstm_planner/robot/learning/imitation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "lstm_planner/base/common/parallel_for.hpp"
#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/robot/learning/step_drive.hpp"

namespace lstm_planner {

namespace {

/// One drive as the learner saw it.
struct Episode {
  std::vector<Observation> observations;
  std::vector<int> labels;  ///< -1 where the teacher had no answer
  bool arrived = false;
  double efficiency = 0.0;  ///< shortest / driven path if it arrived, else 0
};

/// Who is at the wheel.
enum class Driver {
  kTeacher,
  kRescuedLearner,  ///< the teacher takes over for a while when the learner is stuck
  kLearner
};

/// Drives once, asks the teacher at every step and lets the driver choose.
Episode driveEpisode(const DriveExercise& exercise, const DriveTask& task, const ImitationParameters& parameters,
                     const LayerStack& layers, Driver driver, std::uint64_t seed) {
  Random random(seed);
  const StepDriveConditions conditions = drawConditions(random);
  NavigationAgent agent(DrivePolicy(parameters.policy, layers), practiceAgent(parameters.policy));
  StepDrive drive(*exercise.world, task, conditions, parameters.policy.footprint_radius, random());
  Episode episode;
  double best = std::numeric_limits<double>::infinity();
  int since_best = 0;
  int rescue = 0;
  agent.setStepListener([&](const Situation&, const Observation& observation) -> std::optional<int> {
    const Pose2& pose = drive.truePose();
    double direction = 0.0;
    const bool known = exercise.teacher->direction({pose.x, pose.y}, &direction);
    const double wanted = normalizeAngle(direction - pose.yaw);
    const int label = known ? parameters.policy.actions.nearest(wanted) : -1;
    episode.observations.push_back(observation);
    episode.labels.push_back(label);

    const double left = exercise.teacher->distanceToGo({pose.x, pose.y});
    since_best = left < best - 0.1 ? 0 : since_best + 1;
    best = std::min(best, left);
    if (driver == Driver::kRescuedLearner && since_best >= parameters.stuck_steps) {
      since_best = 0;
      rescue = parameters.rescue_steps;
    }
    const bool teacher_drives = known && (driver == Driver::kTeacher || rescue > 0);
    rescue = std::max(0, rescue - 1);
    return teacher_drives ? std::optional<int>(label) : std::nullopt;
  });
  episode.arrived = drive.run(parameters.max_steps, &agent) == DriveResult::End::kReached;
  if (episode.arrived) episode.efficiency = task.shortest / std::max(task.shortest, drive.pathLength());
  return episode;
}

/// Calls `choose_driver` for each drive of a round and lets that driver drive it.
template <typename ChooseDriver>
std::vector<Episode> collect(const ImitationParameters& parameters, const LayerStack& layers, int round,
                             bool validation, const ChooseDriver& choose_driver,
                             const std::function<void(int)>& report) {
  const int worlds = validation ? parameters.validation_worlds : parameters.worlds;
  std::vector<std::vector<Episode>> episodes(static_cast<std::size_t>(worlds));
  std::atomic<int> done{0};
  const auto work = [&](int world, int thread) {
    const int number = round * parameters.worlds + world;
    const WorldUse use = validation ? WorldUse::kValidation : WorldUse::kTraining;
    Random random(parameters.seed * 1000003ULL + static_cast<std::uint64_t>(2 * number + (validation ? 1 : 0)));
    for (const DriveExercise& exercise :
         makeDriveExercises(parameters.course, use, parameters.seed, number, parameters.goals, parameters.starts)) {
      for (const DriveTask& task : exercise.tasks) {
        const Driver driver = choose_driver(random);
        episodes[static_cast<std::size_t>(world)].push_back(
            driveEpisode(exercise, task, parameters, layers, driver, random()));
      }
    }
    ++done;
    if (thread == 0) {
      report(done);
    }
  };
  parallelFor(worlds, parameters.threads, work);
  std::vector<Episode> all;
  for (std::vector<Episode>& some : episodes) {
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

/// Cuts episodes into overlapping sequences: the first steps of all but the first only bring the hidden state up to
/// date.
void cutIntoSequences(const std::vector<Episode>& episodes, const ImitationParameters& parameters,
                      std::vector<Sequence>* sequences) {
  const Encoder encoder(parameters.policy.encoder);
  const int stride = parameters.sequence_steps - parameters.burn_in_steps;
  for (const Episode& episode : episodes) {
    const int steps = static_cast<int>(episode.labels.size());
    for (int fresh = 0; fresh < steps; fresh += fresh == 0 ? parameters.sequence_steps : stride) {
      const int begin = fresh == 0 ? 0 : fresh - parameters.burn_in_steps;
      const int end = std::min(steps, begin + parameters.sequence_steps);
      Sequence sequence;
      sequence.inputs.resize(encoder.size(), end - begin);
      sequence.labels.setZero(end - begin);
      sequence.weights.setZero(end - begin);
      for (int step = begin; step < end; ++step) {
        const auto i = static_cast<std::size_t>(step);
        encoder.encode(episode.observations[i], sequence.inputs.col(step - begin));
        if (episode.labels[i] >= 0 && step >= fresh) {
          sequence.labels[step - begin] = episode.labels[i];
          sequence.weights[step - begin] = 1.0f;
        }
      }
      sequences->push_back(std::move(sequence));
    }
  }
}

DriveScore scoreOf(const std::vector<Episode>& episodes) {
  DriveScore score;
  score.drives = static_cast<int>(episodes.size());
  for (const Episode& episode : episodes) {
    score.arrival += (episode.arrived ? 1.0 : 0.0) / score.drives;
    score.efficiency += episode.efficiency / score.drives;
  }
  return score;
}

}  // namespace

void validate(const ImitationParameters& parameters) {
  checkParameter(parameters.rounds > 0, "rounds", parameters.rounds, "a positive number");
  checkParameter(parameters.worlds > 0, "worlds", parameters.worlds, "a positive number");
  checkParameter(parameters.goals > 0, "goals", parameters.goals, "a positive number");
  checkParameter(parameters.starts > 0, "starts", parameters.starts, "a positive number");
  checkParameter(parameters.validation_worlds > 0, "validation_worlds", parameters.validation_worlds,
                 "a positive number");
  checkParameter(parameters.learner_share >= 0.0 && parameters.learner_share <= 1.0, "learner_share",
                 parameters.learner_share, "a share in [0, 1]");
  checkParameter(parameters.max_steps > 0, "max_steps", parameters.max_steps, "a positive number");
  checkParameter(parameters.burn_in_steps >= 0, "burn_in_steps", parameters.burn_in_steps, "zero or more");
  checkParameter(parameters.sequence_steps > parameters.burn_in_steps, "sequence_steps", parameters.sequence_steps,
                 "more than burn_in_steps");
  checkParameter(parameters.threads > 0, "threads", parameters.threads, "a positive number");
  validate(parameters.policy.encoder);
  checkParameter(parameters.policy.encoder.views == 1, "views", parameters.policy.encoder.views,
                 "1: eight views learn by reinforcement only");
  validate(parameters.course);
  validate(parameters.trainer);
}

ImitationResult imitate(const ImitationParameters& parameters, const ProgressCallback& progress,
                        const RoundCallback& round_done) {
  validate(parameters);
  const Encoder encoder(parameters.policy.encoder);
  LayerStack layers = makeNetwork(encoder.size(), parameters.shape, parameters.policy.actions.size());
  initialise({}, parameters.seed, layers);

  // Training costs little beside the simulation: progress counts worlds.
  const double worlds_a_round = parameters.worlds + parameters.validation_worlds;
  const double all_worlds = parameters.rounds * worlds_a_round + parameters.validation_worlds;
  double worlds_before = 0.0;
  const auto report = [&](int worlds) {
    if (progress) {
      progress((worlds_before + worlds) / all_worlds);
    }
  };

  const auto teacher = [](Random&) { return Driver::kTeacher; };
  const auto learner = [](Random&) { return Driver::kLearner; };
  const auto mixture = [&](Random& random) {
    return uniform(random) < parameters.learner_share ? Driver::kRescuedLearner : Driver::kTeacher;
  };

  // The same worlds judge every round: first as the teacher drives there, then, added to that, as each learner did.
  std::vector<Sequence> validation;
  cutIntoSequences(collect(parameters, layers, 0, true, teacher, report), parameters, &validation);
  worlds_before += parameters.validation_worlds;

  ImitationResult result;
  std::vector<Sequence> training;
  std::size_t steps = 0;
  double best_efficiency = -1.0;
  for (int round = 0; round < parameters.rounds; ++round) {
    const std::vector<Episode> episodes = round == 0 ? collect(parameters, layers, round, false, teacher, report)
                                                     : collect(parameters, layers, round, false, mixture, report);
    worlds_before += parameters.worlds;
    for (const Episode& episode : episodes) {
      steps += episode.labels.size();
    }
    cutIntoSequences(episodes, parameters, &training);

    ImitationRound outcome;
    outcome.round = round + 1;
    outcome.steps = steps;
    outcome.training = train(layers, training, validation, parameters.trainer);
    layers = outcome.training.layers;

    const std::vector<Episode> judged = collect(parameters, layers, 0, true, learner, report);
    worlds_before += parameters.validation_worlds;
    outcome.score = scoreOf(judged);
    cutIntoSequences(judged, parameters, &validation);
    if (outcome.score.efficiency >= best_efficiency) {
      best_efficiency = outcome.score.efficiency;
      result.layers = layers;
    }
    if (round_done) {
      round_done(outcome);
    }
    result.rounds.push_back(std::move(outcome));
  }
  return result;
}

}  // namespace lstm_planner
