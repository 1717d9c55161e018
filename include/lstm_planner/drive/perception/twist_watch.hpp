#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Decides which speed of an odometry to believe. Its messages say a speed (twist), and their poses show one. The twist
/// is newer and smoother, so it counts, until it contradicts the poses: some publishers send 0, others the speed in the
/// odometry's frame. From then on, for good, the speed is what the poses show.
///
/// What is compared are ways: the twist, summed up, and the poses, over 1, 2 and 4 s. Noise of the poses and stamps
/// that are rounded or late cancel out, and so do the delay of a filtered twist and single wrong values.
class TwistWatch {
 public:
  /// What the messages said, and what their poses showed.
  struct Contradiction {
    Twist2 said;
    Twist2 shown;
  };

  /// The next measurement, finite; `stamp` in s, `pose` in the odometry's frame, `twist` in the base frame. One of the
  /// same stamp replaces the last one; one of an earlier stamp, or after a long pause, starts again, as restart().
  void note(double stamp, const Pose2& pose, const Twist2& twist);

  /// The next pose does not continue the last ones: the odometry jumped. What is known of the twist stays.
  void restart();

  /// The robot's speed, base frame.
  Twist2 twist() const { return contradiction_ ? shown_ : said_; }

  /// Means over the time in which the twist proved wrong; none as long as it has not.
  const std::optional<Contradiction>& contradiction() const { return contradiction_; }

 private:
  /// A way of the robot: forward (m) and turned (rad), both with sign.
  struct Way {
    double forward = 0.0;
    double turned = 0.0;
  };
  /// Since the last restart.
  struct Sample {
    double stamp = 0.0;
    Pose2 pose;
    Twist2 twist;
    Way shown;
    Way said;
    Way revised;  ///< by the last one of the same stamp
  };

  /// Its first and last sample, and three between them: a quarter of the time each.
  using Span = std::array<const Sample*, 5>;

  Way shownWay(const Sample& from, const Sample& to);
  void keep(const Sample& sample);
  void judge();
  double noiseOf(double Way::*part);
  std::optional<Span> lastSpan(double seconds) const;
  bool contradicts(double Way::*part, const Span& span, double slack) const;
  static Contradiction meansOf(const Span& span);
  double evenSpeed(double Way::*part, double noise) const;

  std::deque<Sample> samples_;
  std::vector<double> scratch_;
  double judged_ = 0.0;      ///< s, when it was, last
  bool has_jumped_ = false;  ///< the newest pose
  Twist2 said_;
  Twist2 shown_;
  std::optional<Contradiction> contradiction_;
};

}  // namespace lstm_planner
