#include "lstm_planner/training/optimiser.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {
namespace {

// As the papers propose.
constexpr double kBeta1 = 0.9;    ///< Adam's decay of the mean of gradients
constexpr double kBeta2 = 0.999;  ///< and of that of squared gradients
constexpr double kAdamEpsilon = 1e-8;
constexpr double kAdaDeltaEpsilon = 1e-6;

}  // namespace

void validate(const OptimiserParameters& parameters) {
  checkPositive("learning_rate", parameters.learning_rate);
  checkParameter(parameters.momentum >= 0.0 && parameters.momentum < 1.0, "momentum", parameters.momentum,
                 "a number in [0, 1)");
  checkNotNegative("l1_decay", parameters.l1_decay);
  checkNotNegative("max_gradient_norm", parameters.max_gradient_norm);
}

double clipToNorm(double max_norm, Eigen::VectorXf& gradient) {
  const double norm = gradient.cast<double>().norm();
  if (max_norm > 0.0 && norm > max_norm) gradient *= static_cast<float>(max_norm / norm);
  return norm;
}

Optimiser::Optimiser(const OptimiserParameters& parameters, Eigen::VectorXf mask)
    : parameters_(parameters), mask_(std::move(mask)) {
  validate(parameters_);
  state_.velocity.setZero(mask_.size());
  state_.squared_average.setZero(mask_.size());
}

double Optimiser::rate(double progress) const {
  if (parameters_.schedule == LearningRateSchedule::kConstant) return parameters_.learning_rate;
  return parameters_.learning_rate * 0.5 * (1.0 + std::cos(M_PI * progress));
}

void Optimiser::update(Eigen::VectorXf gradient, double progress, Eigen::VectorXf& parameters) {
  clipToNorm(parameters_.max_gradient_norm, gradient);
  gradient += static_cast<float>(parameters_.l1_decay) * parameters.cwiseProduct(mask_).cwiseSign();
  ++state_.updates;
  switch (parameters_.kind) {
    case OptimiserKind::kMomentum:
      return updateByMomentum(gradient, rate(progress), parameters);
    case OptimiserKind::kAdam:
      return updateByAdam(gradient, rate(progress), parameters);
    case OptimiserKind::kAdaDelta:
      return updateByAdaDelta(gradient, rate(progress), parameters);
  }
}

void Optimiser::setState(const State& state) {
  if (state.velocity.size() != mask_.size() || state.squared_average.size() != mask_.size()) {
    throw std::invalid_argument("the optimiser's state is that of " + std::to_string(state.velocity.size()) +
                                " parameters, expected " + std::to_string(mask_.size()));
  }
  state_ = state;
}

void Optimiser::updateByMomentum(const Eigen::VectorXf& gradient, double learning_rate, Eigen::VectorXf& parameters) {
  state_.velocity =
      static_cast<float>(parameters_.momentum) * state_.velocity - static_cast<float>(learning_rate) * gradient;
  parameters += state_.velocity;
}

void Optimiser::updateByAdam(const Eigen::VectorXf& gradient, double learning_rate, Eigen::VectorXf& parameters) {
  const float beta1 = static_cast<float>(kBeta1);
  const float beta2 = static_cast<float>(kBeta2);
  // Rounded after the subtraction: 1 - 0.999 in single precision is off by 5e-5 of its value.
  const float share1 = static_cast<float>(1.0 - kBeta1);
  const float share2 = static_cast<float>(1.0 - kBeta2);
  state_.velocity = beta1 * state_.velocity + share1 * gradient;
  state_.squared_average = beta2 * state_.squared_average + share2 * gradient.cwiseAbs2();
  // Both means start at zero; these factors take that out again.
  const double count = static_cast<double>(state_.updates);
  const float mean_correction = static_cast<float>(1.0 / (1.0 - std::pow(kBeta1, count)));
  const float square_correction = static_cast<float>(1.0 / (1.0 - std::pow(kBeta2, count)));
  parameters.array() -=
      static_cast<float>(learning_rate) * mean_correction * state_.velocity.array() /
      ((square_correction * state_.squared_average.array()).sqrt() + static_cast<float>(kAdamEpsilon));
}

void Optimiser::updateByAdaDelta(const Eigen::VectorXf& gradient, double learning_rate, Eigen::VectorXf& parameters) {
  const float rho = static_cast<float>(parameters_.momentum);
  const float share = static_cast<float>(1.0 - parameters_.momentum);
  const float epsilon = static_cast<float>(kAdaDeltaEpsilon);
  state_.squared_average = rho * state_.squared_average + share * gradient.cwiseAbs2();
  const Eigen::VectorXf update =
      (gradient.array() * ((state_.velocity.array() + epsilon) / (state_.squared_average.array() + epsilon)).sqrt())
          .matrix();
  state_.velocity = rho * state_.velocity + share * update.cwiseAbs2();
  parameters -= static_cast<float>(learning_rate) * update;
}

}  // namespace lstm_planner
