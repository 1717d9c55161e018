#include "grid_world/learning/grid_actor_critic_tile.hpp"

#include <algorithm>
#include <cmath>

#include "grid_world/learning/boundary_teacher.hpp"
#include "lstm_planner/training/actor_critic.hpp"
#include "lstm_planner/training/lane_kernels.hpp"
#include "lstm_planner/training/policy_gradient.hpp"

namespace lstm_planner {
namespace {

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

void GridActorCriticSums::operator+=(const GridActorCriticSums& other) {
  reward += other.reward;
  entropy += other.entropy;
  episodes += other.episodes;
  judged += other.judged;
}

std::vector<double*> numbersOf(GridActorCriticSums* sums) {
  GridEpisodeSums& episodes = sums->episodes;
  std::vector<double*> all = numbersOf(&sums->judged);
  all.insert(all.end(), {&sums->reward, &sums->entropy, &episodes.ended, &episodes.arrived, &episodes.ratio});
  return all;
}

GridActorCriticTileRunner::GridActorCriticTileRunner(const GridActorCriticParameters& parameters,
                                                     const LayerStack& policy, const LayerStack& critic)
    : parameters_(parameters),
      lanes_(parameters.encoder),
      policy_(policy, GridLanes::kCount, parameters.window),
      critic_(critic, roundedUp(actors() * (parameters.window + 1), kLaneGroup), 1),
      rewards_{parameters.potential ? parameters.discount : 1.0, parameters.step_cost, parameters.arrival_bonus},
      steps_(static_cast<std::size_t>(actors() * parameters.window)) {}

GridActorCriticSums GridActorCriticTileRunner::run(const Eigen::VectorXf& policy_parameters,
                                                   const Eigen::VectorXf& critic_parameters,
                                                   const GridActorCriticLesson& lesson,
                                                   const std::vector<double>& advantage_variances,
                                                   GridActorCriticTile* tile) {
  sums_ = GridActorCriticSums(advantage_variances.size());
  lesson_ = lesson;
  tile->led_by_teacher.resize(tile->actors.size(), true);
  tile->policy_gradient.setZero(policy_parameters.size());
  tile->critic_gradient.setZero(critic_parameters.size());
  if (tile->state.empty()) tile->state.assign(policy_.state().size(), 0.0f);
  policy_.setState(tile->state);
  const int window = parameters_.window;
  for (int step = 0; step < window; ++step) walk(policy_parameters, step, tile);
  for (int actor = 0; actor < actors(); ++actor) observe(window, actor, &tile->actors[static_cast<std::size_t>(actor)]);
  const float* values = critic_.forward(critic_parameters, 0);
  for (int actor = 0; actor < actors(); ++actor) judge(values, actor, advantage_variances);
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
    act(preferences, step, actor, tile);
  }
}

void GridActorCriticTileRunner::choose(const float* preferences, int actor, GridActor& walker, Step& done) const {
  const float total = fillChances(
      kGridMoveCount, [&](int direction) { return walker.possible(direction); },
      [&](int direction) { return preferences[lanes_.outputAt(actor, direction)]; }, done.probabilities.data());
  done.direction = drawByChances(kGridMoveCount, total, &walker.random(), done.probabilities.data());
}

/// The teacher and the network take turns, so that the network learns where its own moves lead, too.
void GridActorCriticTileRunner::teach(GridActor* walker, std::vector<bool>::reference led_by_teacher,
                                      Step* done) const {
  constexpr double kMovesATurn = 32.0;
  const int move = taughtMove(*walker->memory().boundary(), walker->memory().observation());
  if (move != kNoPath && walker->possible(move)) done->taught = move;
  if (uniform(walker->random()) * kMovesATurn < 1.0) {
    led_by_teacher = uniform(walker->random()) >= lesson_.network_share;
  }
  if (led_by_teacher && done->taught != kNoPath) done->direction = done->taught;
}

void GridActorCriticTileRunner::act(const float* preferences, int step, int actor, GridActorCriticTile* tile) {
  GridActor* walker = &tile->actors[static_cast<std::size_t>(actor)];
  Step& done = stepOf(step, actor);
  choose(preferences, actor, *walker, done);
  done.taught = kNoPath;
  if (lesson_.taught) teach(walker, tile->led_by_teacher[static_cast<std::size_t>(actor)], &done);
  done.set = walker->set();
  done.outcome = walker->step(done.direction, rewards_, parameters_.max_steps);
  sums_.episodes.count(done.outcome);
}

/// Advantages from the last step back, and from them the derivatives by the outputs of both networks.
void GridActorCriticTileRunner::judge(const float* values, int actor, const std::vector<double>& advantage_variances) {
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
    const double entropy = fillPolicyGradient(done, step, actor, advantage / std::sqrt(advantage_variances[done.set]));
    sums_.reward += outcome.reward;
    sums_.entropy += entropy;
    sums_.judged.count(done.set, value, advantage);
  }
}

double GridActorCriticTileRunner::fillPolicyGradient(const Step& done, int step, int actor, double advantage) {
  const double entropy = entropyOf(kGridMoveCount, done.probabilities.data());
  float* gradient = policy_.outputGradient(step);
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    const double probability = static_cast<double>(done.probabilities[static_cast<std::size_t>(direction)]);
    double slope = 0.0;
    if (done.taught != kNoPath) {
      slope = imitationSlope(probability, direction == done.taught);
    } else if (probability > 0.0) {
      slope = policySlope(probability, direction == done.direction, advantage, lesson_.entropy_weight, entropy);
    }
    gradient[lanes_.outputAt(actor, direction)] = static_cast<float>(slope);
  }
  return entropy;
}

}  // namespace lstm_planner
