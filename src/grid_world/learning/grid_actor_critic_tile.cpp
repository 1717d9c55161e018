#include "grid_world/learning/grid_actor_critic_tile.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/base/learning/actor_critic.hpp"
#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/base/learning/lane_kernels.hpp"

namespace lstm_planner {
namespace {

/// Lanes that keep a step's rows in the first cache.
constexpr int kTileLanes = 64;

/// What only the critic sees: the true distance in two forms, its ratio to the distance as the crow flies, and what
/// each move would gain.
constexpr int kPrivilegedInputs = 3 + kGridMoveCount;

/// The critic's output times this is a return, cells.
constexpr double kValueScale = 20.0;

int roundedUp(int count, int multiple) { return (count + multiple - 1) / multiple * multiple; }

void encodePrivileged(const GridActor& actor, double discount, float* input, int stride) {
  const float distance = actor.distance();
  const float octile = std::max(1.0f, static_cast<float>(actor.memory().goalDistance()));
  input[0 * stride] = std::log2(distance + 1.0f) / 10.0f;
  input[1 * stride] = 1.0f - static_cast<float>(std::pow(discount, static_cast<double>(distance)));
  input[2 * stride] = std::log2(std::max(1.0f, distance) / octile) / 4.0f;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    const float gain = distance - actor.distanceBeside(direction);
    const bool possible = movePossible(actor.ranges(), direction, CornerCutting::kForbidden);
    input[(3 + direction) * stride] = possible ? gain / 1.4142135f : -1.5f;
  }
}

}  // namespace

GridActorCriticSums GridActorCriticSums::ofSets(std::size_t sets) {
  GridActorCriticSums sums;
  sums.set_steps.assign(sets, 0.0);
  sums.set_squared_advantages.assign(sets, 0.0);
  return sums;
}

void GridActorCriticSums::operator+=(const GridActorCriticSums& other) {
  steps += other.steps;
  reward += other.reward;
  entropy += other.entropy;
  arrived += other.arrived;
  ended += other.ended;
  ratio += other.ratio;
  returns += other.returns;
  squared_returns += other.squared_returns;
  squared_errors += other.squared_errors;
  for (std::size_t set = 0; set < set_steps.size(); ++set) {
    set_steps[set] += other.set_steps[set];
    set_squared_advantages[set] += other.set_squared_advantages[set];
  }
}

std::vector<double*> GridActorCriticSums::numbers() {
  std::vector<double*> all = {&steps, &reward,  &entropy,         &arrived,       &ended,
                              &ratio, &returns, &squared_returns, &squared_errors};
  for (double& number : set_steps) all.push_back(&number);
  for (double& number : set_squared_advantages) all.push_back(&number);
  return all;
}

LayerStack makeCritic(int policy_inputs, const std::vector<int>& units, std::uint64_t seed) {
  LayerStack layers = makeDenseStack(policy_inputs + kPrivilegedInputs, units, 1);
  initialise({}, seed, layers);
  return layers;
}

GridActorCriticTileRunner::GridActorCriticTileRunner(const GridActorCriticParameters& parameters,
                                                     const LayerStack& policy, const LayerStack& critic)
    : parameters_(parameters),
      encoder_(parameters.encoder),
      actors_(kTileLanes / parameters.encoder.views),
      policy_(policy, kTileLanes, parameters.window),
      critic_(critic, roundedUp(actors_ * (parameters.window + 1), kLaneGroup), 1),
      steps_(static_cast<std::size_t>(actors_ * parameters.window)) {}

void GridActorCriticTileRunner::run(const Eigen::VectorXf& policy_parameters, const Eigen::VectorXf& critic_parameters,
                                    double entropy_weight, const std::vector<double>& advantage_variances,
                                    GridActorCriticTile& tile) {
  tile.sums = GridActorCriticSums::ofSets(advantage_variances.size());
  tile.policy_gradient.setZero(policy_parameters.size());
  tile.critic_gradient.setZero(critic_parameters.size());
  if (tile.state.empty()) tile.state.assign(policy_.state().size(), 0.0f);
  policy_.setState(tile.state);
  for (int step = 0; step < parameters_.window; ++step) walk(policy_parameters, step, tile);
  for (int actor = 0; actor < actors_; ++actor) look(parameters_.window, actor, tile);
  const float* values = critic_.forward(critic_parameters, 0);
  for (int actor = 0; actor < actors_; ++actor) judge(values, actor, entropy_weight, advantage_variances, tile);
  std::fill_n(critic_.outputGradient(0) + parameters_.window * actors_, critic_.lanes() - parameters_.window * actors_,
              0.0f);
  policy_.backward(policy_parameters, parameters_.window, tile.policy_gradient);
  critic_.backward(critic_parameters, 1, tile.critic_gradient);
  policy_.carryOver(parameters_.window);
  tile.state = policy_.state();
}

int GridActorCriticTileRunner::preferenceAt(int actor, int direction) const {
  return parameters_.encoder.views == 1 ? direction * kTileLanes + actor : actor * kGridMoveCount + direction;
}

/// Senses and fills the critic's input of that step.
void GridActorCriticTileRunner::look(int step, int actor, GridActorCriticTile& tile) {
  GridActor& walker = tile.actors[static_cast<std::size_t>(actor)];
  walker.observe();
  encoder_.look(walker.memory());
  float* input = critic_.inputs(0) + step * actors_ + actor;
  encoder_.encode(0, input, critic_.lanes());
  encodePrivileged(walker, parameters_.discount, input + encoder_.size() * critic_.lanes(), critic_.lanes());
}

void GridActorCriticTileRunner::walk(const Eigen::VectorXf& policy_parameters, int step, GridActorCriticTile& tile) {
  const int views = parameters_.encoder.views;
  for (int actor = 0; actor < actors_; ++actor) {
    if (tile.actors[static_cast<std::size_t>(actor)].atStart()) {
      for (int view = 0; view < views; ++view) policy_.forget(step, actor * views + view);
    }
    look(step, actor, tile);
    for (int view = 0; view < views; ++view) {
      encoder_.encode(view, policy_.inputs(step) + actor * views + view, kTileLanes);
    }
  }
  const float* preferences = policy_.forward(policy_parameters, step);
  for (int actor = 0; actor < actors_; ++actor) act(preferences, step, actor, tile);
}

void GridActorCriticTileRunner::choose(const float* preferences, int actor, GridActor& walker, Step& done) const {
  float largest = -1e30f;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (!movePossible(walker.ranges(), direction, CornerCutting::kForbidden)) continue;
    largest = std::max(largest, preferences[preferenceAt(actor, direction)]);
  }
  float total = 0.0f;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    const bool possible = movePossible(walker.ranges(), direction, CornerCutting::kForbidden);
    float& probability = done.probabilities[static_cast<std::size_t>(direction)];
    probability = possible ? std::exp(preferences[preferenceAt(actor, direction)] - largest) : 0.0f;
    total += probability;
  }
  float draw = static_cast<float>(uniform(walker.random())) * total;
  done.direction = -1;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    float& probability = done.probabilities[static_cast<std::size_t>(direction)];
    if (probability > 0.0f && (draw >= 0.0f || done.direction < 0)) done.direction = direction;
    draw -= probability;
    probability /= total;
  }
}

void GridActorCriticTileRunner::act(const float* preferences, int step, int actor, GridActorCriticTile& tile) {
  GridActor& walker = tile.actors[static_cast<std::size_t>(actor)];
  Step& done = stepOf(step, actor);
  choose(preferences, actor, walker, done);
  done.set = walker.set();
  const GridActor::Outcome outcome =
      walker.step(done.direction, {parameters_.step_cost, parameters_.arrival_bonus}, parameters_.max_steps);
  done.reward = outcome.reward;
  done.arrived = outcome.arrived;
  done.timed_out = outcome.timed_out;
  if (!outcome.ended()) return;
  tile.sums.ended += 1.0;
  if (outcome.arrived) {
    tile.sums.arrived += 1.0;
    tile.sums.ratio += walker.walked() / static_cast<double>(walker.optimum());
  }
  walker.startEpisode();
}

/// Advantages from the last step back, and from them the derivatives by the outputs of both networks.
void GridActorCriticTileRunner::judge(const float* values, int actor, double entropy_weight,
                                      const std::vector<double>& advantage_variances, GridActorCriticTile& tile) {
  Advantages advantages(parameters_.discount, parameters_.advantage_decay,
                        kValueScale * static_cast<double>(values[parameters_.window * actors_ + actor]));
  for (int step = parameters_.window; step-- > 0;) {
    const Step& done = stepOf(step, actor);
    const double value = kValueScale * static_cast<double>(values[step * actors_ + actor]);
    const Advantages::End end =
        done.arrived ? Advantages::End::kArrived : (done.timed_out ? Advantages::End::kCutOff : Advantages::End::kNone);
    const double advantage = advantages.before(done.reward, value, end);
    critic_.outputGradient(0)[step * actors_ + actor] = static_cast<float>(-advantage / kValueScale);
    const double entropy =
        fillPolicyGradient(done, step, actor, advantage / std::sqrt(advantage_variances[done.set]), entropy_weight);
    GridActorCriticSums& sums = tile.sums;
    sums.steps += 1.0;
    sums.reward += done.reward;
    sums.entropy += entropy;
    sums.returns += value + advantage;
    sums.squared_returns += (value + advantage) * (value + advantage);
    sums.squared_errors += advantage * advantage;
    sums.set_steps[done.set] += 1.0;
    sums.set_squared_advantages[done.set] += advantage * advantage;
  }
}

double GridActorCriticTileRunner::fillPolicyGradient(const Step& done, int step, int actor, double advantage,
                                                     double entropy_weight) {
  double entropy = 0.0;
  for (const float probability : done.probabilities) {
    if (probability > 0.0f) entropy -= static_cast<double>(probability) * std::log(static_cast<double>(probability));
  }
  float* gradient = policy_.outputGradient(step);
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    const double probability = static_cast<double>(done.probabilities[static_cast<std::size_t>(direction)]);
    double by_preference = 0.0;
    if (probability > 0.0) {
      by_preference = advantage * (probability - (direction == done.direction ? 1.0 : 0.0)) +
                      entropy_weight * probability * (std::log(probability) + entropy);
    }
    gradient[preferenceAt(actor, direction)] = static_cast<float>(by_preference);
  }
  return entropy;
}

}  // namespace lstm_planner
