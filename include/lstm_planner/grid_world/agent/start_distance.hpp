#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// How far it is back to the start from the places where an agent has been, so that it can find back out of a dead end.
///
/// Nothing is searched: a place gets its distance when the agent enters it, from where the agent comes from and from
/// the known places that the rays show. It is that of a path that exists, not always of the shortest.
///
/// Places are the middles of blocks of 4 x 4 cells, in a window of 256 x 256 cells that lies over the plane like a
/// torus (VisitTrace). Distances are octile, in cells. 12 KiB, whatever the map.
class StartDistance {
 public:
  /// The distances along a ray; empty where the agent has not been, or the ray does not reach.
  struct Ray {
    std::optional<float> near;  ///< kNearProbe cells ahead, or before the obstacle
    std::optional<float> far;   ///< kFarProbe cells ahead, or before the obstacle
  };

  static constexpr int kNearProbe = 5;
  static constexpr int kFarProbe = 18;

  StartDistance();

  void clear();

  /// Once before each step; the first call is at the start.
  void observe(const GridObservation& observation);

  float here() const { return here_; }
  /// Of the latest observation.
  const std::array<Ray, kGridRayCount>& rays() const { return rays_; }

  static std::size_t bytes();

 private:
  static std::size_t entryOf(CellIndex cell);
  static std::uint8_t tagOf(CellIndex cell);
  std::optional<float> at(CellIndex cell) const;
  /// What stands `steps` ahead, by which it may be nearer from here, too.
  std::optional<float> probe(CellIndex cell, std::size_t direction, int steps);

  std::vector<std::uint16_t> distances_;
  std::vector<std::uint8_t> tags_;  ///< which of the places that share an entry
  std::array<Ray, kGridRayCount> rays_{};
  std::optional<CellIndex> last_;
  float here_ = 0.0f;
};

}  // namespace lstm_planner
