#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/drive/decision/action_choice.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_action_choice {
namespace {

class ActionChoiceTest : public ::testing::Test {
 protected:
  ActionChoiceTest() : shield_(Footprint(0.17425), 0.03, 6.0) { shield_.show({}); }

  std::optional<ChosenAction> choose(std::optional<int> imposed = std::nullopt) {
    return chooseAction(parameters_, actions_, 0.0, 0.0, shield_, preferences_, imposed, &allowed_);
  }

  AgentParameters parameters_;
  const ActionSet actions_;
  Shield shield_;
  std::vector<float> preferences_{1.0f, 2.0f, 5.0f, 3.0f, 4.0f};
  std::vector<char> allowed_ = std::vector<char>(5);
};

TEST_F(ActionChoiceTest, TakesThePreferredActionThatTheShieldAllows) {
  EXPECT_EQ(choose()->index, 2);
  EXPECT_DOUBLE_EQ(choose()->free, parameters_.step.length);
  shield_.show(test::wall({0.25, -1.0}, {0.25, 1.0}));
  EXPECT_EQ(choose()->index, 4);
  EXPECT_EQ(allowed_, (std::vector<char>{1, 0, 0, 0, 1}));
}

TEST_F(ActionChoiceTest, TakesAnImposedActionOnlyIfTheShieldAllowsIt) {
  EXPECT_EQ(choose(0)->index, 0);
  shield_.show(test::wall({0.25, -1.0}, {0.25, 1.0}));
  EXPECT_EQ(choose(2)->index, 4);
}

TEST_F(ActionChoiceTest, TakesNoneWhereNothingIsFree) {
  shield_.show(test::ring(0.3));
  EXPECT_FALSE(choose());
  parameters_.shield_enabled = false;
  EXPECT_EQ(choose()->index, 2);
}

TEST_F(ActionChoiceTest, PrefersTheActionNearestToTheBearing) {
  preferBearing(actions_, 0.7, &preferences_);
  EXPECT_EQ(choose()->index, 3);
  preferBearing(actions_, 3.0, &preferences_);
  EXPECT_EQ(choose()->index, 4);
}

TEST_F(ActionChoiceTest, DrawsActionsAsOftenAsThePreferencesMean) {
  const std::vector<float> softmax{0.1f, 0.2f, 0.3f, 0.1f, 0.3f};
  constexpr int kDraws = 4000;
  std::vector<int> drawn(softmax.size());
  for (std::size_t i = 0; i < softmax.size(); ++i) preferences_[i] = std::log(softmax[i]);
  for (std::uint64_t seed = 0; seed < kDraws; ++seed) {
    ++drawn[static_cast<std::size_t>(drawAction(preferences_, seed))];
  }
  for (std::size_t i = 0; i < softmax.size(); ++i) {
    const auto share = static_cast<double>(softmax[i]);
    const double four_deviations = 4.0 * std::sqrt(share * (1.0 - share) / kDraws);
    EXPECT_NEAR(drawn[i] / static_cast<double>(kDraws), share, four_deviations) << "action " << i;
  }
}

TEST_F(ActionChoiceTest, DrawsTheSameForTheSameSeed) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(drawAction(preferences_, seed), drawAction(preferences_, seed));
  }
}

}  // namespace
}  // namespace lstm_planner::test_action_choice
