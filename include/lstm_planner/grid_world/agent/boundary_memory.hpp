#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "lstm_planner/grid_world/agent/boundary_edge.hpp"
#include "lstm_planner/grid_world/agent/boundary_trail.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

/// What an agent remembers of the boundary that keeps it from the goal, whoever chooses its moves: how near to the goal
/// it has been, which hand it has kept on the wall since, how far it has followed the boundary to both sides, and the
/// trail between these two ends. BoundaryFollower remembers the same, but decides itself.
///
/// Nothing is searched. Lengths are in cells; directions are those of rays, kNoPath: there is none. 4 KiB.
class BoundaryMemory {
 public:
  explicit BoundaryMemory(CornerCutting corner_cutting = CornerCutting::kForbidden);

  /// Forgets everything; the path starts at the next observation.
  void start() { started_ = false; }

  /// Once before each step. A jump, or another goal, is a new start.
  void observe(const GridObservation& observation);

  CornerCutting cornerCutting() const { return corner_cutting_; }

  /// The least distance to the goal so far.
  OctileDistance best() const { return best_; }

  /// The hand on the wall; empty: the agent is as near to the goal as ever.
  std::optional<WallSide> hand() const { return hand_; }

  /// Where a hand on the wall leads; kNoPath without a wall.
  int directionByHand(WallSide hand) const { return by_hand_[indexOf(hand)]; }

  /// The agent is on its trail to the end that it has followed with this hand. Else it stands at that end.
  bool returning() const { return returning_; }

  /// Along the trail to the end that was followed with a hand; kNoPath at that end, or without a trail.
  int directionToEnd(WallSide hand) const { return to_ends_[indexOf(hand)]; }
  double lengthToEnd(WallSide hand) const;

  /// Cells walked since the agent came to the end of its hand, or left for it.
  double leg() const { return leg_; }

  /// How far the other end was when the agent came to the end of its hand.
  double pathBack() const { return path_back_; }

  /// How much farther than the agent the other hand's end is from the goal.
  double otherEndFarther() const;

 private:
  /// A place on the boundary, and the direction of the obstacle there.
  struct End {
    CellIndex cell;
    int wall = kNoPath;  ///< where there is none at hand
  };

  static std::size_t indexOf(WallSide hand) { return hand == WallSide::kRight ? 0 : 1; }
  void startHere();
  void noteMove(int move);
  void noteHands();
  int wallHere() const;
  int wallBeside() const;

  CornerCutting corner_cutting_;
  GridObservation now_;
  bool started_ = false;
  int previous_move_ = kNoPath;
  OctileDistance best_;
  std::optional<WallSide> hand_;
  bool returning_ = false;
  bool has_returned_ = false;  ///< by the last step
  double leg_ = 0.0;
  double path_back_ = 0.0;
  std::array<int, 2> by_hand_{kNoPath, kNoPath};
  std::array<int, 2> to_ends_{kNoPath, kNoPath};
  std::array<End, 2> ends_{};
  BoundaryTrail trail_;
};

inline WallSide opposite(WallSide side) { return side == WallSide::kRight ? WallSide::kLeft : WallSide::kRight; }

}  // namespace lstm_planner
