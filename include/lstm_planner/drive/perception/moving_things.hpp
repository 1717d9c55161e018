#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Something that moves, as the disc around what the scanner sees of it.
struct MovingThing {
  Point2 center;        ///< m
  double radius = 0.0;  ///< m
  Point2 velocity;      ///< m/s
};

/// Follows things that move from scan to scan, and measures their velocity: the slope of the line of least squares
/// through where they were in the last half second. Neighbouring returns are one thing if some of them move
/// (MovingReturns). What goes out of sight is taken to go on for a while.
class MovingThings {
 public:
  /// Takes in a scan: its returns in the order of the beams (odometry frame, m), whether each moves, and the time, s.
  /// A time that goes back forgets all.
  void show(const std::vector<Point2>& returns, const std::vector<std::uint8_t>& moves, double time);

  /// Those with a known velocity at the time of the last scan, in the base frame of a robot at `pose` (odometry frame).
  std::vector<MovingThing> around(const Pose2& pose) const;

  /// Forgets all: after a jump of the odometry, for instance.
  void reset() { tracks_.clear(); }

 private:
  /// A thing in one scan.
  struct Sighting {
    Point2 middle;  ///< odometry frame
    double time;    ///< s
  };
  /// A thing from scan to scan.
  struct Track {
    std::deque<Sighting> sightings;  ///< the oldest first
    double radius = 0.0;
    Point2 velocity;  ///< odometry frame
    bool is_measured = false;
    Point2 at(double time) const;
  };
  /// Returns of one scan that lie together, as a disc.
  struct Body {
    Point2 middle;  ///< odometry frame
    double radius;
  };

  void findBodies(const std::vector<Point2>& returns, const std::vector<std::uint8_t>& moves);
  void addBody(const std::vector<Point2>& returns, const std::vector<std::uint8_t>& moves, std::size_t first,
               std::size_t end);
  /// Index of the track that a body belongs to, among those that are not taken; a new one where there is none.
  std::size_t trackOf(const Body& body, std::vector<std::uint8_t>* is_taken);
  void extend(const Body& body, Track* track) const;
  static void measure(Track* track);

  std::vector<Body> bodies_;  ///< of the last scan
  std::vector<Track> tracks_;
  double time_ = 0.0;  ///< s, of the last scan
};

}  // namespace lstm_planner
