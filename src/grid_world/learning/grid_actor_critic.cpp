#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "grid_world/learning/grid_actor_critic_tile.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/training/actor_critic.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner {
namespace {

const ActorCritic::CheckpointNames kActorCriticNames{"lstm_planner actor-critic 1", "updates"};

/// Share by which the variances move towards those of one window: slow, so that a window's own luck does not scale its
/// own advantages.
constexpr double kVarianceRate = 0.02;

class GridActorCritic final : public GridLearner {
 public:
  GridActorCritic(const GridActorCriticParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        policy_(std::move(layers)),
        critic_(makeCritic(GridEncoder(parameters.encoder).size() + kGridPrivilegedInputs, parameters.critic_units,
                           parameters.seed + 1)),
        learner_(kActorCriticNames, parameters, parameters.updates, policy_, critic_, 0),
        tiles_(parameters.communicator, parameters.threads,
               [this] { return std::make_unique<GridActorCriticTileRunner>(parameters_, policy_, critic_); }) {}

  void startEpoch(int epoch, const GridCourse& course) override {
    // A set of maps that was not there before starts with the variance of nothing known.
    learner_.advantageVariances().resize(course.sets(), 1.0);
    sums_ = GridActorCriticSums(course.sets());
    tiles_.start(parameters_.agents, course, parameters_.encoder,
                 parameters_.seed * 1000003 + static_cast<std::uint64_t>(epoch));
  }

  void update() override {
    std::vector<double>& variances = learner_.advantageVariances();
    const GridActorCriticLesson lesson = lessonOf(learner_.updates());
    const auto run = [&](GridActorCriticTileRunner* runner, GridActorCriticTile* tile) {
      return runner->run(learner_.policy(), learner_.critic(), lesson, variances, tile);
    };
    const GridActorCriticSums sums = tiles_.run(GridActorCriticSums(variances.size()), run);
    const Eigen::VectorXf policy_gradient =
        tiles_.sumOf(&GridActorCriticTile::policy_gradient, learner_.policy().size());
    const Eigen::VectorXf critic_gradient =
        tiles_.sumOf(&GridActorCriticTile::critic_gradient, learner_.critic().size());
    const double steps = sums.judged.steps;
    learner_.updatePolicy(policy_gradient, steps);
    learner_.updateCritic(critic_gradient, steps);
    sums.judged.moveVariances(kVarianceRate, &variances);
    learner_.finishUpdate(steps);
    sums_ += sums;
  }

  ReinforcementReport report() override {
    ReinforcementReport report = learner_.report(sums_.judged);
    report.reward = sums_.reward / sums_.judged.steps;
    report.arrival = sums_.episodes.arrival();
    report.ratio = sums_.episodes.meanRatio();
    report.entropy = sums_.entropy / sums_.judged.steps;
    sums_ = GridActorCriticSums(learner_.advantageVariances().size());
    return report;
  }

  int updates() const override { return learner_.updates(); }
  const LayerStack& layers() const override {
    setParameterVector(learner_.policy(), policy_);
    return policy_;
  }

  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  GridActorCriticLesson lessonOf(int update) const {
    GridActorCriticLesson lesson;
    lesson.entropy_weight = learner_.entropyWeight();
    lesson.taught = update < parameters_.taught_updates;
    // In the last third of the lessons all moves are the network's.
    if (lesson.taught) lesson.network_share = std::min(1.0, 1.5 * update / parameters_.taught_updates);
    return lesson;
  }

  GridActorCriticParameters parameters_;
  mutable LayerStack policy_;  ///< gets its weights when it is asked for
  LayerStack critic_;
  ActorCritic learner_;
  GridTiles<GridActorCriticTile, GridActorCriticTileRunner> tiles_;
  GridActorCriticSums sums_;
};

}  // namespace

void validate(const GridActorCriticParameters& parameters) {
  validate(static_cast<const ActorCriticParameters&>(parameters));
  visitGridLearnerParameters(parameters, RangeCheck());
  visitGridActorCriticParameters(parameters, RangeCheck());
}

std::unique_ptr<GridLearner> makeGridActorCritic(const GridActorCriticParameters& parameters, LayerStack layers) {
  if (parameters.taught_updates > 0 && parameters.encoder.inputs != GridEncoderParameters::Inputs::kBoundary) {
    throw std::invalid_argument("taught-updates is " + std::to_string(parameters.taught_updates) + " with the inputs " +
                                nameOf(parameters.encoder.inputs) + ", expected 0 or the inputs boundary");
  }
  return std::make_unique<GridActorCritic>(parameters, std::move(layers));
}

}  // namespace lstm_planner
