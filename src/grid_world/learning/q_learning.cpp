#include "lstm_planner/grid_world/learning/q_learning.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "grid_world/learning/q_learning_tile.hpp"
#include "lstm_planner/base/common/parallel_for.hpp"
#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/learning/optimiser.hpp"
#include "lstm_planner/base/learning/optimiser_json.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "lstm_planner/base/learning/q_learning_targets.hpp"

namespace lstm_planner {
namespace {

constexpr const char* kCheckpointFormat = "lstm_planner q-learning 1";

OptimiserParameters optimiserParameters(const QLearningParameters& parameters) {
  OptimiserParameters optimiser;
  optimiser.learning_rate = parameters.learning_rate;
  optimiser.max_gradient_norm = parameters.max_gradient_norm;
  return optimiser;
}

void checkFit(const LayerStack& layers, const GridEncoder& encoder) {
  if (inputSize(layers) == encoder.size() && outputSize(layers) == encoder.outputs()) return;
  throw std::invalid_argument("the network has " + std::to_string(inputSize(layers)) + " inputs and " +
                              std::to_string(outputSize(layers)) + " outputs, the encoder expects " +
                              std::to_string(encoder.size()) + " and " + std::to_string(encoder.outputs()));
}

}  // namespace

void validate(const QLearningParameters& parameters) {
  const auto atLeastOne = [](const char* name, int value) { checkParameter(value >= 1, name, value, "at least 1"); };
  atLeastOne("updates", parameters.updates);
  atLeastOne("agents", parameters.agents);
  atLeastOne("window", parameters.window);
  atLeastOne("max_steps", parameters.max_steps);
  atLeastOne("threads", parameters.threads);
  validateQ(parameters);
  validate(optimiserParameters(parameters));
}

class QLearning::Implementation {
 public:
  Implementation(const QLearningParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        layers_((checkFit(layers, GridEncoder(parameters.encoder)), std::move(layers))),
        weights_(parameterVector(layers_)),
        target_weights_(weights_),
        optimiser_(optimiserParameters(parameters), weightMask(layers_)) {
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
    if (tiles_.empty()) throw std::logic_error("Q-learning was to learn before its first epoch began");
    if (updates_ % parameters_.target_interval == 0) target_weights_ = weights_;
    epsilon_ = explorationAt(static_cast<double>(updates_) / parameters_.updates, parameters_.exploration_start,
                             parameters_.exploration_end, parameters_.exploration_share);
    const Share own = shareOfTiles();
    parallelFor(own.count(), parameters_.threads, [&](int index, int thread) {
      runners_[static_cast<std::size_t>(thread)]->run(weights_, target_weights_, epsilon_,
                                                      tiles_[static_cast<std::size_t>(own.first + index)]);
    });
    exchangeTiles(own);
    // In the order of the tiles, whichever thread was first.
    Eigen::VectorXf gradient = Eigen::VectorXf::Zero(weights_.size());
    QSums sums;
    for (const QTile& tile : tiles_) {
      gradient += tile.gradient;
      sums += tile.sums;
    }
    const double progress = std::min(1.0, static_cast<double>(updates_) / parameters_.updates);
    const double rate = parameters_.learning_rate * 0.5 * (1.0 + std::cos(M_PI * progress));
    optimiser_.update(gradient / static_cast<float>(sums.steps), rate, weights_);
    ++updates_;
    sums_ += sums;
    all_steps_ += sums.steps;
  }

  QLearningReport report() {
    const auto mean = [](double sum, double count) { return count > 0.0 ? sum / count : 0.0; };
    QLearningReport report;
    report.update = updates_;
    report.steps = all_steps_;
    report.reward = mean(sums_.reward, sums_.steps);
    report.arrival = mean(sums_.arrived, sums_.ended);
    report.ratio = mean(sums_.ratio, sums_.arrived);
    report.epsilon = epsilon_;
    report.value = mean(sums_.value, sums_.steps);
    report.error = std::sqrt(mean(sums_.squared_error, sums_.steps));
    sums_ = {};
    return report;
  }

  const LayerStack& layers() {
    setParameterVector(weights_, layers_);
    return layers_;
  }

  std::vector<std::uint8_t> checkpoint() const {
    const nlohmann::json content = {{"format", kCheckpointFormat},
                                    {"weights", vectorToJson(weights_)},
                                    {"target_weights", vectorToJson(target_weights_)},
                                    {"optimiser", optimiserToJson(optimiser_.state())},
                                    {"steps", all_steps_},
                                    {"updates", updates_}};
    return nlohmann::json::to_cbor(content);
  }

  void restore(const std::vector<std::uint8_t>& checkpoint) try {
    const nlohmann::json content = checkpointJson(checkpoint);
    if (content.at("format") != kCheckpointFormat) throw std::invalid_argument("another format");
    const Eigen::VectorXf weights = vectorFromJson(content.at("weights"));
    const Eigen::VectorXf target_weights = vectorFromJson(content.at("target_weights"));
    if (weights.size() != weights_.size() || target_weights.size() != weights_.size()) {
      throw std::invalid_argument("a network of another size");
    }
    const auto steps = content.at("steps").get<double>();
    const auto updates = static_cast<int>(wholeNumber(content.at("updates"), 0, INT_MAX));
    optimiser_.setState(optimiserFromJson(content.at("optimiser")));
    weights_ = weights;
    target_weights_ = target_weights;
    all_steps_ = steps;
    updates_ = updates;
  } catch (const std::exception& error) {
    throw std::invalid_argument(std::string("this is not a checkpoint of this training: ") + error.what());
  }

 private:
  Share shareOfTiles() const {
    const Communicator& ranks = *parameters_.communicator;
    return shareOf(static_cast<int>(tiles_.size()), ranks.rank(), ranks.size());
  }

  /// What this rank's tiles brought goes to all others, so that all add up the same.
  void exchangeTiles(const Share& own) {
    Communicator& ranks = *parameters_.communicator;
    if (ranks.size() == 1) return;
    Eigen::MatrixXf gradients(weights_.size(), static_cast<Eigen::Index>(tiles_.size()));
    std::vector<QSums> sums(tiles_.size());
    for (int index = own.first; index < own.last; ++index) {
      const auto tile = static_cast<std::size_t>(index);
      gradients.col(index) = tiles_[tile].gradient;
      sums[tile] = tiles_[tile].sums;
    }
    const int count = static_cast<int>(tiles_.size());
    exchangeShares(&ranks, count, static_cast<std::size_t>(weights_.size()), gradients.data());
    exchangeShares(&ranks, count, 1, sums.data());
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
      tiles_[tile].gradient = gradients.col(static_cast<Eigen::Index>(tile));
      tiles_[tile].sums = sums[tile];
    }
  }

  QLearningParameters parameters_;
  LayerStack layers_;
  Eigen::VectorXf weights_;
  Eigen::VectorXf target_weights_;
  Optimiser optimiser_;
  std::vector<std::unique_ptr<QTileRunner>> runners_;
  std::vector<QTile> tiles_;
  QSums sums_;
  double all_steps_ = 0.0;
  double epsilon_ = 0.0;
  int updates_ = 0;
};

QLearning::QLearning(const QLearningParameters& parameters, LayerStack layers)
    : implementation_(std::make_unique<Implementation>(parameters, std::move(layers))) {}
QLearning::~QLearning() = default;
void QLearning::beginEpoch(int epoch, const GridCourse& course) { implementation_->beginEpoch(epoch, course); }
void QLearning::update() { implementation_->update(); }
QLearningReport QLearning::report() { return implementation_->report(); }
const LayerStack& QLearning::layers() const { return implementation_->layers(); }
std::vector<std::uint8_t> QLearning::checkpoint() const { return implementation_->checkpoint(); }
void QLearning::restore(const std::vector<std::uint8_t>& checkpoint) { implementation_->restore(checkpoint); }

}  // namespace lstm_planner
