#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/beam_directions.hpp"
#include "lstm_planner/drive/perception/beam_finder.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// When a return counts as moving. The margins cover the noise of a scanner, 2 % of odometry error and 10 ms between
/// the clocks of scan and odometry.
struct MovingReturnsParameters {
  double range = 4.0;
  double youngest = 0.2;
  double oldest = 0.6;
  double range_margin = 0.07;
  double lateral_margin = 0.05;
  double angle_margin = 0.03;
  int fewest_beams = 4;
  double hold = 1.0;
  double remember = 10.0;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitMovingParameters(Parameters& moving, const Visitor& visit) {
  visit("moving/range", moving.range, {0.1, 100.0}, "m", "returns farther away are ignored");
  visit("moving/youngest", moving.youngest, {0.001, 10.0}, "s",
        "age of the newest scan for the comparison: the fastest motion is noticed after this time");
  visit("moving/oldest", moving.oldest, {0.001, 10.0}, "s",
        "age of the oldest scan for the comparison; longer notices slower motion and keeps more scans");
  visit("moving/range_margin", moving.range_margin, {0.001, 10.0}, "m",
        "distance behind a return that an earlier scan must have seen free; larger notices later, smaller takes noise "
        "for motion");
  visit("moving/lateral_margin", moving.lateral_margin, {0.001, 10.0}, "m",
        "distance to both sides of a return that an earlier scan must have seen free");
  visit("moving/angle_margin", moving.angle_margin, {1e-4, 1.0}, "rad",
        "angle to both sides of a return that an earlier scan must have seen free; larger if odometry measures turns "
        "badly");
  visit("moving/fewest_beams", moving.fewest_beams, {1, 10000}, "",
        "number of neighbouring beams that must agree; fewer notice thinner things, and take more noise for motion");
  visit("moving/hold", moving.hold, {0.0, 600.0}, "s",
        "time for which a thing counts as moving after its last motion; then it counts as resting");
  visit("moving/remember", moving.remember, {0.0, 600.0}, "s",
        "time for which a thing counts as resting after its last motion; then it counts as a wall");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const MovingReturnsParameters& parameters);

/// Finds the returns of a scan that belong to things that move: they lie where an earlier scan saw free space. Places
/// that were hidden before, such as a wall behind a corner, do not count; things that move away from the scanner are
/// not noticed. Such places are remembered for a while in the odometry frame: a person who stands may walk on.
class MovingReturns {
 public:
  explicit MovingReturns(const MovingReturnsParameters& parameters);

  /// The robot is at most that fast, m/s: odometry that is much faster has jumped.
  void expectSpeed(double fastest);

  /// Takes in a scan from `pose` (base in the odometry frame) at `time`, s. A time that goes back forgets all.
  void show(const RangeProfile& profile, const Pose2& pose, double time);

  /// Returns of the last scan that move, and places out of its sight where something has just moved; base frame, m.
  const std::vector<Point2>& points() const { return points_; }

  /// The same near the robot, of what has moved before and stands now.
  const std::vector<Point2>& resting() const { return resting_; }

  /// All returns of the last scan within moving/range, in the order of the beams; where the scan closes, from any beam
  /// on. Odometry frame, m.
  const std::vector<Point2>& returns() const { return returns_; }
  /// For each of them, whether it moves.
  const std::vector<std::uint8_t>& moves() const { return moves_; }

  /// Forgets all: after a jump of the odometry, for instance.
  void reset();

 private:
  /// A scan and where it was taken.
  struct View {
    Point2 toBase(const Point2& point) const {
      const double dx = point.x - pose.x;
      const double dy = point.y - pose.y;
      return {cosine * dx + sine * dy, cosine * dy - sine * dx};
    }
    Point2 toOdometry(const Point2& point) const {
      return {pose.x + cosine * point.x - sine * point.y, pose.y + sine * point.x + cosine * point.y};
    }
    RangeProfile profile;
    Pose2 pose;
    double cosine = 1.0;  ///< of the pose's yaw, which all returns are turned by
    double sine = 0.0;
    double time = 0.0;
    Point2 scanner;             ///< odometry frame
    BeamFinder finder;          ///< for the odometry frame
    std::vector<float> limits;  ///< m^2; a beam each: what is farther was surely not seen free
  };
  /// Where something has moved.
  struct Place {
    Point2 point;       ///< odometry frame
    double time = 0.0;  ///< s, when something moved there last
  };
  enum class Sight { kFree, kTaken, kUnknown };

  void takeView(const RangeProfile& profile, const Pose2& pose, double time);
  void keepView();
  Sight sightOf(const Point2& point, const View& view) const;
  void collectReturns();
  void beginWithAThing();
  void compareWith(const View& reference);
  void findMoving();
  void closeGroup();
  void notePlace(const Point2& point);
  void forgetPlaces();
  void collectPoints();
  void collectNear(const std::vector<Point2>& places, std::vector<Point2>* points,
                   std::vector<std::uint8_t>* is_near) const;

  MovingReturnsParameters parameters_;
  double fastest_odometry_;  ///< m/s
  View view_;                ///< the last scan
  std::deque<View> views_;   ///< the oldest first
  BeamDirections directions_;
  std::vector<Point2> returns_;        ///< of the last scan, odometry frame, in the order of the beams
  std::vector<std::size_t> beams_;     ///< of the returns; increasing, also beyond the first beam
  std::vector<std::uint8_t> is_free_;  ///< a return each: an earlier scan saw free space there
  std::vector<std::uint8_t> moves_;
  std::vector<Point2> group_;  ///< returns beside one another that may be moving
  std::vector<Place> places_;
  std::vector<Point2> moving_places_, resting_places_;  ///< odometry frame
  std::vector<Point2> points_, resting_;
};

}  // namespace lstm_planner
