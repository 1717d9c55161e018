#include "lstm_planner/learning/actor_critic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "grid_actor.hpp"
#include "lane_kernels.hpp"
#include "lane_network.hpp"
#include "lstm_planner/learning/initialisation.hpp"
#include "lstm_planner/learning/parameter_vector.hpp"
#include "parallel_for.hpp"

namespace lstm_planner {
namespace {

/// Lanes that keep a step's rows in the first cache.
constexpr int kTileLanes = 64;

/// What only the critic sees: the true distance in two forms, its ratio to the distance as the crow flies, and what each
/// move would gain.
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

/// What an agent did in one step of a window.
struct Step {
  std::array<float, kGridMoveCount> probabilities{};
  int direction = 0;
  std::size_t set = 0;
  double reward = 0.0;
  double value = 0.0;
  bool arrived = false;
  bool timed_out = false;
};

struct Sums {
  double steps = 0, reward = 0, entropy = 0, arrived = 0, ended = 0, ratio = 0;
  double returns = 0, squared_returns = 0, squared_errors = 0;
  std::vector<double> set_steps, set_squared_advantages;  ///< by set of the course
  void operator+=(const Sums& other) {
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
  static Sums ofSets(std::size_t sets) {
    Sums sums;
    sums.set_steps.assign(sets, 0.0);
    sums.set_squared_advantages.assign(sets, 0.0);
    return sums;
  }
  /// Every number, to be read or written.
  std::vector<double*> numbers() {
    std::vector<double*> all = {&steps, &reward,  &entropy,         &arrived,       &ended,
                                &ratio, &returns, &squared_returns, &squared_errors};
    for (double& number : set_steps) all.push_back(&number);
    for (double& number : set_squared_advantages) all.push_back(&number);
    return all;
  }
};

/// Some agents that go through a window together, with the hidden state they carry between windows.
struct Tile {
  std::vector<GridActor> actors;
  std::vector<float> state;
  Eigen::VectorXf policy_gradient;
  Eigen::VectorXf critic_gradient;
  Sums sums;
};

LayerStack makeCritic(int inputs, const std::vector<int>& units, std::uint64_t seed) {
  LayerStack layers = makeDenseStack(inputs + kPrivilegedInputs, units, 1);
  initialise({}, seed, layers);
  return layers;
}

constexpr const char* kCheckpointFormat = "lstm_planner actor-critic 1";

nlohmann::json toJson(const Eigen::VectorXf& values) {
  return std::vector<float>(values.data(), values.data() + values.size());
}

Eigen::VectorXf vectorFrom(const nlohmann::json& content) {
  const auto values = content.get<std::vector<float>>();
  return Eigen::Map<const Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size()));
}

nlohmann::json toJson(const Optimiser::State& state) {
  return {{"velocity", toJson(state.velocity)},
          {"squared_average", toJson(state.squared_average)},
          {"updates", state.updates}};
}

Optimiser::State stateFrom(const nlohmann::json& content) {
  return {vectorFrom(content.at("velocity")), vectorFrom(content.at("squared_average")),
          content.at("updates").get<long>()};
}

OptimiserParameters optimiserParameters(double learning_rate, double max_norm) {
  OptimiserParameters parameters;
  parameters.learning_rate = learning_rate;
  parameters.max_gradient_norm = max_norm;
  return parameters;
}

}  // namespace

void validate(const ActorCriticParameters& parameters) {
  if (parameters.updates < 1 || parameters.agents < 1 || parameters.window < 1) {
    throw std::invalid_argument("updates, agents and window must be at least 1");
  }
}

/// What a thread needs to run a tile.
class TileRunner {
 public:
  TileRunner(const ActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic)
      : parameters_(parameters),
        encoder_(parameters.encoder),
        actors_(kTileLanes / parameters.encoder.views),
        policy_(policy, kTileLanes, parameters.window),
        critic_(critic, roundedUp(actors_ * (parameters.window + 1), kLaneGroup), 1),
        steps_(static_cast<std::size_t>(actors_ * parameters.window)) {}

  int actors() const { return actors_; }

  void run(const Eigen::VectorXf& policy_parameters, const Eigen::VectorXf& critic_parameters, double entropy_weight,
           const std::vector<double>& advantage_variances, Tile& tile) {
    tile.sums = Sums::ofSets(advantage_variances.size());
    tile.policy_gradient.setZero(policy_parameters.size());
    tile.critic_gradient.setZero(critic_parameters.size());
    if (tile.state.empty()) tile.state.assign(policy_.state().size(), 0.0f);
    policy_.setState(tile.state);
    for (int step = 0; step < parameters_.window; ++step) walk(policy_parameters, step, tile);
    for (int actor = 0; actor < actors_; ++actor) lookOnly(parameters_.window, actor, tile);
    const float* values = critic_.forward(critic_parameters, 0);
    for (int actor = 0; actor < actors_; ++actor) judge(values, actor, entropy_weight, advantage_variances, tile);
    std::fill_n(critic_.outputGradient(0) + parameters_.window * actors_,
                critic_.lanes() - parameters_.window * actors_, 0.0f);
    policy_.backward(policy_parameters, parameters_.window, tile.policy_gradient);
    critic_.backward(critic_parameters, 1, tile.critic_gradient);
    policy_.carryOver(parameters_.window);
    tile.state = policy_.state();
  }

 private:
  Step& stepOf(int step, int actor) { return steps_[static_cast<std::size_t>(step * actors_ + actor)]; }

  /// Senses and fills the critic's input of that step.
  void lookOnly(int step, int actor, Tile& tile) {
    GridActor& walker = tile.actors[static_cast<std::size_t>(actor)];
    walker.observe();
    encoder_.look(walker.memory());
    float* input = critic_.inputs(0) + step * actors_ + actor;
    encoder_.encode(0, input, critic_.lanes());
    encodePrivileged(walker, parameters_.discount, input + encoder_.size() * critic_.lanes(), critic_.lanes());
  }

  void walk(const Eigen::VectorXf& policy_parameters, int step, Tile& tile) {
    const int views = parameters_.encoder.views;
    for (int actor = 0; actor < actors_; ++actor) {
      if (tile.actors[static_cast<std::size_t>(actor)].atStart()) {
        for (int view = 0; view < views; ++view) policy_.forget(step, actor * views + view);
      }
      lookOnly(step, actor, tile);
      for (int view = 0; view < views; ++view) {
        encoder_.encode(view, policy_.inputs(step) + actor * views + view, kTileLanes);
      }
    }
    const float* preferences = policy_.forward(policy_parameters, step);
    for (int actor = 0; actor < actors_; ++actor) act(preferences, step, actor, tile);
  }

  const float* preferenceOf(const float* preferences, int actor, int direction) const {
    return parameters_.encoder.views == 1 ? preferences + direction * kTileLanes + actor
                                          : preferences + actor * kGridMoveCount + direction;
  }

  void act(const float* preferences, int step, int actor, Tile& tile) {
    GridActor& walker = tile.actors[static_cast<std::size_t>(actor)];
    Step& done = stepOf(step, actor);
    float largest = -1e30f;
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      if (!movePossible(walker.ranges(), direction, CornerCutting::kForbidden)) continue;
      largest = std::max(largest, *preferenceOf(preferences, actor, direction));
    }
    float total = 0.0f;
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      const bool possible = movePossible(walker.ranges(), direction, CornerCutting::kForbidden);
      float& probability = done.probabilities[static_cast<std::size_t>(direction)];
      probability = possible ? std::exp(*preferenceOf(preferences, actor, direction) - largest) : 0.0f;
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
  void judge(const float* values, int actor, double entropy_weight, const std::vector<double>& advantage_variances,
             Tile& tile) {
    double next_value = kValueScale * static_cast<double>(values[parameters_.window * actors_ + actor]);
    double advantage = 0.0;
    for (int step = parameters_.window; step-- > 0;) {
      const Step& done = stepOf(step, actor);
      const double value = kValueScale * static_cast<double>(values[step * actors_ + actor]);
      // An episode that is cut off would have gone on from much the same place.
      const double following = done.arrived ? 0.0 : (done.timed_out ? value : next_value);
      const double error = done.reward + parameters_.discount * following - value;
      const bool ended = done.arrived || done.timed_out;
      advantage = error + (ended ? 0.0 : parameters_.discount * parameters_.advantage_decay * advantage);
      next_value = value;
      critic_.outputGradient(0)[step * actors_ + actor] = static_cast<float>(-advantage / kValueScale);
      const double entropy = fillPolicyGradient(
          done, step, actor, advantage / std::sqrt(advantage_variances[done.set]), entropy_weight);
      Sums& sums = tile.sums;
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

  double fillPolicyGradient(const Step& done, int step, int actor, double advantage, double entropy_weight) {
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
      const int at = parameters_.encoder.views == 1 ? direction * kTileLanes + actor
                                                    : actor * kGridMoveCount + direction;
      gradient[at] = static_cast<float>(by_preference);
    }
    return entropy;
  }

  const ActorCriticParameters& parameters_;
  GridEncoder encoder_;
  int actors_;
  LaneNetwork policy_;
  LaneNetwork critic_;
  std::vector<Step> steps_;
};

class ActorCritic::Implementation {
 public:
  Implementation(const ActorCriticParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        policy_(std::move(layers)),
        critic_(makeCritic(GridEncoder(parameters.encoder).size(), parameters.critic_units, parameters.seed + 1)),
        policy_parameters_(parameterVector(policy_)),
        critic_parameters_(parameterVector(critic_)),
        policy_optimiser_(optimiserParameters(parameters.learning_rate, parameters.max_gradient_norm),
                          weightMask(policy_)),
        critic_optimiser_(optimiserParameters(parameters.critic_learning_rate, parameters.max_gradient_norm),
                          weightMask(critic_)) {
    for (int thread = 0; thread < parameters_.threads; ++thread) {
      runners_.push_back(std::make_unique<TileRunner>(parameters_, policy_, critic_));
    }
  }

  void beginEpoch(int epoch, const GridCourse& course) {
    Random seeds(parameters_.seed * 1000003 + static_cast<std::uint64_t>(epoch));
    const int actors = runners_.front()->actors();
    // A set of maps that was not there before starts with the variance of nothing known.
    advantage_variances_.resize(course.sets(), 1.0);
    sums_ = Sums::ofSets(course.sets());
    tiles_.clear();
    tiles_.resize(static_cast<std::size_t>((parameters_.agents + actors - 1) / actors));
    for (Tile& tile : tiles_) {
      for (int actor = 0; actor < actors; ++actor) tile.actors.emplace_back(course, parameters_.encoder, seeds());
    }
  }

  void update() {
    const double progress = static_cast<double>(updates_) / parameters_.updates;
    const double entropy_weight =
        parameters_.entropy_start + (parameters_.entropy_end - parameters_.entropy_start) * progress;
    const Share own = shareOfTiles();
    parallelFor(own.count(), parameters_.threads, [&](int index, int thread) {
      Tile& tile = tiles_[static_cast<std::size_t>(own.first + index)];
      runners_[static_cast<std::size_t>(thread)]->run(policy_parameters_, critic_parameters_, entropy_weight,
                                                      advantage_variances_, tile);
    });
    exchangeTiles();
    Eigen::VectorXf policy_gradient = Eigen::VectorXf::Zero(policy_parameters_.size());
    Eigen::VectorXf critic_gradient = Eigen::VectorXf::Zero(critic_parameters_.size());
    Sums sums = Sums::ofSets(advantage_variances_.size());
    for (const Tile& tile : tiles_) {
      policy_gradient += tile.policy_gradient;
      critic_gradient += tile.critic_gradient;
      sums += tile.sums;
    }
    const float share = static_cast<float>(1.0 / sums.steps);
    const double rate = 0.5 * (1.0 + std::cos(M_PI * progress));
    policy_optimiser_.update(policy_gradient * share, parameters_.learning_rate * rate, policy_parameters_);
    critic_optimiser_.update(critic_gradient * share, parameters_.critic_learning_rate * rate, critic_parameters_);
    // Slow, so that a window's own luck does not scale its own advantages.
    for (std::size_t set = 0; set < advantage_variances_.size(); ++set) {
      if (sums.set_steps[set] == 0.0) continue;
      const double variance = sums.set_squared_advantages[set] / sums.set_steps[set];
      advantage_variances_[set] += 0.02 * (variance - advantage_variances_[set]);
    }
    ++updates_;
    sums_ += sums;
    all_steps_ += sums.steps;
  }

  ActorCriticReport report() {
    ActorCriticReport report;
    report.update = updates_;
    report.steps = all_steps_;
    report.reward = sums_.reward / sums_.steps;
    report.arrival = sums_.ended > 0.0 ? sums_.arrived / sums_.ended : 0.0;
    report.ratio = sums_.arrived > 0.0 ? sums_.ratio / sums_.arrived : 0.0;
    report.entropy = sums_.entropy / sums_.steps;
    const double mean = sums_.returns / sums_.steps;
    report.explained = 1.0 - sums_.squared_errors / (sums_.squared_returns - sums_.steps * mean * mean);
    sums_ = Sums::ofSets(advantage_variances_.size());
    return report;
  }

  const LayerStack& layers() {
    setParameterVector(policy_parameters_, policy_);
    return policy_;
  }

  std::vector<std::uint8_t> checkpoint() const {
    nlohmann::json content;
    content["format"] = kCheckpointFormat;
    content["policy"] = toJson(policy_parameters_);
    content["critic"] = toJson(critic_parameters_);
    content["policy_optimiser"] = toJson(policy_optimiser_.state());
    content["critic_optimiser"] = toJson(critic_optimiser_.state());
    content["advantage_variances"] = advantage_variances_;
    content["steps"] = all_steps_;
    content["updates"] = updates_;
    return nlohmann::json::to_cbor(content);
  }

  void restore(const std::vector<std::uint8_t>& checkpoint) try {
    const nlohmann::json content = nlohmann::json::from_cbor(checkpoint);
    if (content.at("format") != kCheckpointFormat) throw std::invalid_argument("another format");
    const Eigen::VectorXf policy = vectorFrom(content.at("policy"));
    const Eigen::VectorXf critic = vectorFrom(content.at("critic"));
    if (policy.size() != policy_parameters_.size() || critic.size() != critic_parameters_.size()) {
      throw std::invalid_argument("networks of other sizes");
    }
    policy_optimiser_.setState(stateFrom(content.at("policy_optimiser")));
    critic_optimiser_.setState(stateFrom(content.at("critic_optimiser")));
    advantage_variances_ = content.at("advantage_variances").get<std::vector<double>>();
    all_steps_ = content.at("steps").get<double>();
    updates_ = content.at("updates").get<int>();
    policy_parameters_ = policy;
    critic_parameters_ = critic;
  } catch (const std::exception& error) {
    throw std::invalid_argument(std::string("this is not a checkpoint of this training: ") + error.what());
  }

 private:
  Share shareOfTiles() const {
    const Communicator& ranks = *parameters_.communicator;
    return shareOf(static_cast<int>(tiles_.size()), ranks.rank(), ranks.size());
  }

  /// What this rank's tiles brought goes to all others, so that all add up the same.
  void exchangeTiles() {
    Communicator& ranks = *parameters_.communicator;
    if (ranks.size() == 1) return;
    const Share own = shareOfTiles();
    const auto tiles = static_cast<Eigen::Index>(tiles_.size());
    const Eigen::Index policy_size = policy_parameters_.size();
    const auto sum_count = static_cast<Eigen::Index>(Sums::ofSets(advantage_variances_.size()).numbers().size());
    Eigen::MatrixXf gradients(policy_size + critic_parameters_.size(), tiles);
    Eigen::MatrixXd sums(sum_count, tiles);
    for (int index = own.first; index < own.last; ++index) {
      Tile& tile = tiles_[static_cast<std::size_t>(index)];
      gradients.col(index) << tile.policy_gradient, tile.critic_gradient;
      double* next = sums.col(index).data();
      for (const double* number : tile.sums.numbers()) *next++ = *number;
    }
    exchangeShares(&ranks, static_cast<int>(tiles), static_cast<std::size_t>(gradients.rows()), gradients.data());
    exchangeShares(&ranks, static_cast<int>(tiles), static_cast<std::size_t>(sum_count), sums.data());
    for (Eigen::Index index = 0; index < tiles; ++index) {
      Tile& tile = tiles_[static_cast<std::size_t>(index)];
      tile.policy_gradient = gradients.col(index).head(policy_size);
      tile.critic_gradient = gradients.col(index).tail(critic_parameters_.size());
      tile.sums = Sums::ofSets(advantage_variances_.size());
      const double* next = sums.col(index).data();
      for (double* number : tile.sums.numbers()) *number = *next++;
    }
  }

  ActorCriticParameters parameters_;
  LayerStack policy_;
  LayerStack critic_;
  Eigen::VectorXf policy_parameters_;
  Eigen::VectorXf critic_parameters_;
  Optimiser policy_optimiser_;
  Optimiser critic_optimiser_;
  std::vector<std::unique_ptr<TileRunner>> runners_;
  std::vector<Tile> tiles_;
  Sums sums_;
  double all_steps_ = 0.0;
  /// By set of the course: what is a large gain in the open is a small one in a maze, and each is to count alike.
  std::vector<double> advantage_variances_;
  int updates_ = 0;
};

ActorCritic::ActorCritic(const ActorCriticParameters& parameters, LayerStack layers)
    : implementation_(std::make_unique<Implementation>(parameters, std::move(layers))) {}
ActorCritic::~ActorCritic() = default;
void ActorCritic::beginEpoch(int epoch, const GridCourse& course) { implementation_->beginEpoch(epoch, course); }
void ActorCritic::update() { implementation_->update(); }
ActorCriticReport ActorCritic::report() { return implementation_->report(); }
const LayerStack& ActorCritic::layers() const { return implementation_->layers(); }
std::vector<std::uint8_t> ActorCritic::checkpoint() const { return implementation_->checkpoint(); }
void ActorCritic::restore(const std::vector<std::uint8_t>& checkpoint) { implementation_->restore(checkpoint); }

}  // namespace lstm_planner
