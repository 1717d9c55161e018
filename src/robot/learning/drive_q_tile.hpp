#pragma once

#include <Eigen/Core>
#include <vector>

#include "lstm_planner/base/learning/lane_network.hpp"
#include "lstm_planner/base/learning/q_learning_targets.hpp"
#include "lstm_planner/robot/learning/drive_q_learning.hpp"
#include "robot/learning/drive_queues.hpp"
#include "robot/learning/drive_views.hpp"

namespace lstm_planner {

/// A step of a drive, and what its action should have been worth.
struct DriveQSlot : DrivePlace {
  bool learns = false;  ///< the action was chosen, and it is known what came of it
  double target = 0.0;
};

/// Some queues of drives, gone through window by window: what one thread works on.
class DriveQTile {
 public:
  /// All must outlive the tile.
  DriveQTile(const DriveQLearningParameters& parameters, const LayerStack& layers);

  DriveQueues<DriveQSlot>& queues() { return queues_; }

  /// Works out the targets of all steps. The next window is the first, with zero hidden state.
  ValueSums judge(const Eigen::VectorXf& weights, const Eigen::VectorXf& target_weights);

  /// Gradient of the errors, summed over a window; returns over how many steps. The windows in their order.
  double valueGradient(int window, const Eigen::VectorXf& weights);
  const Eigen::VectorXf& gradient() const { return gradient_; }

 private:
  void rewind();
  void fillInputs(int time, int step);
  int bestAction(const DriveQSlot& slot, int queue, const float* outputs) const;
  void valueStep(int time, int queue, const float* outputs, const float* target_outputs);
  void judgeQueue(int queue, ValueSums* sums);

  const DriveQLearningParameters& parameters_;
  int actions_;
  DriveViews views_;
  DriveQueues<DriveQSlot> queues_;
  LaneNetwork network_;
  LaneNetwork target_network_;                   ///< one step long: nothing goes back through it
  std::vector<std::vector<QTransition>> steps_;  ///< of each queue; one more, of which only the value would count
  Eigen::VectorXf gradient_;
};

}  // namespace lstm_planner
