#include "practice/path_example.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/practice/step_simulator.hpp"

namespace lstm_planner {
namespace {

/// Records a drive; the agent's step listener. What was decided in a step is known when the next one begins.
class PathExample {
 public:
  PathExample(std::size_t kind, float weight, const NavigationAgent& agent)
      : agent_(agent), weight_(weight), encoder_(agent.policy().description().encoder) {
    episode_.kind = kind;
    episode_.is_example = true;
  }

  void step(const Observation& observation) {
    finishStep();
    addStep(encoder_, observation, &episode_);
  }

  PracticeEpisode finish() {
    finishStep();
    return std::move(episode_);
  }

 private:
  void finishStep() {
    if (episode_.steps.empty()) return;
    const Decision& decision = agent_.decision();
    PracticeEpisode::Step& last = episode_.steps.back();
    last.action = std::max(0, decision.along_path);
    last.chosen = decision.along_path >= 0 && decision.allowed[static_cast<std::size_t>(last.action)] != 0;
    last.weight = weight_;
    for (const char allowed : decision.allowed) episode_.probabilities.push_back(allowed != 0 ? 1.0f : 0.0f);
  }

  const NavigationAgent& agent_;
  const float weight_;
  const Encoder encoder_;
  PracticeEpisode episode_;
};

}  // namespace

PracticeEpisode drivePathExample(const DriveActorCriticParameters& parameters, const LayerStack& layers,
                                 const DriveExercise& exercise, const DriveTask& task, std::uint64_t seed) {
  Random random(seed);
  PracticeConditions conditions = drawConditions(random);
  conditions.travel_error = 0.0;
  conditions.turn_error = 0.0;
  NavigationAgent agent = drawRobot(AgentParameters(), parameters.policy, layers, random);
  StepSimulator drive(*exercise.world, task, conditions, random());
  PathExample example(exercise.kind, static_cast<float>(parameters.path_weight), agent);
  agent.setStepListener([&example](const Situation&, const Observation& observation) {
    example.step(observation);
    return std::nullopt;
  });
  drive.run(parameters.max_steps, &agent);
  return example.finish();
}

}  // namespace lstm_planner
