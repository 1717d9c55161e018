#include "lstm_planner/drive/motion/reaction_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lstm_planner {

namespace {

constexpr double kWindow = 8.0;       // s
constexpr double kJudgedEvery = 2.0;  // s
constexpr double kLongest = 1.5;      // s
constexpr double kLeastTurn = 0.1;    // rad/s, root mean square: the noise of an odometry's turning speed is less
constexpr double kAgree = 0.9;        // correlation
constexpr double kDiffer = 0.85;      // correlation
constexpr double kClearly = 0.1;      // s
constexpr double kSamePeriod = 0.2;   // share by which a period may differ

}  // namespace

void ReactionWatch::note(double measured, double commanded, double period, double expected) {
  // A measured period is never twice the same.
  if (std::abs(period - period_) > kSamePeriod * period_) {
    samples_.clear();
    period_ = period;
  }
  samples_.push_back({measured, commanded});
  if (static_cast<double>(samples_.size()) * period <= kWindow) return;
  samples_.pop_front();
  if (static_cast<double>(++unjudged_) * period < kJudgedEvery) return;
  unjudged_ = 0;
  judge(expected);
}

/// Between what is measured and what was commanded `lag` periods earlier; 0 where the robot hardly turned.
double ReactionWatch::correlation(std::size_t lag) const {
  double measured = 0.0;
  double commanded = 0.0;
  double both = 0.0;
  for (std::size_t i = lag; i < samples_.size(); ++i) {
    const double turn = samples_[i].measured;
    const double told = samples_[i - lag].commanded;
    measured += turn * turn;
    commanded += told * told;
    both += turn * told;
  }
  const double least = kLeastTurn * kLeastTurn * static_cast<double>(samples_.size() - lag);
  return measured < least || commanded < least ? 0.0 : both / std::sqrt(measured * commanded);
}

void ReactionWatch::judge(double expected) {
  const auto lagOf = [&](double time) {
    return std::min(static_cast<std::size_t>(std::lround(time / period_)), samples_.size() - 1);
  };
  std::size_t best = 0;
  double most = 0.0;
  for (std::size_t lag = 0; lag <= lagOf(kLongest); ++lag) {
    const double agreement = correlation(lag);
    if (agreement <= most) continue;
    most = agreement;
    best = lag;
  }
  const double known = std::max(expected, delay_);
  const double shown = static_cast<double>(best) * period_;
  const bool is_found = shown >= known + kClearly && most >= kAgree && correlation(lagOf(known)) <= kDiffer;
  const double before = std::exchange(found_, is_found ? shown : 0.0);
  delay_ = std::max(delay_, std::min(before, found_));  // chance does not find it twice
}

}  // namespace lstm_planner
