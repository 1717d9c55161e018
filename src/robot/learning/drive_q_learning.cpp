#include "lstm_planner/robot/learning/drive_q_learning.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/learning/optimiser.hpp"
#include "lstm_planner/base/learning/optimiser_json.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "lstm_planner/base/learning/q_learning_targets.hpp"
#include "robot/learning/drive_lanes.hpp"
#include "robot/learning/drive_practice.hpp"
#include "robot/learning/drive_q_tile.hpp"

namespace lstm_planner {
namespace {

constexpr const char* kCheckpointFormat = "lstm_planner drive q-learning 1";

/// m; a sector that sees less counts as this.
constexpr double kNearest = 0.1;

OptimiserParameters optimiserParameters(const DriveQLearningParameters& parameters) {
  OptimiserParameters optimiser;
  optimiser.learning_rate = parameters.learning_rate;
  optimiser.max_gradient_norm = parameters.max_gradient_norm;
  return optimiser;
}

}  // namespace

double driveThesisReward(const Observation& observation, const DriveThesisRewardWeights& weights) {
  double proximity = 0.0;
  for (const double range : observation.sector_ranges) proximity += 1.0 / std::max(kNearest, range);
  return -(weights.range * proximity + weights.distance * observation.goal_distance +
           weights.angle * std::abs(observation.goal_bearing));
}

void validate(const DriveQLearningParameters& parameters) {
  const auto atLeastOne = [](const char* name, int value) { checkParameter(value >= 1, name, value, "at least 1"); };
  atLeastOne("iterations", parameters.iterations);
  atLeastOne("worlds", parameters.worlds);
  atLeastOne("goals", parameters.goals);
  atLeastOne("starts", parameters.starts);
  atLeastOne("max_steps", parameters.max_steps);
  atLeastOne("window", parameters.window);
  atLeastOne("passes", parameters.passes);
  atLeastOne("threads", parameters.threads);
  checkParameter(parameters.contact_cost >= 0.0, "contact_cost", parameters.contact_cost, "at least 0");
  validateQ(parameters);
  validate(optimiserParameters(parameters));
  validate(parameters.policy.encoder);
  validate(parameters.course);
}

class DriveQLearning::Implementation {
 public:
  Implementation(const DriveQLearningParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        layers_(std::move(layers)),
        weights_(parameterVector(layers_)),
        target_weights_(weights_),
        optimiser_(optimiserParameters(parameters), weightMask(layers_)) {
    DrivePolicy(parameters.policy, layers_);  // throws when they do not fit together
  }

  DriveQLearningReport iterate() {
    if (iterations_ % parameters_.target_interval == 0) target_weights_ = weights_;
    const double progress = std::min(1.0, static_cast<double>(iterations_) / parameters_.iterations);
    DriveQLearningReport report;
    report.epsilon = explorationAt(progress, parameters_.exploration_start, parameters_.exploration_end,
                                   parameters_.exploration_share);
    const std::vector<PracticeEpisode> episodes = practise(rulesWith(report.epsilon), layers_, iterations_);
    learnFrom(episodes, parameters_.learning_rate * 0.5 * (1.0 + std::cos(M_PI * progress)), &report);
    setParameterVector(weights_, layers_);
    const PracticeSums sums = sumUp(episodes);
    all_steps_ += sums.steps;
    report.iteration = ++iterations_;
    report.steps = all_steps_;
    report.reward = sums.reward;
    report.arrival = sums.arrival;
    return report;
  }

  int iterations() const { return iterations_; }
  const LayerStack& layers() const { return layers_; }

  std::vector<std::uint8_t> checkpoint() const {
    const nlohmann::json content = {{"format", kCheckpointFormat},
                                    {"weights", vectorToJson(weights_)},
                                    {"target_weights", vectorToJson(target_weights_)},
                                    {"optimiser", optimiserToJson(optimiser_.state())},
                                    {"steps", all_steps_},
                                    {"iterations", iterations_}};
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
    const auto iterations = static_cast<int>(wholeNumber(content.at("iterations"), 0, INT_MAX));
    optimiser_.setState(optimiserFromJson(content.at("optimiser")));
    weights_ = weights;
    target_weights_ = target_weights;
    all_steps_ = steps;
    iterations_ = iterations;
    setParameterVector(weights_, layers_);
  } catch (const std::exception& error) {
    throw std::invalid_argument(std::string("this is not a checkpoint of this training: ") + error.what());
  }

 private:
  PracticeRules rulesWith(double epsilon) const {
    const ActionChances chances = epsilonGreedyChances(epsilon);
    if (parameters_.reward == DriveQLearningParameters::Reward::kProgress) {
      return practiceRules(parameters_, chances, progressReward(parameters_.step_cost, parameters_.contact_cost),
                           parameters_.arrival_bonus);
    }
    const auto reward = [weights = parameters_.thesis_reward](const PracticeOutcome& outcome) {
      return driveThesisReward(outcome.before, weights);
    };
    return practiceRules(parameters_, chances, reward, 0.0);
  }

  /// Fills in what `report` says of the values.
  void learnFrom(const std::vector<PracticeEpisode>& episodes, double rate, DriveQLearningReport* report) {
    DriveTiles<DriveQTile> tiles(parameters_.communicator, parameters_.threads,
                                 [this] { return std::make_unique<DriveQTile>(parameters_, layers_); });
    const int windows = tiles.pack(episodes);
    for (int pass = 0; pass < parameters_.passes; ++pass) {
      DriveQSums sums;
      const auto judge = [this](DriveQTile* tile) { return tile->judge(weights_, target_weights_); };
      for (const DriveQSums& some : tiles.each(DriveQSums(), judge)) sums += some;
      if (pass == 0 && sums.steps > 0.0) {
        report->value = sums.value / sums.steps;
        report->error = std::sqrt(sums.squared_error / sums.steps);
      }
      for (int window = 0; window < windows; ++window) {
        Eigen::VectorXf gradient;
        const double steps = tiles.addUp(
            weights_.size(), [&](DriveQTile* tile) { return tile->valueGradient(window, weights_); }, &gradient);
        if (steps > 0.0) optimiser_.update(gradient * static_cast<float>(1.0 / steps), rate, weights_);
      }
    }
  }

  DriveQLearningParameters parameters_;
  LayerStack layers_;
  Eigen::VectorXf weights_;
  Eigen::VectorXf target_weights_;
  Optimiser optimiser_;
  double all_steps_ = 0.0;
  int iterations_ = 0;
};

DriveQLearning::DriveQLearning(const DriveQLearningParameters& parameters, LayerStack layers)
    : implementation_(std::make_unique<Implementation>(parameters, std::move(layers))) {}
DriveQLearning::~DriveQLearning() = default;
DriveQLearningReport DriveQLearning::iterate() { return implementation_->iterate(); }
int DriveQLearning::iterations() const { return implementation_->iterations(); }
const LayerStack& DriveQLearning::layers() const { return implementation_->layers(); }
std::vector<std::uint8_t> DriveQLearning::checkpoint() const { return implementation_->checkpoint(); }
void DriveQLearning::restore(const std::vector<std::uint8_t>& checkpoint) { implementation_->restore(checkpoint); }

}  // namespace lstm_planner
