#include <gtest/gtest.h>

#include "lstm_planner/network/batch_network.hpp"
#include "lstm_planner/network/network.hpp"
#include "support/heap_count.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_network_allocations {
namespace {

TEST(NetworkAllocations, NoneInAThousandSteps) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  test::LayerMaker make(1);
  Network network({make.dense(11, 12, Activation::kRelu), make.lstm(12, 64), make.lstm(64, 8, Activation::kSigmoid),
                   make.recurrent(8, 8), make.dense(8, 8, Activation::kTanh), SoftmaxLayer{}});
  const Eigen::VectorXf input = make.input(11);
  const long before_control = heapCount().allocations;
  const Eigen::VectorXf control = input + input;
  ASSERT_EQ(heapCount().allocations - before_control, 1)
      << "the counter does not see Eigen's allocations: " << control.size();

  const Network::HiddenState saved = network.hiddenState();
  const long before = heapCount().allocations;
  for (int step = 0; step < 1000; ++step) {
    network.forward(input);
    if (step % 100 == 0) network.reset();
    if (step % 100 == 50) network.setHiddenState(saved);
  }
  EXPECT_EQ(heapCount().allocations - before, 0);
}

TEST(BatchNetworkAllocations, NoneInAThousandSteps) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  test::LayerMaker make(2);
  BatchNetwork network({make.lstm(11, 32), make.recurrent(32, 8), make.dense(8, 8), SoftmaxLayer{}}, 70);
  const BatchNetwork::Values inputs = BatchNetwork::Values::Ones(11, 70);
  const BatchNetwork::HiddenState saved = network.hiddenState(3);
  const long before = heapCount().allocations;
  for (int step = 0; step < 1000; ++step) {
    network.forward(inputs);
    if (step % 100 == 0) network.reset();
    if (step % 100 == 50) network.setHiddenState(3, saved);
  }
  EXPECT_EQ(heapCount().allocations - before, 0);
}

}  // namespace
}  // namespace lstm_planner::test_network_allocations
