#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/optimiser.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_optimiser {
namespace {

Eigen::VectorXf vector(std::initializer_list<float> values) {
  Eigen::VectorXf result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

/// At the start of a training the rate is that of the parameters.
constexpr double kStart = 0.0;

OptimiserParameters momentumParameters(double learning_rate) {
  OptimiserParameters parameters;
  parameters.learning_rate = learning_rate;
  parameters.kind = OptimiserKind::kMomentum;
  parameters.momentum = 0.5;
  parameters.max_gradient_norm = 0.0;
  return parameters;
}

TEST(Optimiser, MomentumFollowsTheThesis) {
  Optimiser optimiser(momentumParameters(0.25), vector({1, 1}));
  Eigen::VectorXf weights = vector({1, -2});
  optimiser.update(vector({2, 4}), kStart, weights);
  EXPECT_EQ(weights, vector({0.5f, -3.0f}));  // v = -0.25 * g = (-0.5, -1)
  optimiser.update(vector({2, 0}), kStart, weights);
  EXPECT_EQ(weights, vector({-0.25f, -3.5f}));  // v = 0.5 v - 0.25 g = (-0.75, -0.5)
}

TEST(Optimiser, AdamFollowsTheHandCalculation) {
  OptimiserParameters parameters;
  parameters.learning_rate = 0.1;
  parameters.max_gradient_norm = 0.0;
  Optimiser optimiser(parameters, vector({1, 1}));
  Eigen::VectorXf weights = vector({1, 1});
  optimiser.update(vector({0.5f, -8.0f}), kStart, weights);
  // The first step is alpha * g / (|g| + epsilon), whatever the size of the gradient.
  EXPECT_NEAR(weights[0], 0.9, 1e-6);
  EXPECT_NEAR(weights[1], 1.1, 1e-6);
  optimiser.update(vector({-0.5f, -8.0f}), kStart, weights);
  // Means 0.9 * 0.05 - 0.05 = -0.005 and 0.999 * 0.00025 + 0.00025, corrected by 1 - 0.9^2 and 1 - 0.999^2:
  // -0.0263158 / 0.5.
  EXPECT_NEAR(weights[0], 0.9 + 0.1 * 0.0263158 / 0.5, 1e-6);
  EXPECT_NEAR(weights[1], 1.2, 1e-6);
}

TEST(Optimiser, AdaDeltaFollowsTheHandCalculation) {
  OptimiserParameters parameters;
  parameters.kind = OptimiserKind::kAdaDelta;
  parameters.learning_rate = 500.0;
  parameters.momentum = 0.75;
  parameters.max_gradient_norm = 0.0;
  Optimiser optimiser(parameters, vector({1}));
  Eigen::VectorXf weights = vector({1});
  optimiser.update(vector({2}), kStart, weights);
  // Squared gradients 0.25 * 4 = 1; update 2 sqrt(1e-6 / 1) = 0.002; squared updates 0.25 * 4e-6 = 1e-6.
  EXPECT_NEAR(weights[0], 1.0 - 500.0 * 0.002, 1e-5);
  optimiser.update(vector({-2}), kStart, weights);
  // Squared gradients 0.75 + 1 = 1.75; update -2 sqrt((1e-6 + 1e-6) / 1.75).
  EXPECT_NEAR(weights[0], 500.0 * 2.0 * std::sqrt(2e-6 / 1.75), 1e-5);
}

TEST(Optimiser, DecayPullsWeightsTowardsZeroAndLeavesBiasesAlone) {
  OptimiserParameters parameters = momentumParameters(0.5);
  parameters.l1_decay = 0.5;
  Optimiser optimiser(parameters, vector({1, 1, 1, 0}));
  Eigen::VectorXf weights = vector({3, -4, 0, 7});
  optimiser.update(vector({0, 0, 0, 0}), kStart, weights);
  EXPECT_EQ(weights, vector({2.75f, -3.75f, 0, 7}));  // the derivative of 0.5 sum |w| (Eq. 3.8), times the rate
}

TEST(Optimiser, LongGradientsAreShortenedAndShortOnesKept) {
  Eigen::VectorXf gradient = vector({3, 4});
  EXPECT_DOUBLE_EQ(clipToNorm(1.0, gradient), 5.0);
  EXPECT_TRUE(gradient.isApprox(vector({0.6f, 0.8f}), 1e-6f));
  gradient = vector({3, 4});
  clipToNorm(6.0, gradient);
  EXPECT_EQ(gradient, vector({3, 4}));
  clipToNorm(0.0, gradient);
  EXPECT_EQ(gradient, vector({3, 4}));
}

TEST(Optimiser, CosineScheduleFallsFromTheLearningRateToZero) {
  OptimiserParameters parameters;
  parameters.learning_rate = 0.2;
  const Optimiser optimiser(parameters, {});
  EXPECT_DOUBLE_EQ(optimiser.rate(0.0), 0.2);
  EXPECT_NEAR(optimiser.rate(0.5), 0.1, 1e-12);
  EXPECT_NEAR(optimiser.rate(1.0), 0.0, 1e-12);
  parameters.schedule = LearningRateSchedule::kConstant;
  EXPECT_DOUBLE_EQ(Optimiser(parameters, {}).rate(0.99), 0.2);
}

TEST(Optimiser, RefusesParametersOutOfRange) {
  const auto refused = [](auto change, const std::string& reason) {
    OptimiserParameters parameters;
    change(parameters);
    EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { validate(parameters); }), "parameter " + reason);
  };
  EXPECT_NO_THROW(validate(OptimiserParameters{}));
  refused([](OptimiserParameters& p) { p.learning_rate = 0.0; }, "learning_rate is 0, expected a positive number");
  refused([](OptimiserParameters& p) { p.learning_rate = std::numeric_limits<double>::quiet_NaN(); },
          "learning_rate is nan, expected a positive number");
  refused([](OptimiserParameters& p) { p.momentum = 1.0; }, "momentum is 1, expected a number in [0, 1)");
  refused([](OptimiserParameters& p) { p.l1_decay = -1.0; }, "l1_decay is -1, expected a number that is not negative");
  refused([](OptimiserParameters& p) { p.max_gradient_norm = -1.0; },
          "max_gradient_norm is -1, expected a number that is not negative");
}

}  // namespace
}  // namespace lstm_planner::test_optimiser
