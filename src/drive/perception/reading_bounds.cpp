#include "drive/perception/reading_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lstm_planner {
namespace {

constexpr float kInfiniteReading = std::numeric_limits<float>::infinity();
constexpr double kCodeTolerance = 0.02;  // m

float toFloat(double range) { return static_cast<float>(std::min<double>(range, std::numeric_limits<float>::max())); }

void setCode(double code, ReadingBounds* bounds) {
  bounds->code_first = static_cast<float>(code - kCodeTolerance);
  bounds->code_last = static_cast<float>(code + kCodeTolerance);
  // Rounding to a float must not move a reading over a bound that is a double.
  const auto isCode = [&](float reading) { return std::abs(reading - code) <= kCodeTolerance; };
  if (!isCode(bounds->code_first)) bounds->code_first = std::nextafter(bounds->code_first, kInfiniteReading);
  if (!isCode(bounds->code_last)) bounds->code_last = std::nextafter(bounds->code_last, -kInfiniteReading);
}

float meaningOf(const ReadingBounds& bounds, float reading) {
  if (reading >= bounds.nothing_from || (reading >= bounds.code_first && reading <= bounds.code_last)) {
    return kInfiniteReading;
  }
  if ((reading >= bounds.least && reading <= bounds.most) || reading == -kInfiniteReading) return reading;
  const bool is_silent = (bounds.nan_is_silent && std::isnan(reading)) || (bounds.zero_is_silent && reading == 0.0f) ||
                         (bounds.below_is_silent && reading > 0.0f && reading < bounds.least);
  return is_silent ? RangeProfile::kSilent : 0.0f;
}

}  // namespace

ReadingBounds readingBounds(const LaserScan& scan, const ScanRules& rules) {
  ReadingBounds bounds;
  bounds.least = std::max(std::numeric_limits<float>::denorm_min(), toFloat(scan.range_min));
  bounds.most = std::min(std::numeric_limits<float>::max(), toFloat(scan.range_max));
  bounds.nothing_from = rules.beyond_is_no_return ? std::nextafter(bounds.most, kInfiniteReading) : kInfiniteReading;
  bounds.code_first = kInfiniteReading;
  bounds.code_last = -kInfiniteReading;
  bounds.nan_is_silent = rules.nan_is_no_return;
  bounds.zero_is_silent = rules.zero_is_no_return;
  bounds.below_is_silent = rules.below_is_no_return;
  if (rules.no_return_code != 0.0) setCode(rules.no_return_code, &bounds);
  return bounds;
}

void interpret(const ReadingBounds& bounds, const float* readings, std::size_t count, float* ranges) {
  std::transform(readings, readings + count, ranges, [&](float reading) { return meaningOf(bounds, reading); });
}

}  // namespace lstm_planner
