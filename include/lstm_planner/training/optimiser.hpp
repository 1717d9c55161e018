#pragma once

#include <Eigen/Core>

namespace lstm_planner {

/// By which rule the weights follow the gradient.
enum class OptimiserKind {
  kMomentum,  ///< gradient descent with momentum (thesis Eq. 3.13-3.14)
  kAdam,      ///< Kingma and Ba, "Adam: A Method for Stochastic Optimization", ICLR 2015, algorithm 1
  /// Zeiler, "ADADELTA: An Adaptive Learning Rate Method", 2012, algorithm 1, with the update times the learning rate
  /// as in Caffe. The thesis's own program used it.
  kAdaDelta,
};

/// How the learning rate changes during a training.
enum class LearningRateSchedule {
  kConstant,  ///< it does not change
  kCosine,    ///< half a cosine from the learning rate at the first step to 0 after the last
};

/// How weights follow the gradient.
struct OptimiserParameters {
  OptimiserKind kind = OptimiserKind::kAdam;
  double learning_rate = 0.005;  ///< alpha, > 0
  LearningRateSchedule schedule = LearningRateSchedule::kCosine;
  double momentum = 0.95;  ///< in [0, 1); kMomentum: mu; kAdaDelta: rho, decay of its two means

  /// beta, >= 0: beta * sum |w| is added to the error, so that weights do not grow needlessly (L1, thesis Eq. 3.7 and
  /// 3.8). Biases are left alone, so that decay does not close the forget gates.
  double l1_decay = 0.0;
  double max_gradient_norm = 1;  ///< longer gradients of the error (without decay) are shortened to this; 0: never
};

/// Those of a learner by reinforcement; the others are the defaults.
inline OptimiserParameters optimiserParameters(double learning_rate, double max_gradient_norm) {
  OptimiserParameters parameters;
  parameters.learning_rate = learning_rate;
  parameters.max_gradient_norm = max_gradient_norm;
  return parameters;
}

/// Throws std::invalid_argument with one sentence naming the parameter, its value and its range.
void validate(const OptimiserParameters& parameters);

/// Shortens the gradient to `max_norm` if it is longer (0: never). Returns its length before.
double clipToNorm(double max_norm, Eigen::VectorXf& gradient);

/// Turns gradients into updates of one parameter vector; its velocities or moments start at zero.
class Optimiser {
 public:
  /// `mask`: 1 for weights and 0 for biases, as weightMask() returns it. Throws as validate().
  Optimiser(const OptimiserParameters& parameters, Eigen::VectorXf mask);

  /// The learning rate when the share `progress` of the training is done.
  double rate(double progress) const;

  /// One update, when the share `progress` of the training is done. `gradient` is that of the mean error, without
  /// decay. Shortens it, adds the decay, beta * sign(w) (thesis Eq. 3.11 prints a minus and no sign), and moves
  /// `parameters`. Momentum: v' = mu v - alpha gradient, w' = w + v' (thesis Eq. 3.14 prints w' for w).
  void update(Eigen::VectorXf gradient, double progress, Eigen::VectorXf& parameters);

  /// What the next update depends on besides its arguments.
  struct State {
    Eigen::VectorXf velocity;         ///< kMomentum: v; kAdam: mean of gradients; kAdaDelta: mean of squared updates
    Eigen::VectorXf squared_average;  ///< kAdam, kAdaDelta: mean of squared gradients
    long updates = 0;
  };
  const State& state() const { return state_; }
  /// Throws std::invalid_argument if it is the state of another number of parameters.
  void setState(const State& state);

 private:
  void updateByMomentum(const Eigen::VectorXf& gradient, double learning_rate, Eigen::VectorXf& parameters);
  void updateByAdam(const Eigen::VectorXf& gradient, double learning_rate, Eigen::VectorXf& parameters);
  void updateByAdaDelta(const Eigen::VectorXf& gradient, double learning_rate, Eigen::VectorXf& parameters);

  OptimiserParameters parameters_;
  Eigen::VectorXf mask_;
  State state_;
};

}  // namespace lstm_planner
