#include "grid_world/learning/grid_actor_critic_tile.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/base/learning/actor_critic.hpp"
#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/base/learning/lane_kernels.hpp"

namespace lstm_planner {
namespace {

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
    input[(3 + direction) * stride] = actor.possible(direction) ? gain / 1.4142135f : -1.5f;
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
  episodes += other.episodes;
  returns += other.returns;
  squared_returns += other.squared_returns;
  squared_errors += other.squared_errors;
  for (std::size_t set = 0; set < set_steps.size(); ++set) {
    set_steps[set] += other.set_steps[set];
    set_squared_advantages[set] += other.set_squared_advantages[set];
  }
}

std::vector<double*> numbersOf(GridActorCriticSums* sums) {
  GridEpisodeSums& episodes = sums->episodes;
  std::vector<double*> all = {&sums->steps,    &sums->reward,          &sums->entropy,
                              &episodes.ended, &episodes.arrived,      &episodes.ratio,
                              &sums->returns,  &sums->squared_returns, &sums->squared_errors};
  for (double& number : sums->set_steps) all.push_back(&number);
  for (double& number : sums->set_squared_advantages) all.push_back(&number);
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
      lanes_(parameters.encoder),
      policy_(policy, GridLanes::kCount, parameters.window),
      critic_(critic, roundedUp(actors() * (parameters.window + 1), kLaneGroup), 1),
      steps_(static_cast<std::size_t>(actors() * parameters.window)) {}

GridActorCriticSums GridActorCriticTileRunner::run(const Eigen::VectorXf& policy_parameters,
                                                   const Eigen::VectorXf& critic_parameters, double entropy_weight,
                                                   const std::vector<double>& advantage_variances,
                                                   GridActorCriticTile* tile) {
  sums_ = GridActorCriticSums::ofSets(advantage_variances.size());
  tile->policy_gradient.setZero(policy_parameters.size());
  tile->critic_gradient.setZero(critic_parameters.size());
  if (tile->state.empty()) tile->state.assign(policy_.state().size(), 0.0f);
  policy_.setState(tile->state);
  const int window = parameters_.window;
  for (int step = 0; step < window; ++step) walk(policy_parameters, step, tile);
  for (int actor = 0; actor < actors(); ++actor) observe(window, actor, &tile->actors[static_cast<std::size_t>(actor)]);
  const float* values = critic_.forward(critic_parameters, 0);
  for (int actor = 0; actor < actors(); ++actor) judge(values, actor, entropy_weight, advantage_variances);
  std::fill_n(critic_.outputGradient(0) + window * actors(), critic_.lanes() - window * actors(), 0.0f);
  policy_.backward(policy_parameters, window, tile->policy_gradient);
  critic_.backward(critic_parameters, 1, tile->critic_gradient);
  policy_.carryOver(window);
  tile->state = policy_.state();
  return sums_;
}

/// Senses and fills the critic's input of that step.
void GridActorCriticTileRunner::observe(int step, int actor, GridActor* walker) {
  walker->observe();
  lanes_.prepare(*walker);
  const GridEncoder& encoder = lanes_.encoder();
  float* input = critic_.inputs(0) + step * actors() + actor;
  encoder.encode(0, input, critic_.lanes());
  encodePrivileged(*walker, parameters_.discount, input + encoder.size() * critic_.lanes(), critic_.lanes());
}

void GridActorCriticTileRunner::walk(const Eigen::VectorXf& policy_parameters, int step, GridActorCriticTile* tile) {
  for (int actor = 0; actor < actors(); ++actor) {
    GridActor& walker = tile->actors[static_cast<std::size_t>(actor)];
    if (walker.atStart()) lanes_.forget(actor, step, &policy_);
    observe(step, actor, &walker);
    lanes_.show(actor, step, &policy_);
  }
  const float* preferences = policy_.forward(policy_parameters, step);
  for (int actor = 0; actor < actors(); ++actor) {
    act(preferences, step, actor, &tile->actors[static_cast<std::size_t>(actor)]);
  }
}

void GridActorCriticTileRunner::choose(const float* preferences, int actor, GridActor& walker, Step& done) const {
  float largest = -1e30f;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (walker.possible(direction)) largest = std::max(largest, preferences[lanes_.outputAt(actor, direction)]);
  }
  float total = 0.0f;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    float& probability = done.probabilities[static_cast<std::size_t>(direction)];
    probability =
        walker.possible(direction) ? std::exp(preferences[lanes_.outputAt(actor, direction)] - largest) : 0.0f;
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

void GridActorCriticTileRunner::act(const float* preferences, int step, int actor, GridActor* walker) {
  Step& done = stepOf(step, actor);
  choose(preferences, actor, *walker, done);
  done.set = walker->set();
  done.outcome =
      walker->step(done.direction, {parameters_.step_cost, parameters_.arrival_bonus}, parameters_.max_steps);
  sums_.episodes.count(done.outcome);
}

/// Advantages from the last step back, and from them the derivatives by the outputs of both networks.
void GridActorCriticTileRunner::judge(const float* values, int actor, double entropy_weight,
                                      const std::vector<double>& advantage_variances) {
  Advantages advantages(parameters_.discount, parameters_.advantage_decay,
                        kValueScale * static_cast<double>(values[parameters_.window * actors() + actor]));
  for (int step = parameters_.window; step-- > 0;) {
    const Step& done = stepOf(step, actor);
    const double value = kValueScale * static_cast<double>(values[step * actors() + actor]);
    const GridActor::Outcome& outcome = done.outcome;
    const Advantages::End end = outcome.arrived     ? Advantages::End::kArrived
                                : outcome.timed_out ? Advantages::End::kCutOff
                                                    : Advantages::End::kNone;
    const double advantage = advantages.before(outcome.reward, value, end);
    critic_.outputGradient(0)[step * actors() + actor] = static_cast<float>(-advantage / kValueScale);
    const double entropy =
        fillPolicyGradient(done, step, actor, advantage / std::sqrt(advantage_variances[done.set]), entropy_weight);
    sums_.steps += 1.0;
    sums_.reward += outcome.reward;
    sums_.entropy += entropy;
    sums_.returns += value + advantage;
    sums_.squared_returns += (value + advantage) * (value + advantage);
    sums_.squared_errors += advantage * advantage;
    sums_.set_steps[done.set] += 1.0;
    sums_.set_squared_advantages[done.set] += advantage * advantage;
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
    gradient[lanes_.outputAt(actor, direction)] = static_cast<float>(by_preference);
  }
  return entropy;
}

}  // namespace lstm_planner
