#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"

#include <stdexcept>
#include <utility>

#include "grid_world/learning/grid_actor_critic_tile.hpp"
#include "lstm_planner/base/common/parallel_for.hpp"
#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/learning/actor_critic.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"

namespace lstm_planner {
namespace {

const ActorCritic::CheckpointNames kCheckpointNames{"lstm_planner actor-critic 1", "updates"};

}  // namespace

void validate(const GridActorCriticParameters& parameters) {
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

class GridActorCritic::Implementation {
 public:
  Implementation(const GridActorCriticParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        policy_(std::move(layers)),
        critic_(makeCritic(GridEncoder(parameters.encoder).size(), parameters.critic_units, parameters.seed + 1)),
        learner_(kCheckpointNames, actorCriticSchedule(parameters, parameters.updates), policy_, critic_, 0) {
    for (int thread = 0; thread < parameters_.threads; ++thread) {
      runners_.push_back(std::make_unique<GridActorCriticTileRunner>(parameters_, policy_, critic_));
    }
  }

  void beginEpoch(int epoch, const GridCourse& course) {
    Random seeds(parameters_.seed * 1000003 + static_cast<std::uint64_t>(epoch));
    const int actors = runners_.front()->actors();
    // A set of maps that was not there before starts with the variance of nothing known.
    learner_.advantageVariances().resize(course.sets(), 1.0);
    sums_ = GridActorCriticSums::ofSets(course.sets());
    tiles_.clear();
    tiles_.resize(static_cast<std::size_t>((parameters_.agents + actors - 1) / actors));
    for (GridActorCriticTile& tile : tiles_) {
      for (int actor = 0; actor < actors; ++actor) tile.actors.emplace_back(course, parameters_.encoder, seeds());
    }
  }

  void update() {
    std::vector<double>& variances = learner_.advantageVariances();
    const double entropy_weight = learner_.entropyWeight();
    const Share own = shareOfTiles();
    parallelFor(own.count(), parameters_.threads, [&](int index, int thread) {
      GridActorCriticTile& tile = tiles_[static_cast<std::size_t>(own.first + index)];
      runners_[static_cast<std::size_t>(thread)]->run(learner_.policy(), learner_.critic(), entropy_weight, variances,
                                                      tile);
    });
    exchangeTiles();
    Eigen::VectorXf policy_gradient = Eigen::VectorXf::Zero(learner_.policy().size());
    Eigen::VectorXf critic_gradient = Eigen::VectorXf::Zero(learner_.critic().size());
    GridActorCriticSums sums = GridActorCriticSums::ofSets(variances.size());
    for (const GridActorCriticTile& tile : tiles_) {
      policy_gradient += tile.policy_gradient;
      critic_gradient += tile.critic_gradient;
      sums += tile.sums;
    }
    learner_.updatePolicy(policy_gradient, sums.steps);
    learner_.updateCritic(critic_gradient, sums.steps);
    // Slow, so that a window's own luck does not scale its own advantages.
    for (std::size_t set = 0; set < variances.size(); ++set) {
      if (sums.set_steps[set] == 0.0) continue;
      const double variance = sums.set_squared_advantages[set] / sums.set_steps[set];
      variances[set] += 0.02 * (variance - variances[set]);
    }
    learner_.finishUpdate(sums.steps);
    sums_ += sums;
  }

  ReinforcementReport report() {
    ReinforcementReport report;
    report.update = learner_.updates();
    report.steps = learner_.steps();
    report.reward = sums_.reward / sums_.steps;
    report.arrival = sums_.ended > 0.0 ? sums_.arrived / sums_.ended : 0.0;
    report.ratio = sums_.arrived > 0.0 ? sums_.ratio / sums_.arrived : 0.0;
    report.entropy = sums_.entropy / sums_.steps;
    const double mean = sums_.returns / sums_.steps;
    report.explained = 1.0 - sums_.squared_errors / (sums_.squared_returns - sums_.steps * mean * mean);
    sums_ = GridActorCriticSums::ofSets(learner_.advantageVariances().size());
    return report;
  }

  int updates() const { return learner_.updates(); }
  const LayerStack& layers() {
    setParameterVector(learner_.policy(), policy_);
    return policy_;
  }

  std::vector<std::uint8_t> checkpoint() const { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) { learner_.restore(checkpoint); }

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
    const Eigen::Index policy_size = learner_.policy().size();
    const Eigen::Index critic_size = learner_.critic().size();
    const std::size_t sets = learner_.advantageVariances().size();
    const auto sum_count = static_cast<Eigen::Index>(GridActorCriticSums::ofSets(sets).numbers().size());
    Eigen::MatrixXf gradients(policy_size + critic_size, tiles);
    Eigen::MatrixXd sums(sum_count, tiles);
    for (int index = own.first; index < own.last; ++index) {
      GridActorCriticTile& tile = tiles_[static_cast<std::size_t>(index)];
      gradients.col(index) << tile.policy_gradient, tile.critic_gradient;
      double* next = sums.col(index).data();
      for (const double* number : tile.sums.numbers()) *next++ = *number;
    }
    exchangeShares(&ranks, static_cast<int>(tiles), static_cast<std::size_t>(gradients.rows()), gradients.data());
    exchangeShares(&ranks, static_cast<int>(tiles), static_cast<std::size_t>(sum_count), sums.data());
    for (Eigen::Index index = 0; index < tiles; ++index) {
      GridActorCriticTile& tile = tiles_[static_cast<std::size_t>(index)];
      tile.policy_gradient = gradients.col(index).head(policy_size);
      tile.critic_gradient = gradients.col(index).tail(critic_size);
      tile.sums = GridActorCriticSums::ofSets(sets);
      const double* next = sums.col(index).data();
      for (double* number : tile.sums.numbers()) *number = *next++;
    }
  }

  GridActorCriticParameters parameters_;
  LayerStack policy_;
  LayerStack critic_;
  ActorCritic learner_;
  std::vector<std::unique_ptr<GridActorCriticTileRunner>> runners_;
  std::vector<GridActorCriticTile> tiles_;
  GridActorCriticSums sums_;
};

GridActorCritic::GridActorCritic(const GridActorCriticParameters& parameters, LayerStack layers)
    : implementation_(std::make_unique<Implementation>(parameters, std::move(layers))) {}
GridActorCritic::~GridActorCritic() = default;
void GridActorCritic::beginEpoch(int epoch, const GridCourse& course) { implementation_->beginEpoch(epoch, course); }
void GridActorCritic::update() { implementation_->update(); }
ReinforcementReport GridActorCritic::report() { return implementation_->report(); }
int GridActorCritic::updates() const { return implementation_->updates(); }
const LayerStack& GridActorCritic::layers() const { return implementation_->layers(); }
std::vector<std::uint8_t> GridActorCritic::checkpoint() const { return implementation_->checkpoint(); }
void GridActorCritic::restore(const std::vector<std::uint8_t>& checkpoint) { implementation_->restore(checkpoint); }

}  // namespace lstm_planner
