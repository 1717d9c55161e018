#include "lstm_planner/grid_world/learning/actor_critic.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "grid_world/learning/actor_critic_tile.hpp"
#include "lstm_planner/base/common/parallel_for.hpp"
#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/base/learning/optimiser_json.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"

namespace lstm_planner {
namespace {

constexpr const char* kCheckpointFormat = "lstm_planner actor-critic 1";

OptimiserParameters optimiserParameters(double learning_rate, double max_norm) {
  OptimiserParameters parameters;
  parameters.learning_rate = learning_rate;
  parameters.max_gradient_norm = max_norm;
  return parameters;
}

}  // namespace

void validate(const ActorCriticParameters& parameters) {
  checkParameter(parameters.updates >= 1, "updates", parameters.updates, "at least 1");
  checkParameter(parameters.agents >= 1, "agents", parameters.agents, "at least 1");
  checkParameter(parameters.window >= 1, "window", parameters.window, "at least 1");
  checkParameter(parameters.max_steps >= 1, "max_steps", parameters.max_steps, "at least 1");
  checkParameter(parameters.threads >= 1, "threads", parameters.threads, "at least 1");
  checkParameter(parameters.discount > 0.0 && parameters.discount <= 1.0, "discount", parameters.discount,
                 "a number in (0, 1]");
  checkParameter(parameters.advantage_decay >= 0.0 && parameters.advantage_decay <= 1.0, "advantage_decay",
                 parameters.advantage_decay, "a number in [0, 1]");
}

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
      runners_.push_back(std::make_unique<ActorCriticTileRunner>(parameters_, policy_, critic_));
    }
  }

  void beginEpoch(int epoch, const GridCourse& course) {
    Random seeds(parameters_.seed * 1000003 + static_cast<std::uint64_t>(epoch));
    const int actors = runners_.front()->actors();
    // A set of maps that was not there before starts with the variance of nothing known.
    advantage_variances_.resize(course.sets(), 1.0);
    sums_ = ActorCriticSums::ofSets(course.sets());
    tiles_.clear();
    tiles_.resize(static_cast<std::size_t>((parameters_.agents + actors - 1) / actors));
    for (ActorCriticTile& tile : tiles_) {
      for (int actor = 0; actor < actors; ++actor) tile.actors.emplace_back(course, parameters_.encoder, seeds());
    }
  }

  void update() {
    const double progress = static_cast<double>(updates_) / parameters_.updates;
    const double entropy_weight =
        parameters_.entropy_start + (parameters_.entropy_end - parameters_.entropy_start) * progress;
    const Share own = shareOfTiles();
    parallelFor(own.count(), parameters_.threads, [&](int index, int thread) {
      ActorCriticTile& tile = tiles_[static_cast<std::size_t>(own.first + index)];
      runners_[static_cast<std::size_t>(thread)]->run(policy_parameters_, critic_parameters_, entropy_weight,
                                                      advantage_variances_, tile);
    });
    exchangeTiles();
    Eigen::VectorXf policy_gradient = Eigen::VectorXf::Zero(policy_parameters_.size());
    Eigen::VectorXf critic_gradient = Eigen::VectorXf::Zero(critic_parameters_.size());
    ActorCriticSums sums = ActorCriticSums::ofSets(advantage_variances_.size());
    for (const ActorCriticTile& tile : tiles_) {
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
    sums_ = ActorCriticSums::ofSets(advantage_variances_.size());
    return report;
  }

  const LayerStack& layers() {
    setParameterVector(policy_parameters_, policy_);
    return policy_;
  }

  std::vector<std::uint8_t> checkpoint() const {
    nlohmann::json content;
    content["format"] = kCheckpointFormat;
    content["policy"] = vectorToJson(policy_parameters_);
    content["critic"] = vectorToJson(critic_parameters_);
    content["policy_optimiser"] = optimiserToJson(policy_optimiser_.state());
    content["critic_optimiser"] = optimiserToJson(critic_optimiser_.state());
    content["advantage_variances"] = advantage_variances_;
    content["steps"] = all_steps_;
    content["updates"] = updates_;
    return nlohmann::json::to_cbor(content);
  }

  void restore(const std::vector<std::uint8_t>& checkpoint) try {
    const nlohmann::json content = checkpointJson(checkpoint);
    if (content.at("format") != kCheckpointFormat) throw std::invalid_argument("another format");
    const Eigen::VectorXf policy = vectorFromJson(content.at("policy"));
    const Eigen::VectorXf critic = vectorFromJson(content.at("critic"));
    if (policy.size() != policy_parameters_.size() || critic.size() != critic_parameters_.size()) {
      throw std::invalid_argument("networks of other sizes");
    }
    policy_optimiser_.setState(optimiserFromJson(content.at("policy_optimiser")));
    critic_optimiser_.setState(optimiserFromJson(content.at("critic_optimiser")));
    advantage_variances_ = content.at("advantage_variances").get<std::vector<double>>();
    all_steps_ = content.at("steps").get<double>();
    updates_ = static_cast<int>(wholeNumber(content.at("updates"), 0, INT_MAX));
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
    const auto sum_count =
        static_cast<Eigen::Index>(ActorCriticSums::ofSets(advantage_variances_.size()).numbers().size());
    Eigen::MatrixXf gradients(policy_size + critic_parameters_.size(), tiles);
    Eigen::MatrixXd sums(sum_count, tiles);
    for (int index = own.first; index < own.last; ++index) {
      ActorCriticTile& tile = tiles_[static_cast<std::size_t>(index)];
      gradients.col(index) << tile.policy_gradient, tile.critic_gradient;
      double* next = sums.col(index).data();
      for (const double* number : tile.sums.numbers()) *next++ = *number;
    }
    exchangeShares(&ranks, static_cast<int>(tiles), static_cast<std::size_t>(gradients.rows()), gradients.data());
    exchangeShares(&ranks, static_cast<int>(tiles), static_cast<std::size_t>(sum_count), sums.data());
    for (Eigen::Index index = 0; index < tiles; ++index) {
      ActorCriticTile& tile = tiles_[static_cast<std::size_t>(index)];
      tile.policy_gradient = gradients.col(index).head(policy_size);
      tile.critic_gradient = gradients.col(index).tail(critic_parameters_.size());
      tile.sums = ActorCriticSums::ofSets(advantage_variances_.size());
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
  std::vector<std::unique_ptr<ActorCriticTileRunner>> runners_;
  std::vector<ActorCriticTile> tiles_;
  ActorCriticSums sums_;
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
