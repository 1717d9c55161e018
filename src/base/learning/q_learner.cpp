#include "lstm_planner/base/learning/q_learner.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/learning/optimiser_json.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"

namespace lstm_planner {

OptimiserParameters optimiserParameters(const QLearner::Schedule& schedule) {
  OptimiserParameters parameters;
  parameters.learning_rate = schedule.learning_rate;
  parameters.max_gradient_norm = schedule.max_gradient_norm;
  return parameters;
}

QLearner::QLearner(const CheckpointNames& names, const Schedule& schedule, const LayerStack& layers)
    : names_(names),
      schedule_(schedule),
      weights_(parameterVector(layers)),
      target_weights_(weights_),
      optimiser_(optimiserParameters(schedule), weightMask(layers)) {}

double QLearner::progress() const { return std::min(1.0, static_cast<double>(updates_) / schedule_.updates); }

void QLearner::startUpdate() {
  if (updates_ % schedule_.target_interval == 0) target_weights_ = weights_;
}

void QLearner::update(const Eigen::VectorXf& gradient) {
  optimiser_.update(gradient, schedule_.learning_rate * 0.5 * (1.0 + std::cos(M_PI * progress())), weights_);
}

void QLearner::finishUpdate(double steps) {
  ++updates_;
  steps_ += steps;
}

std::vector<std::uint8_t> QLearner::checkpoint() const {
  const nlohmann::json content = {{"format", names_.format},
                                  {"weights", vectorToJson(weights_)},
                                  {"target_weights", vectorToJson(target_weights_)},
                                  {"optimiser", optimiserToJson(optimiser_.state())},
                                  {"steps", steps_},
                                  {names_.updates, updates_}};
  return nlohmann::json::to_cbor(content);
}

void QLearner::restore(const std::vector<std::uint8_t>& checkpoint) try {
  const nlohmann::json content = checkpointJson(checkpoint);
  if (content.at("format") != names_.format) throw std::invalid_argument("another format");
  const Eigen::VectorXf weights = vectorFromJson(content.at("weights"));
  const Eigen::VectorXf target_weights = vectorFromJson(content.at("target_weights"));
  if (weights.size() != weights_.size() || target_weights.size() != weights_.size()) {
    throw std::invalid_argument("a network of another size");
  }
  const auto steps = content.at("steps").get<double>();
  const auto updates = static_cast<int>(wholeNumber(content.at(names_.updates), 0, INT_MAX));
  optimiser_.setState(optimiserFromJson(content.at("optimiser")));
  weights_ = weights;
  target_weights_ = target_weights;
  steps_ = steps;
  updates_ = updates;
} catch (const std::exception& error) {
  throw std::invalid_argument(std::string("this is not a checkpoint of this training: ") + error.what());
}

}  // namespace lstm_planner
