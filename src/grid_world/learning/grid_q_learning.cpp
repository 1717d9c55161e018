#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"

#include <optional>
#include <utility>

#include "grid_world/learning/grid_q_learning_tile.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/tile_exchange.hpp"

namespace lstm_planner {
namespace {

/// Updates between replacements of one of the course's goals.
constexpr int kRenewalInterval = 8;

/// Tiles of agents that learn together.
class QTiles {
 public:
  QTiles(const GridQLearningParameters& parameters, const LayerStack& layers)
      : parameters_(parameters), exchange_(parameters.communicator, parameters.threads) {
    for (int thread = 0; thread < parameters.threads; ++thread) runners_.emplace_back(parameters, layers);
  }

  /// New agents on a course, rounded up to whole tiles.
  void start(const GridCourse& course, std::uint64_t seed) {
    Random seeds(seed);
    tiles_.clear();
    tiles_.resize(static_cast<std::size_t>((parameters_.agents + QTile::kActors - 1) / QTile::kActors));
    for (QTile& tile : tiles_) {
      for (int actor = 0; actor < QTile::kActors; ++actor) tile.actors.emplace_back(course, seeds());
    }
  }

  /// A window of all agents, and the sum of the gradients.
  QSums run(const QLearner& learner, double epsilon, Eigen::VectorXf* gradient) {
    const int count = static_cast<int>(tiles_.size());
    const auto work = [&](int tile, int thread) {
      return runners_[static_cast<std::size_t>(thread)].run(learner.weights(), learner.targetWeights(), epsilon,
                                                            &tiles_[static_cast<std::size_t>(tile)]);
    };
    QSums all;
    for (const QSums& sums : exchange_.each(count, QSums(), work)) all += sums;
    *gradient = exchange_.sumOf(count, learner.weights().size(), [&](int tile) -> const Eigen::VectorXf& {
      return tiles_[static_cast<std::size_t>(tile)].gradient;
    });
    return all;
  }

 private:
  const GridQLearningParameters& parameters_;
  TileExchange exchange_;
  std::vector<QTileRunner> runners_;  ///< one a thread
  std::vector<QTile> tiles_;
};

class GridQLearningOnMaps final : public GridQLearning {
 public:
  GridQLearningOnMaps(const GridQLearningParameters& parameters, std::vector<GridCourse::Set> maps, LayerStack layers)
      : parameters_(parameters),
        maps_(std::move(maps)),
        layers_(std::move(layers)),
        learner_(parameters, parameters.updates, layers_),
        tiles_(parameters_, layers_) {}

  int epoch() const override { return epoch_; }
  double progress() const override { return learner_.progress(); }
  bool done() const override { return epoch_ == parameters_.epochs; }
  bool judgementDue() const override { return epoch_done_; }
  bool resumable() const override { return !course_; }

  void step() override {
    if (!course_) startEpoch();
    update();
    epoch_done_ = learner_.updates() == firstUpdate(epoch_ + 1);
    if (epoch_done_) {
      ++epoch_;
      course_.reset();
    } else if (learner_.updates() % kRenewalInterval == 0) {
      course_->renew(1);
    }
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

  const LayerStack& layers() const override {
    setParameterVector(learner_.weights(), layers_);
    return layers_;
  }

  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override {
    learner_.restore(checkpoint);
    course_.reset();
    epoch_done_ = false;
    epoch_ = 0;
    while (epoch_ < parameters_.epochs && firstUpdate(epoch_ + 1) <= learner_.updates()) ++epoch_;
  }

 private:
  int firstUpdate(int epoch) const {
    return static_cast<int>(static_cast<std::int64_t>(parameters_.updates) * epoch / parameters_.epochs);
  }

  /// New goals and agents; what happens in an epoch depends only on the weights and the seed.
  void startEpoch() {
    const auto epoch = static_cast<std::uint64_t>(epoch_);
    course_.emplace(parameters_.course, maps_, parameters_.seed + epoch, parameters_.threads);
    tiles_.start(*course_, parameters_.seed * 1000003 + epoch);
  }

  void update() {
    learner_.startUpdate();
    epsilon_ = learner_.epsilon();
    Eigen::VectorXf gradient;
    const QSums sums = tiles_.run(learner_, epsilon_, &gradient);
    learner_.update(gradient / static_cast<float>(sums.values.steps));
    learner_.finishUpdate(sums.values.steps);
    sums_ += sums;
  }

  const GridQLearningParameters parameters_;
  std::vector<GridCourse::Set> maps_;
  mutable LayerStack layers_;  ///< get their weights when they are asked for
  QLearner learner_;
  QTiles tiles_;
  std::optional<GridCourse> course_;  ///< of the epoch that goes on
  int epoch_ = 0;
  bool epoch_done_ = false;  ///< by the last step
  QSums sums_;
  double epsilon_ = 0.0;
};

}  // namespace

void validate(const GridQLearningParameters& parameters) {
  visitGridQLearningParameters(parameters, RangeCheck());
  validate(static_cast<const QLearningParameters&>(parameters));
  validate(parameters.course);
  checkAtLeastOne("epochs", parameters.epochs);
  checkParameter(parameters.updates >= parameters.epochs, "updates", parameters.updates,
                 "at least one for each of the epochs");
}

std::unique_ptr<GridQLearning> makeGridQLearning(const GridQLearningParameters& parameters,
                                                 std::vector<GridCourse::Set> maps, LayerStack layers) {
  validate(parameters);
  checkGridNetwork(layers);
  return std::make_unique<GridQLearningOnMaps>(parameters, std::move(maps), std::move(layers));
}

}  // namespace lstm_planner
