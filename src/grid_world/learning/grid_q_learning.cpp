#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "grid_world/learning/grid_q_learning_tile.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/q_learner.hpp"

namespace lstm_planner {
namespace {

const QLearner::CheckpointNames kQLearningNames{"lstm_planner q-learning 1", "updates"};

void checkFit(const LayerStack& layers, const GridEncoder& encoder) {
  if (inputSize(layers) == encoder.size() && outputSize(layers) == encoder.outputs()) return;
  throw std::invalid_argument("the network has " + std::to_string(inputSize(layers)) + " inputs and " +
                              std::to_string(outputSize(layers)) + " outputs, the encoder expects " +
                              std::to_string(encoder.size()) + " and " + std::to_string(encoder.outputs()));
}

class GridQLearning final : public GridLearner {
 public:
  GridQLearning(const GridQLearningParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        layers_((checkFit(layers, GridEncoder(parameters.encoder)), std::move(layers))),
        learner_(kQLearningNames, parameters, parameters.updates, layers_),
        tiles_(parameters.communicator, parameters.threads,
               [this] { return std::make_unique<QTileRunner>(parameters_, layers_); }) {}

  void startEpoch(int epoch, const GridCourse& course) override {
    tiles_.start(parameters_.agents, course, parameters_.encoder,
                 parameters_.seed * 1000003 + static_cast<std::uint64_t>(epoch));
  }

  void update() override {
    if (tiles_.empty()) throw std::logic_error("Q-learning was to learn before its first epoch started");
    learner_.startUpdate();
    epsilon_ = learner_.epsilon();
    const QSums sums = tiles_.run(QSums(), [&](QTileRunner* runner, QTile* tile) {
      return runner->run(learner_.weights(), learner_.targetWeights(), epsilon_, tile);
    });
    const Eigen::VectorXf gradient = tiles_.sumOf(&QTile::gradient, learner_.weights().size());
    learner_.update(gradient / static_cast<float>(sums.values.steps));
    learner_.finishUpdate(sums.values.steps);
    sums_ += sums;
  }

  ReinforcementReport report() override {
    ReinforcementReport report = learner_.report(sums_.values);
    if (sums_.values.steps > 0.0) report.reward = sums_.reward / sums_.values.steps;
    report.arrival = sums_.episodes.arrival();
    report.ratio = sums_.episodes.meanRatio();
    report.epsilon = epsilon_;
    sums_ = {};
    return report;
  }

  int updates() const override { return learner_.updates(); }
  const LayerStack& layers() const override {
    setParameterVector(learner_.weights(), layers_);
    return layers_;
  }

  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  GridQLearningParameters parameters_;
  mutable LayerStack layers_;  ///< get their weights when they are asked for
  QLearner learner_;
  GridTiles<QTile, QTileRunner> tiles_;
  QSums sums_;
  double epsilon_ = 0.0;
};

}  // namespace

void validate(const GridQLearningParameters& parameters) {
  visitGridLearnerParameters(parameters, RangeCheck());
  validate(static_cast<const QLearningParameters&>(parameters));
}

std::unique_ptr<GridLearner> makeGridQLearning(const GridQLearningParameters& parameters, LayerStack layers) {
  return std::make_unique<GridQLearning>(parameters, std::move(layers));
}

}  // namespace lstm_planner
