#include "lstm_planner/training/q_learner.hpp"

#include <climits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "training/checkpoint_json.hpp"

namespace lstm_planner {

namespace {

/// What a checkpoint says it is.
constexpr const char* kQLearningFormat = "lstm_planner q-learning 1";

// Share of random actions (epsilon).
constexpr double kExplorationStart = 1.0;
constexpr double kExplorationEnd = 0.05;
constexpr double kExplorationShare = 0.3;  ///< of the updates, after which the end is reached

}  // namespace

void validate(const QLearningParameters& parameters) {
  visitQLearningParameters(parameters, RangeCheck());
  checkParameter(parameters.discount < 1.0, "discount", parameters.discount, "a number in [0, 1)");
  checkAtLeastOne("window", parameters.window);
  checkAtLeastOne("max_steps", parameters.max_steps);
  checkAtLeastOne("threads", parameters.threads);
  validate(optimiserParameters(parameters.learning_rate, parameters.max_gradient_norm));
}

std::vector<double> lambdaTargets(const std::vector<QTransition>& steps, double discount, double trace_decay) {
  std::vector<double> targets(steps.size() - 1);
  double following = steps.back().value;
  for (std::size_t index = targets.size(); index-- > 0;) {
    const QTransition& step = steps[index];
    targets[index] = step.timed_out ? step.estimate : step.reward + (step.arrived ? 0.0 : discount * following);
    // What came of a move that was not the best says nothing about what the best one is worth.
    const double trust = step.greedy && !step.timed_out ? trace_decay : 0.0;
    following = step.value + trust * (targets[index] - step.value);
  }
  return targets;
}

QLearner::QLearner(const QLearningParameters& parameters, int updates, const LayerStack& layers)
    : LearningProgress(updates),
      parameters_(parameters),
      weights_(parameterVector(layers)),
      target_weights_(weights_),
      optimiser_(optimiserParameters(parameters.learning_rate, parameters.max_gradient_norm), weightMask(layers)) {}

double QLearner::epsilon() const {
  if (progress() >= kExplorationShare) return kExplorationEnd;
  return kExplorationStart + (kExplorationEnd - kExplorationStart) * progress() / kExplorationShare;
}

void QLearner::startUpdate() {
  if (updates_ % parameters_.target_interval == 0) target_weights_ = weights_;
}

void QLearner::update(const Eigen::VectorXf& gradient) { optimiser_.update(gradient, progress(), weights_); }

std::vector<std::uint8_t> QLearner::checkpoint() const {
  const nlohmann::json content = {{"format", kQLearningFormat},
                                  {"weights", vectorToJson(weights_)},
                                  {"target_weights", vectorToJson(target_weights_)},
                                  {"optimiser", optimiserToJson(optimiser_.state())},
                                  {"steps", steps_},
                                  {"updates", updates_}};
  return nlohmann::json::to_cbor(content);
}

void QLearner::restore(const std::vector<std::uint8_t>& checkpoint) try {
  const nlohmann::json content = checkpointJson(checkpoint, kQLearningFormat);
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
  steps_ = steps;
  updates_ = updates;
} catch (const std::exception& error) {
  throw std::invalid_argument(std::string("this is not a checkpoint of this training: ") + error.what());
}

}  // namespace lstm_planner
