#include "lstm_planner/learning/imitation.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "learning/parallel_for.hpp"
#include "lstm_planner/learning/initialisation.hpp"
#include "lstm_planner/parameter_check.hpp"
#include "lstm_planner/simulation/random.hpp"

namespace lstm_planner {

namespace {

/// One drive as the learner saw it.
struct Episode {
  std::vector<Observation> observations;
  std::vector<int> labels;  ///< -1 where the teacher had no answer
  bool arrived = false;
};

/// Who is at the wheel.
enum class Driver {
  kTeacher,
  kRescuedLearner,  ///< the teacher takes over for a while when the learner is stuck
  kLearner
};

FloorPlanParameters randomPlan(Random& random) {
  FloorPlanParameters plan;
  plan.width = uniform(random, 8.0, 24.0);
  plan.height = uniform(random, 8.0, 18.0);
  plan.smallest_room = uniform(random, 2.2, 4.5);
  plan.door_width = uniform(random, 0.75, 1.3);
  plan.extra_doors = uniform(random, 0.0, 0.6);
  plan.furniture = uniform(random, 0.0, 0.1);
  return plan;
}

DriveParameters driveParameters(const ImitationParameters& parameters) {
  DriveParameters drive;
  // A third of the beams: the averages hardly change and the simulation is three times as fast.
  drive.robot.scanner.beams = 361;
  drive.robot.scanner.angle_increment = 2.0 * 2.35619 / 360.0;
  drive.robot.physics_period = 0.05;
  drive.time_limit = parameters.episode_limit;
  return drive;
}

AgentParameters agentParameters(const PolicyDescription& policy) {
  AgentParameters agent;
  agent.step.length = policy.step_length;
  agent.shield.footprint_radius = policy.footprint_radius;
  agent.escape.enabled = false;
  return agent;
}

/// Drives once, asks the teacher at every step and lets the driver choose.
Episode driveEpisode(const GridWorld& world, const DriveTask& task, const ImitationParameters& parameters,
                     const LayerStack& layers, Driver driver, std::uint64_t seed) {
  const Teacher teacher(world, task.goal, {});
  NavigationAgent agent(DrivePolicy(parameters.policy, layers), agentParameters(parameters.policy));
  Episode episode;
  double best = std::numeric_limits<double>::infinity();
  int since_best = 0;
  int rescue = 0;
  agent.setStepListener([&](const Situation& situation, const Observation& observation) -> std::optional<int> {
    const Point2 position = toParentFrame(task.start, {situation.pose.x, situation.pose.y});
    double direction = 0.0;
    const bool known = teacher.direction(position, &direction);
    const double heading = task.start.yaw + situation.pose.yaw;
    const int label = known ? parameters.policy.actions.nearest(normalizeAngle(direction - heading)) : -1;
    episode.observations.push_back(observation);
    episode.labels.push_back(label);

    const double left = teacher.distanceToGo(position);
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
  const DriveResult result = drive(world, task, driveParameters(parameters), seed, &agent);
  episode.arrived = result.end == DriveResult::End::kReached;
  return episode;
}

/// A floor plan and its drives, all from one seed.
struct Exercise {
  std::unique_ptr<GridWorld> world;
  std::vector<DriveTask> tasks;
};

Exercise makeExercise(int episodes, std::uint64_t seed) {
  Random random(seed);
  Exercise exercise;
  exercise.world = std::make_unique<GridWorld>(generateFloorPlan(randomPlan(random), random()));
  exercise.tasks = drawTasks(*exercise.world, episodes, Teacher::Parameters{}.footprint_radius, 0.12, 2.0, random());
  return exercise;
}

/// Seeds of training and validation plans never meet: the upper half of the numbers is for validation.
std::uint64_t planSeed(std::uint64_t seed, bool validation, int round, int plan) {
  Random random(seed * 1000003ULL + static_cast<std::uint64_t>(round) * 8191ULL + static_cast<std::uint64_t>(plan));
  const std::uint64_t number = random() >> 1;
  return validation ? number | (1ULL << 63) : number;
}

/// Calls `choose_driver` for each drive of a round and lets that driver drive it.
template <typename ChooseDriver>
std::vector<Episode> collect(const ImitationParameters& parameters, const LayerStack& layers, int round,
                             bool validation, const ChooseDriver& choose_driver,
                             const std::function<void(int)>& report) {
  const int plans = validation ? parameters.validation_plans : parameters.plans;
  std::vector<std::vector<Episode>> episodes(static_cast<std::size_t>(plans));
  std::atomic<int> done{0};
  const auto work = [&](int plan, int thread) {
    const std::uint64_t seed = planSeed(parameters.seed, validation, round, plan);
    const Exercise exercise = makeExercise(parameters.episodes, seed);
    Random random(seed + 1);
    for (const DriveTask& task : exercise.tasks) {
      const Driver driver = choose_driver(random);
      episodes[static_cast<std::size_t>(plan)].push_back(
          driveEpisode(*exercise.world, task, parameters, layers, driver, random()));
    }
    ++done;
    if (thread == 0) {
      report(done);
    }
  };
  parallelFor(plans, parameters.threads, work);
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

}  // namespace

void validate(const ImitationParameters& parameters) {
  checkParameter(parameters.rounds > 0, "rounds", parameters.rounds, "a positive number");
  checkParameter(parameters.plans > 0, "plans", parameters.plans, "a positive number");
  checkParameter(parameters.episodes > 0, "episodes", parameters.episodes, "a positive number");
  checkParameter(parameters.validation_plans > 0, "validation_plans", parameters.validation_plans, "a positive number");
  checkParameter(parameters.learner_share >= 0.0 && parameters.learner_share <= 1.0, "learner_share",
                 parameters.learner_share, "a share in [0, 1]");
  checkParameter(parameters.episode_limit > 0.0, "episode_limit", parameters.episode_limit, "a positive number");
  checkParameter(parameters.burn_in_steps >= 0, "burn_in_steps", parameters.burn_in_steps, "zero or more");
  checkParameter(parameters.sequence_steps > parameters.burn_in_steps, "sequence_steps", parameters.sequence_steps,
                 "more than burn_in_steps");
  checkParameter(parameters.threads > 0, "threads", parameters.threads, "a positive number");
  validate(parameters.policy.encoder);
  validate(parameters.trainer);
}

ImitationResult imitate(const ImitationParameters& parameters, const ProgressCallback& progress,
                        const RoundCallback& round_done) {
  validate(parameters);
  const Encoder encoder(parameters.policy.encoder);
  LayerStack layers = makeLstmStack(encoder.size(), parameters.cells, parameters.policy.actions.size());
  initialise({}, parameters.seed, layers);

  // Training costs little beside the simulation: progress counts plans.
  const double plans_a_round = parameters.plans + parameters.validation_plans;
  const double all_plans = parameters.rounds * plans_a_round + parameters.validation_plans;
  double plans_before = 0.0;
  const auto report = [&](int plans) {
    if (progress) {
      progress((plans_before + plans) / all_plans);
    }
  };

  const auto teacher = [](Random&) { return Driver::kTeacher; };
  const auto learner = [](Random&) { return Driver::kLearner; };
  const auto mixture = [&](Random& random) {
    return uniform(random) < parameters.learner_share ? Driver::kRescuedLearner : Driver::kTeacher;
  };

  // The same plans judge every round: first as the teacher drives there, then, added to that, as each learner did.
  std::vector<Sequence> validation;
  cutIntoSequences(collect(parameters, layers, 0, true, teacher, report), parameters, &validation);
  plans_before += parameters.validation_plans;

  ImitationResult result;
  std::vector<Sequence> training;
  std::size_t steps = 0;
  double best_arrival = -1.0;
  for (int round = 0; round < parameters.rounds; ++round) {
    const std::vector<Episode> episodes = round == 0 ? collect(parameters, layers, round, false, teacher, report)
                                                     : collect(parameters, layers, round, false, mixture, report);
    plans_before += parameters.plans;
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
    plans_before += parameters.validation_plans;
    const auto arrived = std::count_if(judged.begin(), judged.end(), [](const Episode& e) { return e.arrived; });
    outcome.arrival = static_cast<double>(arrived) / static_cast<double>(judged.size());
    cutIntoSequences(judged, parameters, &validation);
    if (outcome.arrival >= best_arrival) {
      best_arrival = outcome.arrival;
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
