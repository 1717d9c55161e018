#include "practice/drive_practice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/drive/decision/action_choice.hpp"
#include "lstm_planner/practice/step_simulator.hpp"
#include "lstm_planner/training/policy_gradient.hpp"
#include "practice/path_example.hpp"

namespace lstm_planner {
namespace {

/// m of path counted at the most, also where no path is known.
constexpr double kLongestPath = 100.0;

// Of the reward, m.
constexpr double kStepCost = 0.05;
constexpr double kArrivalBonus = 3.0;
constexpr double kContactCost = 0.5;

/// Records a drive and chooses its actions; the agent's step listener.
class Practice {
 public:
  Practice(const DriveActorCriticParameters& parameters, const DriveExercise& exercise, const DriveTask& task,
           const StepSimulator& drive, const NavigationAgent& agent, std::uint64_t seed)
      : parameters_(parameters),
        exercise_(exercise),
        task_(task),
        drive_(drive),
        agent_(agent),
        encoder_(agent.policy().description().encoder),
        random_(seed) {
    episode_.kind = exercise.kind;
    pathLeft();
  }

  std::optional<int> step(const Observation& observation) {
    const double left = pathLeft();
    finishStep(left);
    noteInputs(observation, left);
    return draw() ? std::optional<int>(episode_.steps.back().action) : std::nullopt;
  }

  PracticeEpisode finish(bool arrived) {
    finishStep(arrived ? 0.0 : pathLeft());
    episode_.arrived = arrived;
    if (arrived && !episode_.steps.empty()) {
      episode_.steps.back().reward += static_cast<float>(kArrivalBonus);
    }
    return std::move(episode_);
  }

 private:
  /// The last that was known where the teacher knows no path, in a corner too narrow for it: to come there and to leave
  /// again is neither punished nor paid.
  double pathLeft() {
    const double left = exercise_.teacher->distanceToGo({drive_.truePose().x, drive_.truePose().y});
    if (std::isfinite(left)) left_known_ = std::min(kLongestPath, left);
    return left_known_;
  }

  /// What became of the step before: its reward, and whether its action was carried out.
  void finishStep(double left) {
    if (!episode_.steps.empty()) {
      PracticeEpisode::Step& last = episode_.steps.back();
      const int contacts = drive_.contacts() - contacts_before_;
      last.reward = static_cast<float>(left_before_ - left - kStepCost - kContactCost * contacts);
      const Decision& decision = agent_.decision();
      last.chosen = last.chosen && decision.choice == Leader::kNetwork && decision.action == last.action;
    }
    left_before_ = left;
    contacts_before_ = drive_.contacts();
  }

  void noteInputs(const Observation& observation, double left) {
    float* more = addStep(encoder_, observation, &episode_);
    const Pose2& pose = drive_.truePose();
    double direction = pose.yaw;
    exercise_.teacher->direction({pose.x, pose.y}, &direction);
    const double straight = std::max(0.1, distanceBetween(pose, task_.goal));
    more[0] = static_cast<float>(std::log2(left + 1.0) / 4.0);
    more[1] = static_cast<float>(1.0 - std::pow(parameters_.discount, left / 0.15));
    more[2] = static_cast<float>(std::log2(std::max(1.0, left / straight)) / 3.0);
    more[3] = static_cast<float>(std::sin(direction - pose.yaw));
    more[4] = static_cast<float>(std::cos(direction - pose.yaw));
  }

  /// Draws the action of the step; false when the shield allows none.
  bool draw() {
    const std::vector<char> allowed = allowedActions();
    const std::size_t first = episode_.probabilities.size();
    episode_.probabilities.resize(first + allowed.size(), 0.0f);
    float* probabilities = episode_.probabilities.data() + first;
    const std::vector<float>& preferences = agent_.decision().preferences;
    const float total = fillChances(
        static_cast<int>(allowed.size()), [&](int action) { return allowed[static_cast<std::size_t>(action)] != 0; },
        [&](int action) { return preferences[static_cast<std::size_t>(action)]; }, probabilities);
    if (!(total > 0.0f)) return false;
    PracticeEpisode::Step& step = episode_.steps.back();
    step.action = drawByChances(static_cast<int>(allowed.size()), total, &random_, probabilities);
    step.chosen = true;
    return true;
  }

  /// As the agent will allow them.
  std::vector<char> allowedActions() const {
    const ActionSet& actions = agent_.policy().description().actions;
    std::vector<char> allowed(static_cast<std::size_t>(actions.size()));
    chooseAction(agent_.parameters(), actions, 0.0, 0.0, agent_.shield(), agent_.decision().preferences, std::nullopt,
                 &allowed);
    return allowed;
  }

  const DriveActorCriticParameters& parameters_;
  const DriveExercise& exercise_;
  const DriveTask& task_;
  const StepSimulator& drive_;
  const NavigationAgent& agent_;
  Encoder encoder_;
  Random random_;
  PracticeEpisode episode_;
  double left_known_ = kLongestPath;
  double left_before_ = 0.0;
  int contacts_before_ = 0;
};

PracticeEpisode practiseAlone(const DriveActorCriticParameters& parameters, const LayerStack& layers,
                              const DriveExercise& exercise, const DriveTask& task, std::uint64_t seed) {
  Random random(seed);
  const PracticeConditions conditions = drawConditions(random);
  NavigationAgent agent = drawRobot(practiceAgent(parameters.policy), parameters.policy, layers, random);
  StepSimulator drive(*exercise.world, task, conditions, random());
  Practice practice(parameters, exercise, task, drive, agent, random());
  agent.setStepListener(
      [&practice](const Situation&, const Observation& observation) { return practice.step(observation); });
  const LoopEnd end = drive.run(parameters.max_steps, &agent);
  return practice.finish(end == LoopEnd::kArrived);
}

}  // namespace

std::vector<PracticeEpisode> practise(const DriveActorCriticParameters& parameters, const LayerStack& layers,
                                      int iteration) {
  std::vector<std::vector<PracticeEpisode>> by_world(static_cast<std::size_t>(parameters.worlds));
  parallelFor(parameters.worlds, parameters.threads, [&](int world, int) {
    const int number = iteration * parameters.worlds + world;
    Random seeds(parameters.seed * 1000003ULL + static_cast<std::uint64_t>(number));
    for (const DriveExercise& exercise : makeDriveExercises(parameters.course, WorldUse::kTraining, parameters.seed,
                                                            number, parameters.goals, parameters.starts)) {
      for (const DriveTask& task : exercise.tasks) {
        const std::uint64_t seed = seeds();
        Random lot(~seed);
        const auto drive = uniform(lot) < parameters.path_share ? drivePathExample : practiseAlone;
        by_world[static_cast<std::size_t>(world)].push_back(drive(parameters, layers, exercise, task, seed));
      }
    }
  });
  std::vector<PracticeEpisode> episodes;
  for (std::vector<PracticeEpisode>& some : by_world) {
    for (PracticeEpisode& episode : some) {
      if (!episode.steps.empty()) episodes.push_back(std::move(episode));
    }
  }
  if (episodes.empty()) throw std::runtime_error("no drive of the iteration had a step to learn from");
  return episodes;
}

}  // namespace lstm_planner
