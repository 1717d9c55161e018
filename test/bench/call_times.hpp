#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>
#include <vector>

namespace lstm_planner {

/// The least time that a piece of work took, us. Done again and again in the same way, it is hardly disturbed by other
/// programs each time.
class LeastTime {
 public:
  template <typename Work>
  void measure(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    add(std::chrono::steady_clock::now() - begin);
  }
  void add(std::chrono::steady_clock::duration duration) {
    least_ = std::min(least_, std::chrono::duration<double, std::micro>(duration).count());
  }
  double microseconds() const { return least_; }

 private:
  double least_ = std::numeric_limits<double>::infinity();
};

/// The value that such a share of the others lies below; NaN when there are none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// NaN when there are none.
inline double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace lstm_planner
