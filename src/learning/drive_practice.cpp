#include "drive_practice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lstm_planner/learning/step_drive.hpp"

namespace lstm_planner {
namespace {

/// m of way counted at the most, also where no way is known.
constexpr double kLongestWay = 100.0;

AgentParameters drawAgent(const PolicyDescription& policy, Random& random) {
  AgentParameters agent = practiceAgent(policy);
  agent.step.length = policy.step_length * uniform(random, 0.75, 1.25);
  return agent;
}

/// Records a drive and chooses its actions; the agent's step listener.
class Practice {
 public:
  Practice(const DriveActorCriticParameters& parameters, const DriveExercise& exercise, const DriveTask& task,
           const StepDrive& drive, const NavigationAgent& agent, std::uint64_t seed)
      : parameters_(parameters),
        exercise_(exercise),
        task_(task),
        drive_(drive),
        agent_(agent),
        encoder_(agent.policy().description().encoder),
        random_(seed) {
    episode_.kind = exercise.kind;
  }

  std::optional<int> step(const Observation& observation) {
    const double left = wayLeft();
    finishStep(left);
    look(observation, left);
    episode_.steps.emplace_back();
    return draw() ? std::optional<int>(episode_.steps.back().action) : std::nullopt;
  }

  PracticeEpisode finish(bool arrived) {
    finishStep(arrived ? 0.0 : wayLeft());
    episode_.arrived = arrived;
    if (arrived && !episode_.steps.empty()) {
      episode_.steps.back().reward += static_cast<float>(parameters_.arrival_bonus);
    }
    return std::move(episode_);
  }

 private:
  double wayLeft() const {
    return std::min(kLongestWay, exercise_.teacher->distanceToGo({drive_.truePose().x, drive_.truePose().y}));
  }

  /// What became of the step before: its reward, and whether its action was carried out.
  void finishStep(double left) {
    if (!episode_.steps.empty()) {
      PracticeEpisode::Step& last = episode_.steps.back();
      const int contacts = drive_.contacts() - contacts_before_;
      last.reward =
          static_cast<float>(left_before_ - left - parameters_.step_cost - parameters_.contact_cost * contacts);
      const Decision& decision = agent_.decision();
      last.chosen = last.chosen && decision.source == Decision::Source::kNetwork && decision.action == last.action;
    }
    left_before_ = left;
    contacts_before_ = drive_.contacts();
  }

  void look(const Observation& observation, double left) {
    const auto own = static_cast<std::size_t>(encoder_.size());
    const std::size_t first = episode_.inputs.size();
    episode_.inputs.resize(first + own + kDrivePrivilegedInputs);
    encoder_.encode(observation, Eigen::Map<Eigen::VectorXf>(episode_.inputs.data() + first, encoder_.size()));
    if (encoder_.parameters().views != 1) episode_.bearings.push_back(bearingsOf(observation));
    float* more = episode_.inputs.data() + first + own;
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
    const std::vector<float>& preferences = agent_.decision().preferences;
    const std::vector<char> allowed = allowedActions();
    float largest = -1e30f;
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      if (allowed[i]) largest = std::max(largest, preferences[i]);
    }
    const std::size_t first = episode_.probabilities.size();
    episode_.probabilities.resize(first + allowed.size(), 0.0f);
    float* probabilities = episode_.probabilities.data() + first;
    float total = 0.0f;
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      probabilities[i] = allowed[i] ? std::exp(preferences[i] - largest) : 0.0f;
      total += probabilities[i];
    }
    if (!(total > 0.0f)) return false;
    float number = static_cast<float>(uniform(random_)) * total;
    PracticeEpisode::Step& step = episode_.steps.back();
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      if (probabilities[i] > 0.0f && (number >= 0.0f || !step.chosen)) {
        step.action = static_cast<int>(i);
        step.chosen = true;
      }
      number -= probabilities[i];
      probabilities[i] /= total;
    }
    return true;
  }

  /// As the agent will allow them.
  std::vector<char> allowedActions() const {
    const ActionSet& actions = agent_.policy().description().actions;
    const AgentParameters& agent = agent_.parameters();
    std::vector<char> allowed(static_cast<std::size_t>(actions.size()));
    for (const double clearance : {agent.shield.clearance, agent.shield.tight_clearance}) {
      for (int action = 0; action < actions.size(); ++action) {
        const double free = agent_.shield().freeDistance({}, actions.angle(action), agent.step.length, clearance);
        if (free >= agent.shield.shortest_step) allowed[static_cast<std::size_t>(action)] = true;
      }
      if (std::find(allowed.begin(), allowed.end(), true) != allowed.end()) break;
    }
    return allowed;
  }

  const DriveActorCriticParameters& parameters_;
  const DriveExercise& exercise_;
  const DriveTask& task_;
  const StepDrive& drive_;
  const NavigationAgent& agent_;
  Encoder encoder_;
  Random random_;
  PracticeEpisode episode_;
  double left_before_ = 0.0;
  int contacts_before_ = 0;
};

}  // namespace

PracticeEpisode practise(const DriveActorCriticParameters& parameters, const LayerStack& layers,
                         const DriveExercise& exercise, const DriveTask& task, std::uint64_t seed) {
  Random random(seed);
  const StepDriveConditions conditions = drawConditions(random);
  PolicyDescription description = parameters.policy;
  const AgentParameters agent_parameters = drawAgent(description, random);
  description.step_length = agent_parameters.step.length;
  NavigationAgent agent(DrivePolicy(description, layers), agent_parameters);
  StepDrive drive(*exercise.world, task, conditions, description.footprint_radius, random());
  Practice practice(parameters, exercise, task, drive, agent, random());
  agent.setStepListener(
      [&practice](const Situation&, const Observation& observation) { return practice.step(observation); });
  const DriveResult::End end = drive.run(parameters.max_steps, &agent);
  return practice.finish(end == DriveResult::End::kReached);
}

}  // namespace lstm_planner
