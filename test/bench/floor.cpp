#include "floor.hpp"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "floor_kernels.hpp"

namespace lstm_planner {
namespace {

constexpr int kRounds = 5;
constexpr int kRepetitions = 800;  ///< of a measurement in each round
constexpr long kChainLength = 6000;
constexpr long kMultiplyAdds = 96000;
constexpr long kBytesARepetition = 1 << 20;
constexpr long kReadBlock = 512;  ///< bytes; what FloorKernels::read_buffer reads at a time, or a multiple of it
constexpr long kL1Buffer = 32 << 10;
constexpr long kL2Buffer = 512 << 10;
/// Where the system does not say: more than any core has, as a floor must not be too high.
constexpr double kUnknownL1Bytes = 192 << 10;

constexpr int kActivationMultiplications = 2;
constexpr int kActivationMultiplyAdds = 2;

const FloorKernels& kernels(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx512) return kFloorAvx512;
  if (set == InstructionSet::kAvx2) return kFloorAvx2;
#endif
  static_cast<void>(set);
  return kFloorBaseline;
}

template <typename Function>
double shortestTime(const Function& function) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRepetitions; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(function());
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    shortest = std::min(shortest, time.count());
  }
  return shortest;
}

/// Bytes a ns at the better of two ways to read.
double readSpeed(const FloorKernels& kernel, long bytes) {
  constexpr std::size_t kLine = 64;
  std::vector<float> memory((static_cast<std::size_t>(bytes) + 4096) / sizeof(float), 1.0f);
  const auto address = reinterpret_cast<std::uintptr_t>(memory.data());
  const float* const buffer = memory.data() + (kLine - address % kLine) % kLine / sizeof(float);
  const long passes = std::max(kBytesARepetition / bytes, 1L);
  const double time = std::min(shortestTime([&] { return kernel.read_buffer(buffer, bytes, passes); }),
                               shortestTime([&] { return kernel.read_buffer_ahead(buffer, bytes, passes); }));
  return static_cast<double>(bytes * passes) / time;
}

double l1Bytes() {
#if defined(_SC_LEVEL1_DCACHE_SIZE)
  const long bytes = sysconf(_SC_LEVEL1_DCACHE_SIZE);
  if (bytes > 0) return static_cast<double>(bytes);
#endif
  return kUnknownL1Bytes;
}

CoreSpeed measureOnce(InstructionSet set) {
  const FloorKernels& kernel = kernels(set);
  const auto latency = [](float (*chain)(long, float)) {
    return shortestTime([&] { return chain(kChainLength, 1.0f); }) / static_cast<double>(kChainLength);
  };
  CoreSpeed speed;
  speed.multiply_add_ns = latency(kernel.multiply_add_chain);
  speed.multiplication_ns = latency(kernel.multiplication_chain);
  speed.addition_ns = latency(kernel.addition_chain);
  speed.division_ns = latency(kernel.division_chain);
  speed.broadcast_ns = latency(kernel.broadcast_chain);
  const double multiply_adds_ns = shortestTime([&] { return kernel.multiply_adds(kMultiplyAdds, 1.0f); });
  speed.multiply_adds_per_ns = static_cast<double>(kMultiplyAdds * kernel.lanes) / multiply_adds_ns;
  speed.l1_bytes_per_ns = readSpeed(kernel, kL1Buffer);
  speed.l2_bytes_per_ns = readSpeed(kernel, kL2Buffer);
  speed.l1_bytes = l1Bytes();
  speed.register_bytes = static_cast<double>(kernel.lanes * kernel.registers) * sizeof(float);
  return speed;
}

CoreSpeed betterOf(CoreSpeed a, const CoreSpeed& b) {
  a.multiply_add_ns = std::min(a.multiply_add_ns, b.multiply_add_ns);
  a.multiplication_ns = std::min(a.multiplication_ns, b.multiplication_ns);
  a.addition_ns = std::min(a.addition_ns, b.addition_ns);
  a.division_ns = std::min(a.division_ns, b.division_ns);
  a.broadcast_ns = std::min(a.broadcast_ns, b.broadcast_ns);
  a.multiply_adds_per_ns = std::max(a.multiply_adds_per_ns, b.multiply_adds_per_ns);
  a.l1_bytes_per_ns = std::max(a.l1_bytes_per_ns, b.l1_bytes_per_ns);
  a.l2_bytes_per_ns = std::max(a.l2_bytes_per_ns, b.l2_bytes_per_ns);
  a.register_bytes = std::max(a.register_bytes, b.register_bytes);
  return a;
}

/// Several rounds, as the load of another program may last as long as one.
CoreSpeed measure(InstructionSet set) {
  CoreSpeed best = measureOnce(set);
  for (int round = 1; round < kRounds; ++round) best = betterOf(best, measureOnce(set));
  return best;
}

/// What code may choose that can run `set`.
CoreSpeed bestSpeed(InstructionSet set) {
  CoreSpeed best = measuredSpeed(InstructionSet::kBaseline);
  for (const InstructionSet other : runnableInstructionSets()) {
    if (other <= set) best = betterOf(best, measuredSpeed(other));
  }
  return best;
}

/// The shortest chain through a layer that waits for so many inputs.
class LayerChain {
 public:
  LayerChain(const CoreSpeed& speed, double waiting)
      : speed_(speed),
        waiting_(waiting),
        activation_(kActivationMultiplications * speed.multiplication_ns +
                    kActivationMultiplyAdds * speed.multiply_add_ns + speed.division_ns) {}

  double operator()(const LstmLayer& layer) const {
    const double cell_state = activation_ + speed_.multiplication_ns + speed_.addition_ns;
    return product(layer.input.rows()) + cell_state + activation_;
  }
  double operator()(const RecurrentLayer& layer) const { return product(layer.input.rows()) + activation_; }
  double operator()(const DenseLayer& layer) const {
    const bool curved = layer.activation == Activation::kTanh || layer.activation == Activation::kSigmoid;
    return product(layer.weights.rows()) + (curved ? activation_ : 0.0);
  }
  double operator()(const SoftmaxLayer&) const {
    return activation_ + std::ceil(std::log2(waiting_)) * speed_.addition_ns;
  }

 private:
  double product(Eigen::Index units) const {
    const double tree = speed_.multiply_add_ns + std::ceil(std::log2(waiting_)) * speed_.addition_ns;
    return speed_.broadcast_ns + std::max(tree, waiting_ * static_cast<double>(units) / speed_.multiply_adds_per_ns);
  }

  const CoreSpeed& speed_;
  double waiting_;
  double activation_;
};

struct ProductSize {
  template <typename Recurrent>
  double operator()(const Recurrent& layer) const {
    return static_cast<double>(layer.input.size() + layer.recurrent.size());
  }
  double operator()(const DenseLayer& layer) const { return static_cast<double>(layer.weights.size()); }
  double operator()(const SoftmaxLayer&) const { return 0.0; }
};

struct OutputSize {
  double inputs;
  double operator()(const LstmLayer& layer) const { return static_cast<double>(layer.recurrent.cols()); }
  double operator()(const RecurrentLayer& layer) const { return static_cast<double>(layer.recurrent.cols()); }
  double operator()(const DenseLayer& layer) const { return static_cast<double>(layer.weights.rows()); }
  double operator()(const SoftmaxLayer&) const { return inputs; }
};

}  // namespace

const CoreSpeed& measuredSpeed(InstructionSet set) {
  static std::map<InstructionSet, CoreSpeed> speeds;
  const auto found = speeds.find(set);
  if (found != speeds.end()) return found->second;
  return speeds.emplace(set, measure(set)).first->second;
}

double StepFloor::ns() const { return std::max({chain, multiply, read}); }

double multiplyAddsOfStep(const LayerStack& layers) {
  double sum = 0.0;
  for (const Layer& layer : layers) sum += std::visit(ProductSize{}, layer);
  return sum;
}

StepFloor stepFloorParts(const LayerStack& layers, InstructionSet set) {
  const CoreSpeed speed = bestSpeed(set);
  StepFloor floor;
  double waiting = static_cast<double>(inputSize(layers));
  for (const Layer& layer : layers) {
    floor.chain += std::visit(LayerChain(speed, waiting), layer);
    waiting = std::visit(OutputSize{waiting}, layer);
  }
  floor.multiply = multiplyAddsOfStep(layers) / speed.multiply_adds_per_ns;
  const double bytes = static_cast<double>(countWeights(layers)) * sizeof(float) - speed.register_bytes;
  floor.read = std::max(bytes / speed.l1_bytes_per_ns, (bytes - speed.l1_bytes) / speed.l2_bytes_per_ns);
  return floor;
}

double readInOrder(const LayerStack& layers, InstructionSet set) {
  const long weights = static_cast<long>(countWeights(layers) * sizeof(float));
  const long blocks = (weights + kReadBlock - 1) / kReadBlock;
  return static_cast<double>(weights) / readSpeed(kernels(set), blocks * kReadBlock);
}

double stepFloor(const LayerStack& layers, InstructionSet set) { return stepFloorParts(layers, set).ns(); }

}  // namespace lstm_planner
