#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lstm_planner/grid_world/agent/boundary_edge.hpp"
#include "lstm_planner/grid_world/agent/boundary_trail.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

/// How far a boundary is followed to one side before the other one is tried.
struct BoundaryParameters {
  CornerCutting corner_cutting = CornerCutting::kForbidden;
  double first_leg = 40.0;  ///< cells to follow a boundary before the first turning back
  double leg_growth = 6.0;  ///< length of a later leg, divided by the length of the path between the ends at its start
  /// A leg is longer by so many cells for each cell that its end is nearer to the goal than the other end.
  double goal_weight = 3.0;
};

/// A bug algorithm for the grid: with bounded memory it gets from anywhere to the goal if there is a path, and says so
/// if there is none.
///
/// It moves to nearer cells until no neighbour is nearer to the goal than the cell that it stands on (octile distance,
/// exact). There it has met a boundary. It follows this to one side, turns back, follows it to the other side, and so
/// on, on longer and longer legs (as in the doubling search of Baeza-Yates et al., "Searching in the plane", 1993),
/// until it sees a cell that is nearer to the goal than all before. It goes to the other end along a trail that leaves
/// out the dead ends of the boundary.
///
/// Why it arrives. Let the best cell h be one where no neighbour is nearer. Each step of a staircase path P (east,
/// north, west, south) from h to the goal makes the octile distance smaller, so P's first step goes into a blocked
/// cell, through an edge of the boundary cycle B. Moved a little into the free region, B is a closed curve with the
/// whole region that the agent can reach on one side of it. If the goal is in this region, P starts and ends on that
/// side and so crosses B an even number of times: it comes back in through an edge of another cell q of B, which is
/// nearer to the goal than h. Following B therefore finds a nearer cell, or comes full circle and proves that there is
/// no path. Each cell h is nearer than the one before, and a finite grid has finitely many. This holds with and without
/// corner cutting: the rule only decides how B runs where two blocked cells touch at a corner (BoundaryEdge), and P
/// does not cross corners. Coming full circle is exact: the edges seen are one piece of the cycle, and its two ends
/// meet.
class BoundaryFollower : public GridAgent {
 public:
  /// Throws std::invalid_argument for a parameter that is negative or not finite.
  explicit BoundaryFollower(const BoundaryParameters& parameters = {});

  /// The path starts at the next observation.
  void start(CellIndex start, CellIndex goal) override;
  void observe(const GridObservation& observation) override;
  /// Must not be called at the goal.
  int decide() override { return decision_; }
  GridLeader leader() const override { return GridLeader::kBoundary; }
  std::size_t peakBytes() const override;

 private:
  enum class State { kGoing, kLeaving, kFollowing, kReturning };

  /// One end of the piece of boundary that has been seen.
  struct End {
    BoundaryEdge edge;
    WallSide side = WallSide::kRight;
    std::vector<CellIndex> cells;  ///< still to be entered on the path to the edge's cell
  };

  static constexpr std::size_t kMostCells = 16;

  int nextDirection();
  void meetBoundary();
  void startLeg(int end);
  bool seesNearerCell();
  bool follow(End* end, const BoundaryEdge& other);
  void append(End* end, CellIndex cell) const;
  int directionAlong(End* end) const;
  bool shouldTurnBack() const;

  BoundaryParameters parameters_;
  GridObservation now_;
  bool started_ = false;
  CellIndex expected_;
  int decision_ = kNoPath;
  State state_ = State::kGoing;
  OctileDistance best_;
  int leaving_direction_ = 0;
  std::array<End, 2> ends_;
  int end_ = 0;                ///< the end that is followed or returned to
  double leg_ = 0.0;           ///< cells gone since the leg started
  double path_back_ = 0.0;     ///< cells from there to the other end
  bool leg_advanced_ = false;  ///< a new edge was seen on this leg
  BoundaryTrail trail_;
};

}  // namespace lstm_planner
