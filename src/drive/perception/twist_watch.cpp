#include "lstm_planner/drive/perception/twist_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lstm_planner {
namespace {

constexpr double kWatched = 4.0;        // s
constexpr double kBetween = 0.01;       // s, at least, from one sample to the next
constexpr double kLongestPause = 1.5;   // s; what the robot did in a longer one is not known
constexpr double kCheckPeriod = 0.1;    // s
constexpr std::size_t kQuarters = 4;    // of a span
constexpr double kDelay = 0.2;          // s, of a filtered twist
constexpr double kWrong = 0.3;          // share of a way by which the twist may differ
constexpr double kNoises = 8.0;         // by which both ends of a way may be wrong together
constexpr double kEvenNoises = 5.0;     // by which a pose may be beside an even drive
constexpr double kLeastNoise = 1e-4;    // m or rad
constexpr double kLongestEven = 1.0;    // s
constexpr double kShortestEven = 0.1;   // s
constexpr double kBesideAtOnce = 0.05;  // m or rad beside an even drive that no robot gets to at once,
constexpr double kSwerve = 5.0;         // and m/s^2 or rad/s^2 that it may be beside

/// What counts as standing: odometry may creep, and a twist be rounded. A Create 2 counts ticks over 15 ms, and one
/// tick of a wheel is 0.126 rad/s there.
constexpr double kStillWay = 0.01;   // m
constexpr double kCreep = 0.008;     // m/s
constexpr double kStillTurn = 0.03;  // rad
constexpr double kCreepTurn = 0.15;  // rad/s

}  // namespace

void TwistWatch::note(double stamp, const Pose2& pose, const Twist2& twist) {
  said_ = twist;
  const double elapsed = samples_.empty() ? 0.0 : stamp - samples_.back().stamp;
  if (elapsed < 0.0 || elapsed > kLongestPause) restart();
  if (samples_.empty()) {
    samples_.push_back({stamp, pose, twist, {}, {}, {}});
    return;
  }
  const Sample& last = samples_.back();
  Sample next{stamp, pose, twist, last.shown, last.said, {}};
  const Way way = shownWay(last, next);
  next.shown = {last.shown.forward + way.forward, last.shown.turned + way.turned};
  next.said.forward += 0.5 * elapsed * (last.twist.linear + twist.linear);
  next.said.turned += 0.5 * elapsed * (last.twist.angular + twist.angular);
  if (elapsed == 0.0) next.revised = {std::abs(way.forward), std::abs(way.turned)};
  keep(next);
  judge();
}

/// What the poses show; what they would show without it, where they have jumped: once, or it was no jump.
TwistWatch::Way TwistWatch::shownWay(const Sample& from, const Sample& to) {
  const double elapsed = to.stamp - from.stamp;
  const double turned = normalizeAngle(to.pose.yaw - from.pose.yaw);
  const Pose2 halfway{from.pose.x, from.pose.y, from.pose.yaw + 0.5 * turned};
  const Way way{toLocalFrame(halfway, {to.pose.x, to.pose.y}).x, turned};
  const Way even{shown_.linear * elapsed, shown_.angular * elapsed};
  const double beside = kBesideAtOnce + kSwerve * elapsed * elapsed;
  const bool jumps = std::abs(way.forward - even.forward) > beside || std::abs(way.turned - even.turned) > beside;
  has_jumped_ = contradiction_ && jumps && !has_jumped_;
  return has_jumped_ ? even : way;
}

void TwistWatch::restart() { samples_.clear(); }

void TwistWatch::keep(const Sample& sample) {
  const bool is_same = sample.stamp == samples_.back().stamp;
  const bool is_near = samples_.size() > 1 && sample.stamp - (samples_.end() - 2)->stamp < kBetween;
  if (is_same || is_near) samples_.pop_back();
  samples_.push_back(sample);
  while (samples_.front().stamp < sample.stamp - kWatched) samples_.pop_front();
}

void TwistWatch::judge() {
  const double now = samples_.back().stamp;
  if (!contradiction_ && std::abs(now - judged_) < kCheckPeriod) return;
  judged_ = now;
  const double noise = noiseOf(&Way::forward);
  const double turn_noise = noiseOf(&Way::turned);
  for (const double seconds : {1.0, 2.0, 4.0}) {
    const std::optional<Span> span = contradiction_ ? std::nullopt : lastSpan(seconds);
    if (!span) continue;
    const bool is_wrong = contradicts(&Way::forward, *span, kStillWay + kCreep * seconds + kNoises * noise) ||
                          contradicts(&Way::turned, *span, kStillTurn + kCreepTurn * seconds + kNoises * turn_noise);
    if (is_wrong) contradiction_ = meansOf(*span);
  }
  if (contradiction_ && samples_.size() > 1) {
    shown_ = {evenSpeed(&Way::forward, noise), evenSpeed(&Way::turned, turn_noise)};
  }
}

/// Standard deviation of the poses, from how far each is beside the middle of its neighbours: what the robot does in so
/// short a time is less than that, and the median does not see jumps. Or from poses of the same stamp, if that is more.
double TwistWatch::noiseOf(double Way::*part) {
  constexpr double kOfNormal = 1.2105;  // 1 / (0.6745 sqrt(1.5))
  if (samples_.size() < 3) return 0.0;
  const auto median = [this] {
    const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
    std::nth_element(scratch_.begin(), middle, scratch_.end());
    return *middle;
  };
  scratch_.clear();
  for (const Sample& sample : samples_) scratch_.push_back(sample.revised.*part);
  const double revised = median();
  scratch_.clear();
  for (std::size_t i = 1; i + 1 < samples_.size(); ++i) {
    const Sample& before = samples_[i - 1];
    const Sample& after = samples_[i + 1];
    const double share = (samples_[i].stamp - before.stamp) / (after.stamp - before.stamp);
    const double way = after.shown.*part - before.shown.*part;
    scratch_.push_back(std::abs(samples_[i].shown.*part - before.shown.*part - share * way));
  }
  return std::max(kOfNormal * median(), revised);
}

std::optional<TwistWatch::Span> TwistWatch::lastSpan(double seconds) const {
  const double end = samples_.back().stamp;
  const auto before = [](const Sample& sample, double stamp) { return sample.stamp < stamp; };
  Span span;
  for (std::size_t i = 0; i <= kQuarters; ++i) {
    const double share = static_cast<double>(kQuarters - i) / kQuarters;
    const auto border = std::lower_bound(samples_.begin(), samples_.end(), end - share * seconds, before);
    span[i] = &*border;
    if (i > 0 && span[i] == span[i - 1]) return std::nullopt;
  }
  // Rounding: the first sample may be a little younger than kWatched.
  return span.front()->stamp > end - 0.9 * seconds ? std::nullopt : std::make_optional(span);
}

/// Both over the whole span and over its quarters, but one, in which the poses may have jumped.
bool TwistWatch::contradicts(double Way::*part, const Span& span, double slack) const {
  const auto shown = [part](const Sample* from, const Sample* to) { return to->shown.*part - from->shown.*part; };
  const auto said = [part](const Sample* from, const Sample* to) { return to->said.*part - from->said.*part; };
  const auto wrongBy = [&](const Sample* from, const Sample* to, double least) {
    const double wrong = shown(from, to) - said(from, to);
    const double allowed = least + kWrong * std::max(std::abs(shown(from, to)), std::abs(said(from, to)));
    return std::abs(wrong) > allowed ? wrong : 0.0;
  };
  const auto change = [&](const auto& way) {
    return std::abs(way(span[3], span[4]) / (span[4]->stamp - span[3]->stamp) -
                    way(span[0], span[1]) / (span[1]->stamp - span[0]->stamp));
  };
  slack += kDelay * std::max(change(shown), change(said));
  const double wrong = wrongBy(span.front(), span.back(), slack);
  if (wrong == 0.0) return false;
  std::size_t same = 0;
  for (std::size_t i = 0; i < kQuarters; ++i) {
    same += wrong * wrongBy(span[i], span[i + 1], slack / kQuarters) > 0.0 ? 1 : 0;
  }
  return same >= kQuarters - 1;
}

TwistWatch::Contradiction TwistWatch::meansOf(const Span& span) {
  const Sample& from = *span.front();
  const Sample& to = *span.back();
  const double seconds = to.stamp - from.stamp;
  const auto mean = [seconds](const Way& first, const Way& last) {
    return Twist2{(last.forward - first.forward) / seconds, (last.turned - first.turned) / seconds};
  };
  return {mean(from.said, to.said), mean(from.shown, to.shown)};
}

/// Over as long as the poses show an even drive until now, within their noise: short when the robot changes its speed.
double TwistWatch::evenSpeed(double Way::*part, double noise) const {
  const double beside = std::max(kEvenNoises * noise, kLeastNoise);
  const Sample& newest = samples_.back();
  double slowest = -std::numeric_limits<double>::infinity();
  double fastest = std::numeric_limits<double>::infinity();
  double speed = 0.0;
  for (auto sample = samples_.rbegin() + 1; sample != samples_.rend(); ++sample) {
    const double elapsed = newest.stamp - sample->stamp;
    const double way = newest.shown.*part - (*sample).shown.*part;
    const bool is_even = way >= slowest * elapsed && way <= fastest * elapsed;
    if (elapsed > kLongestEven || (!is_even && elapsed > kShortestEven)) break;
    speed = way / elapsed;
    slowest = std::max(slowest, (way - beside) / elapsed);
    fastest = std::min(fastest, (way + beside) / elapsed);
  }
  return speed;
}

}  // namespace lstm_planner
