#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"

#include <optional>
#include <utility>

#include "grid_world/learning/grid_q_learning_tile.hpp"
#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner {
namespace {

/// Updates between replacements of one of the course's goals.
constexpr int kRenewalInterval = 8;

class GridQLearningOnMaps final : public GridQLearning {
 public:
  GridQLearningOnMaps(const GridQLearningParameters& parameters, std::vector<GridCourse::Set> maps, LayerStack layers)
      : parameters_(parameters),
        maps_(std::move(maps)),
        layers_(std::move(layers)),
        learner_(parameters, parameters.updates, layers_) {}

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

  Report report() override {
    Report report;
    report.steps = learner_.steps();
    if (sums_.steps > 0.0) report.reward = sums_.reward / sums_.steps;
    if (sums_.ended > 0.0) report.arrival = sums_.arrived / sums_.ended;
    if (sums_.arrived > 0.0) report.ratio = sums_.ratio / sums_.arrived;
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
    epoch_ = 0;
    while (epoch_ < parameters_.epochs && firstUpdate(epoch_ + 1) <= learner_.updates()) ++epoch_;
    epoch_done_ = epoch_ > 0;
  }

 private:
  int firstUpdate(int epoch) const {
    return static_cast<int>(static_cast<std::int64_t>(parameters_.updates) * epoch / parameters_.epochs);
  }

  /// New goals and agents; what happens in an epoch depends only on the weights and the seed.
  void startEpoch() {
    const auto epoch = static_cast<std::uint64_t>(epoch_);
    course_.emplace(parameters_.course, maps_, parameters_.seed + epoch, parameters_.threads);
    Random seeds(parameters_.seed * 1000003 + epoch);
    tiles_.clear();
    for (int agents = 0; agents < parameters_.agents; agents += QTile::kActors) {
      tiles_.emplace_back(parameters_, layers_, *course_, &seeds);
    }
  }

  void update() {
    learner_.startUpdate();
    const double epsilon = learner_.epsilon();
    const int count = static_cast<int>(tiles_.size());
    const auto work = [&](int tile, int /*thread*/) {
      return tiles_[static_cast<std::size_t>(tile)].run(learner_.weights(), learner_.targetWeights(), epsilon);
    };
    const QSums sums = parallelSum(count, parameters_.threads, QSums(), work);
    Eigen::VectorXf gradient = Eigen::VectorXf::Zero(learner_.weights().size());
    for (const QTile& tile : tiles_) gradient += tile.gradient();
    learner_.update(gradient / static_cast<float>(sums.steps));
    learner_.finishUpdate(sums.steps);
    sums_ += sums;
  }

  const GridQLearningParameters parameters_;
  std::vector<GridCourse::Set> maps_;
  mutable LayerStack layers_;  ///< get their weights when they are asked for
  QLearner learner_;
  std::optional<GridCourse> course_;  ///< of the epoch that goes on
  std::vector<QTile> tiles_;          ///< of the same
  int epoch_ = 0;
  bool epoch_done_ = false;  ///< and the next has not begun
  QSums sums_;
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
  LaneNetwork(layers, QTile::kActors, 1);  // throws
  return std::make_unique<GridQLearningOnMaps>(parameters, std::move(maps), std::move(layers));
}

}  // namespace lstm_planner
