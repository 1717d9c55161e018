#include "lstm_planner/drive/perception/period_meter.hpp"

#include <algorithm>

namespace lstm_planner {

namespace {

constexpr double kPause = 1.0;            // s
constexpr double kPeriods = 3.0;          // that a message may be late
constexpr double kLongestMeasured = 1.0;  // s

}  // namespace

void PeriodMeter::note(double stamp) {
  const double interval = stamp - stamp_;
  const bool counts = has_stamp_ && interval > 0.0 && interval <= kPause;
  stamp_ = stamp;
  has_stamp_ = true;
  if (!counts) return;
  intervals_[count_++ % kMost] = interval;
  const std::size_t known = std::min(count_, kMost);
  if (known < kFewest) return;
  std::array<double, kMost> sorted = intervals_;
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(known);
  const auto quartile = sorted.begin() + static_cast<std::ptrdiff_t>(known / 4);
  std::nth_element(sorted.begin(), quartile, end);
  period_ = *quartile;
}

double timeoutFor(double set, double period, double least) {
  return set > 0.0 ? set : std::clamp(kPeriods * period, least, std::max(least, kLongestMeasured));
}

}  // namespace lstm_planner
