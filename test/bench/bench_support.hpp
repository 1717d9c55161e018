#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/initialisation.hpp"

namespace lstm_planner {

/// Untrained: what a step costs does not depend on the weights.
inline LayerStack benchLstm(int inputs, const std::vector<int>& cells, int outputs) {
  return initialised(makeLstmStack(inputs, cells, outputs), 1);
}

/// One map of each kind that the thesis judges by, of the benchmark's size.
inline std::vector<PassableGrid> benchMaps() {
  std::vector<PassableGrid> maps;
  maps.push_back(generateMaze({}, 1));
  maps.push_back(generateRandomFill({}, 1));
  maps.push_back(generateCaves({}, 1));
  return maps;
}

/// Every combination of two arguments; Google Benchmark can do it by itself only from version 1.5.2 on.
inline void addArgumentPairs(const std::vector<int>& first, const std::vector<int>& second,
                             benchmark::internal::Benchmark* family) {
  for (const int a : first) {
    for (const int b : second) family->Args({a, b});
  }
}

/// Two counters of what was done from construction to report(): processor time a unit, which other programs on the
/// machine hardly change, and units a second by the clock on the wall, which needs a quiet machine.
class WorkMeter {
 public:
  WorkMeter() : begin_(std::chrono::steady_clock::now()), processor_begin_(std::clock()) {}

  void report(const std::string& unit, double amount, benchmark::State* state) const {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin_;
    const double processor_seconds = static_cast<double>(std::clock() - processor_begin_) / CLOCKS_PER_SEC;
    state->counters["cpu_ns_per_" + unit] = 1e9 * processor_seconds / amount;
    state->counters[unit + "s_per_s"] = amount / seconds.count();
  }

 private:
  std::chrono::steady_clock::time_point begin_;
  std::clock_t processor_begin_;
};

}  // namespace lstm_planner
