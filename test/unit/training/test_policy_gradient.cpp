#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lstm_planner/training/policy_gradient.hpp"

namespace lstm_planner::test_policy_gradient {
namespace {

constexpr int kActions = 4;
constexpr int kForbidden = 2;

bool possible(int action) { return action != kForbidden; }

/// Probabilities of the actions by softmax.
std::array<double, kActions> probabilitiesOf(const std::array<float, kActions>& preferences) {
  std::array<double, kActions> chances{};
  const double total = fillChances(
      kActions, possible, [&](int action) { return preferences[static_cast<std::size_t>(action)]; }, chances.data());
  for (double& chance : chances) chance /= total;
  return chances;
}

constexpr std::array<float, kActions> kPreferences = {0.5f, -1.0f, 9.0f, 1.25f};

TEST(PolicyGradient, ChancesAreInTheRatioOfTheExponentialsAndNoneIsLeftForAForbiddenAction) {
  const std::array<double, kActions> probabilities = probabilitiesOf(kPreferences);
  EXPECT_EQ(probabilities[kForbidden], 0.0);
  EXPECT_NEAR(probabilities[0] / probabilities[1], std::exp(1.5), 1e-12);
  EXPECT_NEAR(probabilities[3] / probabilities[0], std::exp(0.75), 1e-12);
}

TEST(PolicyGradient, WhereNoActionIsPossibleTheChancesAreZero) {
  std::array<float, kActions> chances{};
  const auto none = [](int) { return false; };
  EXPECT_EQ(fillChances(
                kActions, none, [](int) { return 1.0f; }, chances.data()),
            0.0f);
}

TEST(PolicyGradient, ActionsAreDrawnAsOftenAsTheirChancesSay) {
  Random random(1);
  std::array<int, kActions> drawn{};
  constexpr int kDraws = 20000;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::array<float, kActions> chances = {1.0f, 3.0f, 0.0f, 4.0f};
    ++drawn[static_cast<std::size_t>(drawByChances(kActions, 8.0f, &random, chances.data()))];
    EXPECT_FLOAT_EQ(chances[3], 0.5f);
  }
  EXPECT_EQ(drawn[kForbidden], 0);
  // Three standard deviations of a share of so many draws are 0.011 at most.
  EXPECT_NEAR(drawn[0] / double(kDraws), 0.125, 0.011);
  EXPECT_NEAR(drawn[1] / double(kDraws), 0.375, 0.011);
}

TEST(PolicyGradient, SlopesAreTheDerivativesOfGainAndEntropy) {
  constexpr double kGain = 0.7;
  constexpr double kEntropyWeight = 0.3;
  constexpr int kDone = 3;
  const auto error = [&](const std::array<float, kActions>& preferences) {
    const std::array<double, kActions> probabilities = probabilitiesOf(preferences);
    return -kGain * std::log(probabilities[kDone]) - kEntropyWeight * entropyOf(kActions, probabilities.data());
  };
  const std::array<double, kActions> probabilities = probabilitiesOf(kPreferences);
  const double entropy = entropyOf(kActions, probabilities.data());
  for (std::size_t action = 0; action < kActions; ++action) {
    if (action == kForbidden) continue;
    constexpr float kStep = 1.0f / 64;
    std::array<float, kActions> more = kPreferences;
    std::array<float, kActions> less = kPreferences;
    more[action] += kStep;
    less[action] -= kStep;
    const double expected = (error(more) - error(less)) / (2.0 * static_cast<double>(kStep));
    EXPECT_NEAR(policySlope(probabilities[action], action == kDone, kGain, kEntropyWeight, entropy), expected, 1e-4)
        << action;
  }
}

}  // namespace
}  // namespace lstm_planner::test_policy_gradient
