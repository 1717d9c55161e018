#include "lstm_planner/training/actor_critic.hpp"

#include <algorithm>
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
constexpr const char* kActorCriticFormat = "lstm_planner drive actor-critic 1";

}  // namespace

void validate(const ActorCriticParameters& parameters) {
  visitActorCriticParameters(parameters, RangeCheck());
  checkParameter(parameters.discount > 0.0, "discount", parameters.discount, "a number in (0, 1]");
  checkAtLeastOne("window", parameters.window);
  checkAtLeastOne("max_steps", parameters.max_steps);
  checkAtLeastOne("threads", parameters.threads);
}

void CriticSums::count(std::size_t set, double value, double advantage) {
  const double result = value + advantage;
  steps += 1.0;
  returns += result;
  squared_returns += result * result;
  squared_errors += advantage * advantage;
  set_steps[set] += 1.0;
  set_squared_advantages[set] += advantage * advantage;
}

double CriticSums::explained() const {
  const double spread = squared_returns - returns * returns / steps;
  return 1.0 - squared_errors / std::max(1e-12, spread);
}

void CriticSums::moveVariances(double share, std::vector<double>* variances) const {
  for (std::size_t set = 0; set < set_steps.size(); ++set) {
    if (set_steps[set] == 0.0) continue;
    double& variance = (*variances)[set];
    variance += share * (set_squared_advantages[set] / set_steps[set] - variance);
  }
}

CriticSums& CriticSums::operator+=(const CriticSums& other) {
  steps += other.steps;
  returns += other.returns;
  squared_returns += other.squared_returns;
  squared_errors += other.squared_errors;
  for (std::size_t set = 0; set < set_steps.size(); ++set) {
    set_steps[set] += other.set_steps[set];
    set_squared_advantages[set] += other.set_squared_advantages[set];
  }
  return *this;
}

ActorCritic::ActorCritic(const ActorCriticParameters& parameters, int updates, const LayerStack& policy,
                         const LayerStack& critic, std::size_t sets)
    : LearningProgress(updates),
      parameters_(parameters),
      policy_(parameterVector(policy)),
      critic_(parameterVector(critic)),
      policy_optimiser_(optimiserParameters(parameters.learning_rate, parameters.max_gradient_norm),
                        weightMask(policy)),
      critic_optimiser_(optimiserParameters(parameters.critic_learning_rate, parameters.max_gradient_norm),
                        weightMask(critic)),
      advantage_variances_(sets, 1.0) {}

double ActorCritic::entropyWeight() const {
  return parameters_.entropy_start + (parameters_.entropy_end - parameters_.entropy_start) * progress();
}

void ActorCritic::updatePolicy(const Eigen::VectorXf& gradient, double steps) {
  policy_optimiser_.update(gradient * static_cast<float>(1.0 / steps), progress(), policy_);
}

void ActorCritic::updateCritic(const Eigen::VectorXf& gradient, double steps) {
  critic_optimiser_.update(gradient * static_cast<float>(1.0 / steps), progress(), critic_);
}

std::vector<std::uint8_t> ActorCritic::checkpoint() const {
  const nlohmann::json content = {{"format", kActorCriticFormat},
                                  {"policy", vectorToJson(policy_)},
                                  {"critic", vectorToJson(critic_)},
                                  {"policy_optimiser", optimiserToJson(policy_optimiser_.state())},
                                  {"critic_optimiser", optimiserToJson(critic_optimiser_.state())},
                                  {"advantage_variances", advantage_variances_},
                                  {"steps", steps_},
                                  {"iterations", updates_}};
  return nlohmann::json::to_cbor(content);
}

void ActorCritic::restore(const std::vector<std::uint8_t>& checkpoint) try {
  const nlohmann::json content = checkpointJson(checkpoint, kActorCriticFormat);
  const Eigen::VectorXf policy = vectorFromJson(content.at("policy"));
  const Eigen::VectorXf critic = vectorFromJson(content.at("critic"));
  auto variances = content.at("advantage_variances").get<std::vector<double>>();
  if (policy.size() != policy_.size() || critic.size() != critic_.size()) {
    throw std::invalid_argument("networks of other sizes");
  }
  if (!advantage_variances_.empty() && variances.size() != advantage_variances_.size()) {
    throw std::invalid_argument("another number of kinds of maps or worlds");
  }
  const auto steps = content.at("steps").get<double>();
  const auto updates = static_cast<int>(wholeNumber(content.at("iterations"), 0, INT_MAX));
  policy_optimiser_.setState(optimiserFromJson(content.at("policy_optimiser")));
  critic_optimiser_.setState(optimiserFromJson(content.at("critic_optimiser")));
  policy_ = policy;
  critic_ = critic;
  advantage_variances_ = std::move(variances);
  steps_ = steps;
  updates_ = updates;
} catch (const std::exception& error) {
  throw std::invalid_argument(std::string("this is not a checkpoint of this training: ") + error.what());
}

}  // namespace lstm_planner
