#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "grid_world/learning/grid_q_learning_tile.hpp"
#include "lstm_planner/base/common/parallel_for.hpp"
#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "lstm_planner/base/learning/q_learner.hpp"
#include "lstm_planner/base/learning/q_learning_targets.hpp"

namespace lstm_planner {
namespace {

const QLearner::CheckpointNames kCheckpointNames{"lstm_planner q-learning 1", "updates"};

void checkFit(const LayerStack& layers, const GridEncoder& encoder) {
  if (inputSize(layers) == encoder.size() && outputSize(layers) == encoder.outputs()) return;
  throw std::invalid_argument("the network has " + std::to_string(inputSize(layers)) + " inputs and " +
                              std::to_string(outputSize(layers)) + " outputs, the encoder expects " +
                              std::to_string(encoder.size()) + " and " + std::to_string(encoder.outputs()));
}

}  // namespace

void validate(const GridQLearningParameters& parameters) {
  const auto atLeastOne = [](const char* name, int value) { checkParameter(value >= 1, name, value, "at least 1"); };
  atLeastOne("updates", parameters.updates);
  atLeastOne("agents", parameters.agents);
  atLeastOne("window", parameters.window);
  atLeastOne("max_steps", parameters.max_steps);
  atLeastOne("threads", parameters.threads);
  validateQ(parameters);
  validate(optimiserParameters(qLearningSchedule(parameters, parameters.updates)));
}

class GridQLearning::Implementation {
 public:
  Implementation(const GridQLearningParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        layers_((checkFit(layers, GridEncoder(parameters.encoder)), std::move(layers))),
        learner_(kCheckpointNames, qLearningSchedule(parameters, parameters.updates), layers_) {
    for (int thread = 0; thread < parameters_.threads; ++thread) {
      runners_.push_back(std::make_unique<QTileRunner>(parameters_, layers_));
    }
  }

  void beginEpoch(int epoch, const GridCourse& course) {
    Random seeds(parameters_.seed * 1000003 + static_cast<std::uint64_t>(epoch));
    const int actors = runners_.front()->actors();
    tiles_.clear();
    tiles_.resize(static_cast<std::size_t>((parameters_.agents + actors - 1) / actors));
    for (QTile& tile : tiles_) {
      for (int actor = 0; actor < actors; ++actor) tile.actors.emplace_back(course, parameters_.encoder, seeds());
    }
  }

  void update() {
    if (tiles_.empty()) throw std::logic_error("Q-learning was to learn before its first epoch started");
    learner_.startUpdate();
    epsilon_ = explorationAt(learner_.progress(), parameters_.exploration_start, parameters_.exploration_end,
                             parameters_.exploration_share);
    const Share own = shareOfTiles();
    parallelFor(own.count(), parameters_.threads, [&](int index, int thread) {
      runners_[static_cast<std::size_t>(thread)]->run(learner_.weights(), learner_.targetWeights(), epsilon_,
                                                      tiles_[static_cast<std::size_t>(own.first + index)]);
    });
    exchangeTiles(own);
    // In the order of the tiles, whichever thread was first.
    Eigen::VectorXf gradient = Eigen::VectorXf::Zero(learner_.weights().size());
    QSums sums;
    for (const QTile& tile : tiles_) {
      gradient += tile.gradient;
      sums += tile.sums;
    }
    learner_.update(gradient / static_cast<float>(sums.steps));
    learner_.finishUpdate(sums.steps);
    sums_ += sums;
  }

  ReinforcementReport report() {
    const auto mean = [](double sum, double count) { return count > 0.0 ? sum / count : 0.0; };
    ReinforcementReport report;
    report.update = learner_.updates();
    report.steps = learner_.steps();
    report.reward = mean(sums_.reward, sums_.steps);
    report.arrival = mean(sums_.arrived, sums_.ended);
    report.ratio = mean(sums_.ratio, sums_.arrived);
    report.epsilon = epsilon_;
    report.value = mean(sums_.value, sums_.steps);
    report.error = std::sqrt(mean(sums_.squared_error, sums_.steps));
    sums_ = {};
    return report;
  }

  int updates() const { return learner_.updates(); }
  const LayerStack& layers() {
    setParameterVector(learner_.weights(), layers_);
    return layers_;
  }

  std::vector<std::uint8_t> checkpoint() const { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) { learner_.restore(checkpoint); }

 private:
  Share shareOfTiles() const {
    const Communicator& ranks = *parameters_.communicator;
    return shareOf(static_cast<int>(tiles_.size()), ranks.rank(), ranks.size());
  }

  /// What this rank's tiles brought goes to all others, so that all add up the same.
  void exchangeTiles(const Share& own) {
    Communicator& ranks = *parameters_.communicator;
    if (ranks.size() == 1) return;
    Eigen::MatrixXf gradients(learner_.weights().size(), static_cast<Eigen::Index>(tiles_.size()));
    std::vector<QSums> sums(tiles_.size());
    for (int index = own.first; index < own.last; ++index) {
      const auto tile = static_cast<std::size_t>(index);
      gradients.col(index) = tiles_[tile].gradient;
      sums[tile] = tiles_[tile].sums;
    }
    const int count = static_cast<int>(tiles_.size());
    exchangeShares(&ranks, count, static_cast<std::size_t>(gradients.rows()), gradients.data());
    exchangeShares(&ranks, count, 1, sums.data());
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
      tiles_[tile].gradient = gradients.col(static_cast<Eigen::Index>(tile));
      tiles_[tile].sums = sums[tile];
    }
  }

  GridQLearningParameters parameters_;
  LayerStack layers_;
  QLearner learner_;
  std::vector<std::unique_ptr<QTileRunner>> runners_;
  std::vector<QTile> tiles_;
  QSums sums_;
  double epsilon_ = 0.0;
};

GridQLearning::GridQLearning(const GridQLearningParameters& parameters, LayerStack layers)
    : implementation_(std::make_unique<Implementation>(parameters, std::move(layers))) {}
GridQLearning::~GridQLearning() = default;
void GridQLearning::beginEpoch(int epoch, const GridCourse& course) { implementation_->beginEpoch(epoch, course); }
void GridQLearning::update() { implementation_->update(); }
ReinforcementReport GridQLearning::report() { return implementation_->report(); }
int GridQLearning::updates() const { return implementation_->updates(); }
const LayerStack& GridQLearning::layers() const { return implementation_->layers(); }
std::vector<std::uint8_t> GridQLearning::checkpoint() const { return implementation_->checkpoint(); }
void GridQLearning::restore(const std::vector<std::uint8_t>& checkpoint) { implementation_->restore(checkpoint); }

}  // namespace lstm_planner
