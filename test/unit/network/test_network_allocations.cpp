#include <gtest/gtest.h>

#include <functional>

#include "lstm_planner/network/network.hpp"
#include "support/heap_count.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_network_allocations {
namespace {

TEST(NetworkAllocations, NoneInAThousandSteps) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  test::LayerMaker make(1);
  Network network({make.dense(11, 12, Activation::kRelu), make.lstm(12, 64), make.lstm(64, 8, Activation::kSigmoid),
                   make.recurrent(8, 8), make.dense(8, 8, Activation::kTanh), SoftmaxLayer{}},
                  fastestInstructionSet(), 3);
  const Eigen::VectorXf input = make.input(11);
  const long before_control = heapCount().allocations;
  const Eigen::VectorXf control = input + input;
  ASSERT_EQ(heapCount().allocations - before_control, 1)
      << "the counter does not see Eigen's allocations: " << control.size();

  const long before = heapCount().allocations;
  for (int step = 0; step < 1000; ++step) {
    network.forward(input, step % network.sequences());
    if (step % 100 == 0) network.reset();
  }
  EXPECT_EQ(heapCount().allocations - before, 0);
}

long heldBy(const std::function<Network()>& make) {
  const long before = heapCount().live_bytes;
  const Network network = make();
  return heapCount().live_bytes - before;
}

TEST(NetworkAllocations, CopiesAndSequencesShareTheWeights) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  test::LayerMaker make(2);
  const LayerStack layers = {make.dense(85, 32), make.lstm(32, 16), make.dense(16, 1)};
  const Network original(layers);
  const long weights = static_cast<long>(original.weights() * sizeof(float));
  const long one = heldBy([&] { return Network(layers); });
  const long eight = heldBy([&] { return Network(layers, fastestInstructionSet(), 8); });
  EXPECT_GT(one, weights);
  EXPECT_LT(heldBy([&] { return original; }), weights / 10);
  EXPECT_LT(eight - one, weights / 3);
}

}  // namespace
}  // namespace lstm_planner::test_network_allocations
