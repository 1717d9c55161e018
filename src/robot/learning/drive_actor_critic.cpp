#include "lstm_planner/robot/learning/drive_actor_critic.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/base/learning/optimiser.hpp"
#include "lstm_planner/base/learning/optimiser_json.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "robot/learning/drive_batch.hpp"
#include "robot/learning/drive_practice.hpp"
#include "robot/learning/recorded_practice.hpp"

namespace lstm_planner {
namespace {

constexpr const char* kCheckpointFormat = "lstm_planner drive actor-critic 1";

OptimiserParameters optimiserParameters(double learning_rate, double max_norm) {
  OptimiserParameters parameters;
  parameters.learning_rate = learning_rate;
  parameters.max_gradient_norm = max_norm;
  return parameters;
}

LayerStack makeCritic(int policy_inputs, const std::vector<int>& units, std::uint64_t seed) {
  LayerStack layers = makeDenseStack(policy_inputs + kDrivePrivilegedInputs, units, 1);
  initialise({}, seed, layers);
  return layers;
}

/// Preferences so many times as far apart: the greedy choice stays, random ones come nearer to it.
Eigen::VectorXf sharpened(Eigen::VectorXf parameters, const LayerStack& layers, double factor) {
  const auto* last = std::get_if<DenseLayer>(&layers.back());
  if (!last) throw std::invalid_argument("the policy's last layer is not fully connected");
  const Eigen::Index count = last->weights.size() + last->bias.size();
  parameters.tail(count) *= static_cast<float>(factor);
  return parameters;
}

}  // namespace

void validate(const DriveActorCriticParameters& parameters) {
  const auto check = [](const char* name, int value) { checkParameter(value >= 1, name, value, "at least 1"); };
  check("iterations", parameters.iterations);
  check("worlds", parameters.worlds);
  check("goals", parameters.goals);
  check("starts", parameters.starts);
  check("max_steps", parameters.max_steps);
  check("window", parameters.window);
  check("passes", parameters.passes);
  check("threads", parameters.threads);
  checkPositive("clip", parameters.clip);
  checkPositive("sharpness", parameters.sharpness);
  checkPositive("learning_rate", parameters.learning_rate);
  checkPositive("critic_learning_rate", parameters.critic_learning_rate);
  checkParameter(parameters.discount > 0.0 && parameters.discount < 1.0, "discount", parameters.discount,
                 "a number in (0, 1)");
  checkParameter(parameters.advantage_decay >= 0.0 && parameters.advantage_decay <= 1.0, "advantage_decay",
                 parameters.advantage_decay, "a number in [0, 1]");
  validate(parameters.policy.encoder);
  validate(parameters.course);
}

class DriveActorCritic::Implementation {
 public:
  Implementation(const DriveActorCriticParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        policy_(std::move(layers)),
        critic_(makeCritic(Encoder(parameters.policy.encoder).size(), parameters.critic_units, parameters.seed + 1)),
        policy_parameters_(sharpened(parameterVector(policy_), policy_, parameters.sharpness)),
        critic_parameters_(parameterVector(critic_)),
        policy_optimiser_(optimiserParameters(parameters.learning_rate, parameters.max_gradient_norm),
                          weightMask(policy_)),
        critic_optimiser_(optimiserParameters(parameters.critic_learning_rate, parameters.max_gradient_norm),
                          weightMask(critic_)),
        advantage_variances_(parameters.course.worlds.size(), 1.0) {
    DrivePolicy(parameters.policy, policy_);  // throws when they do not fit together
    setParameterVector(policy_parameters_, policy_);
  }

  void follow(const Dataset& recordings, double weight) {
    checkPositive("recordings_weight", weight);
    recorded_ = recordedPractice(recordings, parameters_.policy, 0.0);
    recorded_steps_ = 0.0;
    for (const PracticeEpisode& episode : recorded_) recorded_steps_ += static_cast<double>(episode.steps.size());
    if (recorded_.empty()) throw std::invalid_argument("the recordings have no steps, expected at least one");
    imitation_ = weight;
  }

  DriveActorCriticReport iterate() {
    const PracticeReward reward = progressReward(parameters_.step_cost, parameters_.contact_cost);
    std::vector<PracticeEpisode> episodes =
        practise(practiceRules(parameters_, preferredChances, reward, parameters_.arrival_bonus), policy_, iterations_);
    const PracticeSums sums = sumUp(episodes);
    episodes.insert(episodes.end(), recorded_.begin(), recorded_.end());
    DriveBatch batch(parameters_, policy_, critic_, episodes);
    const double progress = static_cast<double>(iterations_) / parameters_.iterations;
    const double rate = 0.5 * (1.0 + std::cos(M_PI * progress));
    DriveBatchWeights weights;
    weights.entropy =
        parameters_.entropy_start + (parameters_.entropy_end - parameters_.entropy_start) * std::min(1.0, progress);
    if (!recorded_.empty()) weights.imitation = imitation_ * sums.steps / recorded_steps_;
    batch.judge(critic_parameters_, &advantage_variances_);
    weights.advantage_variances = advantage_variances_;
    // The critic is new at first: let it learn before the policy follows it.
    const bool critic_alone = iterations_ == 0;
    for (int pass = 0; pass < parameters_.passes; ++pass) {
      batch.rewind();
      while (batch.next()) {
        Eigen::VectorXf gradient;
        if (!critic_alone) {
          const double chosen = batch.policyGradient(policy_parameters_, weights, &gradient);
          if (chosen > 0.0) {
            policy_optimiser_.update(gradient * static_cast<float>(1.0 / chosen), parameters_.learning_rate * rate,
                                     policy_parameters_);
          }
        }
        const double steps = batch.criticGradient(critic_parameters_, &gradient);
        if (steps > 0.0) {
          critic_optimiser_.update(gradient * static_cast<float>(1.0 / steps), parameters_.critic_learning_rate * rate,
                                   critic_parameters_);
        }
      }
    }
    setParameterVector(policy_parameters_, policy_);
    ++iterations_;
    return report(sums, batch);
  }

  int iterations() const { return iterations_; }
  const LayerStack& layers() const { return policy_; }

  std::vector<std::uint8_t> checkpoint() const {
    nlohmann::json content;
    content["format"] = kCheckpointFormat;
    content["policy"] = vectorToJson(policy_parameters_);
    content["critic"] = vectorToJson(critic_parameters_);
    content["policy_optimiser"] = optimiserToJson(policy_optimiser_.state());
    content["critic_optimiser"] = optimiserToJson(critic_optimiser_.state());
    content["advantage_variances"] = advantage_variances_;
    content["steps"] = all_steps_;
    content["iterations"] = iterations_;
    return nlohmann::json::to_cbor(content);
  }

  void restore(const std::vector<std::uint8_t>& checkpoint) try {
    const nlohmann::json content = checkpointJson(checkpoint);
    if (content.at("format") != kCheckpointFormat) throw std::invalid_argument("another format");
    const Eigen::VectorXf policy = vectorFromJson(content.at("policy"));
    const Eigen::VectorXf critic = vectorFromJson(content.at("critic"));
    const auto variances = content.at("advantage_variances").get<std::vector<double>>();
    if (policy.size() != policy_parameters_.size() || critic.size() != critic_parameters_.size() ||
        variances.size() != advantage_variances_.size()) {
      throw std::invalid_argument("networks or worlds differ");
    }
    policy_optimiser_.setState(optimiserFromJson(content.at("policy_optimiser")));
    critic_optimiser_.setState(optimiserFromJson(content.at("critic_optimiser")));
    policy_parameters_ = policy;
    critic_parameters_ = critic;
    advantage_variances_ = variances;
    all_steps_ = content.at("steps").get<double>();
    iterations_ = static_cast<int>(wholeNumber(content.at("iterations"), 0, INT_MAX));
    setParameterVector(policy_parameters_, policy_);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("not a checkpoint of this training: ") + error.what());
  }

 private:
  DriveActorCriticReport report(const PracticeSums& sums, DriveBatch& batch) {
    DriveActorCriticReport report;
    report.iteration = iterations_;
    all_steps_ += sums.steps;
    report.steps = all_steps_;
    report.reward = sums.reward;
    report.arrival = sums.arrival;
    report.entropy = batch.entropy();
    report.explained = batch.explained();
    return report;
  }

  DriveActorCriticParameters parameters_;
  LayerStack policy_;
  LayerStack critic_;
  Eigen::VectorXf policy_parameters_;
  Eigen::VectorXf critic_parameters_;
  Optimiser policy_optimiser_;
  Optimiser critic_optimiser_;
  /// By kind of world: what is a large gain in the open is a small one in a maze, and each is to count alike.
  std::vector<double> advantage_variances_;
  std::vector<PracticeEpisode> recorded_;
  double recorded_steps_ = 0.0;
  double imitation_ = 0.0;
  double all_steps_ = 0.0;
  int iterations_ = 0;
};

DriveActorCritic::DriveActorCritic(const DriveActorCriticParameters& parameters, LayerStack layers)
    : implementation_(std::make_unique<Implementation>(parameters, std::move(layers))) {}
DriveActorCritic::~DriveActorCritic() = default;
void DriveActorCritic::follow(const Dataset& recordings, double weight) { implementation_->follow(recordings, weight); }
DriveActorCriticReport DriveActorCritic::iterate() { return implementation_->iterate(); }
int DriveActorCritic::iterations() const { return implementation_->iterations(); }
const LayerStack& DriveActorCritic::layers() const { return implementation_->layers(); }
std::vector<std::uint8_t> DriveActorCritic::checkpoint() const { return implementation_->checkpoint(); }
void DriveActorCritic::restore(const std::vector<std::uint8_t>& checkpoint) { implementation_->restore(checkpoint); }

}  // namespace lstm_planner
