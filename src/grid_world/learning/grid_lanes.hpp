#pragma once

#include "grid_world/learning/grid_actor.hpp"
#include "lstm_planner/training/lane_network.hpp"

namespace lstm_planner {

/// Agents side by side in the lanes of a network: each has a lane, or one for each of its views.
class GridLanes {
 public:
  /// Of which the rows of a step stay in the first cache.
  static constexpr int kCount = 64;

  explicit GridLanes(const GridEncoderParameters& encoder)
      : encoder_(encoder), views_(encoder.views), actors_(kCount / encoder.views) {}

  int actors() const { return actors_; }
  const GridEncoder& encoder() const { return encoder_; }

  /// Of an agent that has sensed: what show() and encoder() are about.
  void prepare(const GridActor& actor) { encoder_.prepare(actor.memory()); }

  /// Shows a network in step `step` what agent number `index` sees.
  void show(int index, int step, LaneNetwork* network) const {
    encoder_.encodeViews(network->inputs(step) + index * views_, kCount);
  }

  /// The hidden state of agent number `index` starts anew in step `step`.
  void forget(int index, int step, LaneNetwork* network) const {
    for (int view = 0; view < views_; ++view) network->forget(step, index * views_ + view);
  }

  /// Where a network's outputs for agent number `index` say something of a direction.
  int outputAt(int index, int direction) const {
    return views_ == 1 ? direction * kCount + index : index * kGridMoveCount + direction;
  }

 private:
  GridEncoder encoder_;
  int views_;
  int actors_;
};

}  // namespace lstm_planner
