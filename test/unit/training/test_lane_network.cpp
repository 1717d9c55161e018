#include <gtest/gtest.h>

#include <limits>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/network/network.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/lane_network.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/sequence.hpp"
#include "unit/training/gradient_fixtures.hpp"

namespace lstm_planner::test_lane_network {
namespace {

constexpr int kLanes = 16;
constexpr int kInputs = 5;
constexpr int kSteps = 7;

/// Every kind of layer behind every other.
LayerStack mixedStack() {
  LayerStack layers = makeDenseStack(kInputs, {6}, 4);
  layers.pop_back();
  const LayerStack lstm = makeLstmStack(6, {5, 3}, 4);
  layers.insert(layers.end(), lstm.begin(), lstm.end() - 1);
  layers.push_back(RecurrentLayer{Eigen::MatrixXf::Zero(6, 3), Eigen::MatrixXf::Zero(6, 6), Eigen::VectorXf::Zero(6)});
  layers.push_back(DenseLayer{Eigen::MatrixXf::Zero(4, 6), Eigen::VectorXf::Zero(4), Activation::kIdentity});
  return initialised(layers, 3);
}

std::vector<Sequence> randomSequences(std::uint64_t seed) {
  Random random(seed);
  std::vector<Sequence> sequences(kLanes);
  for (Sequence& sequence : sequences) {
    sequence.inputs.resize(kInputs, kSteps);
    for (int i = 0; i < kInputs * kSteps; ++i) sequence.inputs.data()[i] = static_cast<float>(normal(random));
    sequence.labels = Eigen::VectorXi::Constant(kSteps, static_cast<int>(uniformIndex(random, 4)));
    sequence.weights = Eigen::VectorXf::Ones(kSteps);
  }
  return sequences;
}

void fillInputs(const std::vector<Sequence>& sequences, int step, LaneNetwork& network) {
  for (int lane = 0; lane < kLanes; ++lane) {
    for (int row = 0; row < kInputs; ++row) {
      network.inputs(step)[row * kLanes + lane] = sequences[static_cast<std::size_t>(lane)].inputs(row, step);
    }
  }
}

TEST(LaneNetwork, GivesWhatTheNetworkGivesOneByOneAcrossWindowsAndForgetting) {
  const LayerStack layers = mixedStack();
  const Eigen::VectorXf parameters = parameterVector(layers);
  LaneNetwork lanes(layers, kLanes, kSteps);
  std::vector<Network> networks(kLanes, Network(layers));
  constexpr int kWindows = 3;
  // Two implementations of tanh and exp: each layer may round by two units of the last place, which the recurrent ones
  // carry on to the last step. Compilers add them up in different orders.
  const float rounding =
      2.0f * std::numeric_limits<float>::epsilon() * static_cast<float>(layers.size()) * kWindows * kSteps;
  for (int window = 0; window < kWindows; ++window) {
    const auto sequences = randomSequences(static_cast<std::uint64_t>(window) + 1);
    for (int step = 0; step < kSteps; ++step) {
      if (window == 1 && step == 4) {
        lanes.forget(step, 2);
        networks[2].reset();
      }
      fillInputs(sequences, step, lanes);
      const float* outputs = lanes.forward(parameters, step);
      for (int lane = 0; lane < kLanes; ++lane) {
        const auto& expected = networks[static_cast<std::size_t>(lane)].forward(
            sequences[static_cast<std::size_t>(lane)].inputs.col(step));
        for (int row = 0; row < 4; ++row) EXPECT_NEAR(outputs[row * kLanes + lane], expected[row], rounding);
      }
    }
    lanes.carryOver(kSteps);
  }
}

TEST(LaneNetwork, GradientsAreThoseOfTheEquationsInDoublePrecision) {
  const LayerStack layers = mixedStack();
  const Eigen::VectorXf parameters = parameterVector(layers);
  const auto sequences = randomSequences(9);
  const Eigen::MatrixXd factors = Eigen::MatrixXd::Random(4, kSteps);
  LaneNetwork lanes(layers, kLanes, kSteps);
  for (int step = 0; step < kSteps; ++step) {
    fillInputs(sequences, step, lanes);
    lanes.forward(parameters, step);
    for (int lane = 0; lane < kLanes; ++lane) {
      for (int row = 0; row < 4; ++row) {
        lanes.outputGradient(step)[row * kLanes + lane] = static_cast<float>(factors(row, step));
      }
    }
  }
  Eigen::VectorXf gradient = Eigen::VectorXf::Zero(parameters.size());
  lanes.backward(parameters, kSteps, gradient);

  const auto errorOf = [&](const Eigen::VectorXd& place, const Eigen::MatrixXd& inputs) {
    test::ReferenceNetwork network(layers, place);
    double sum = 0.0;
    for (int step = 0; step < kSteps; ++step) sum += factors.col(step).dot(network.forward(inputs.col(step)));
    return sum;
  };
  const Eigen::VectorXd expected = centralDifferences(parameters.cast<double>(), [&](const Eigen::VectorXd& place) {
    double sum = 0.0;
    for (const Sequence& sequence : sequences) sum += errorOf(place, sequence.inputs.cast<double>());
    return sum;
  });
  EXPECT_LT((gradient.cast<double>() - expected).norm(), 1e-5 * expected.norm());
}

TEST(LaneNetwork, ErrorsDoNotPassTheBeginningOfAnEpisode) {
  const LayerStack layers = mixedStack();
  const Eigen::VectorXf parameters = parameterVector(layers);
  const auto gradientWithFirstInput = [&](float value) {
    LaneNetwork lanes(layers, kLanes, 2);
    std::fill_n(lanes.inputs(0), kInputs * kLanes, value);
    std::fill_n(lanes.inputs(1), kInputs * kLanes, 0.5f);
    std::fill_n(lanes.outputGradient(1), 4 * kLanes, 1.0f);
    lanes.forward(parameters, 0);
    for (int lane = 0; lane < kLanes; ++lane) lanes.forget(1, lane);
    lanes.forward(parameters, 1);
    Eigen::VectorXf gradient = Eigen::VectorXf::Zero(parameters.size());
    lanes.backward(parameters, 2, gradient);
    return gradient;
  };
  EXPECT_GT(gradientWithFirstInput(1.0f).norm(), 0.1f);
  EXPECT_EQ(gradientWithFirstInput(1.0f), gradientWithFirstInput(-2.0f));
}

}  // namespace
}  // namespace lstm_planner::test_lane_network
