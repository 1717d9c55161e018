#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

#include "lstm_planner/network/batch_network.hpp"
#include "lstm_planner/network/network.hpp"
#include "unit/network/network_fixtures.hpp"

// Eigen takes its memory from malloc rather than operator new, so malloc is what must be counted. A sanitizer brings
// its own malloc, which must not be replaced.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LSTM_PLANNER_COUNTS_ALLOCATIONS

namespace {
std::atomic<long> allocations{0};
}

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
}
#endif

namespace lstm_planner {
namespace {

TEST(NetworkAllocations, NoneInAThousandSteps) {
#ifdef LSTM_PLANNER_COUNTS_ALLOCATIONS
  test::LayerMaker make(1);
  Network network({make.dense(11, 12, Activation::kRelu), make.lstm(12, 64), make.lstm(64, 8, Activation::kSigmoid),
                   make.recurrent(8, 8), make.dense(8, 8, Activation::kTanh), SoftmaxLayer{}});
  const Eigen::VectorXf input = make.input(11);
  const long before_control = allocations;
  const Eigen::VectorXf control = input + input;
  ASSERT_EQ(allocations - before_control, 1) << "the counter does not see Eigen's allocations: " << control.size();

  const Network::HiddenState saved = network.hiddenState();
  const long before = allocations;
  for (int step = 0; step < 1000; ++step) {
    network.forward(input);
    if (step % 100 == 0) network.reset();
    if (step % 100 == 50) network.setHiddenState(saved);
  }
  EXPECT_EQ(allocations - before, 0);
#else
  GTEST_SKIP() << "allocations are counted with glibc and without sanitizers only";
#endif
}

TEST(BatchNetworkAllocations, NoneInAThousandSteps) {
#ifdef LSTM_PLANNER_COUNTS_ALLOCATIONS
  test::LayerMaker make(2);
  BatchNetwork network({make.lstm(11, 32), make.recurrent(32, 8), make.dense(8, 8), SoftmaxLayer{}}, 70);
  const BatchNetwork::Values inputs = BatchNetwork::Values::Ones(11, 70);
  const BatchNetwork::HiddenState saved = network.hiddenState(3);
  const long before = allocations;
  for (int step = 0; step < 1000; ++step) {
    network.forward(inputs);
    if (step % 100 == 0) network.forget(69);
    if (step % 100 == 50) network.setHiddenState(3, saved);
  }
  EXPECT_EQ(allocations - before, 0);
#else
  GTEST_SKIP() << "allocations are counted with glibc and without sanitizers only";
#endif
}

}  // namespace
}  // namespace lstm_planner
