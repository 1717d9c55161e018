#pragma once

#include <cstddef>
#include <memory>

#include "lstm_planner/common/detour_bound.hpp"
#include "lstm_planner/common/progress_watch.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/grid_guide.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/network/network.hpp"

namespace lstm_planner {

/// An agent that is led by the network of a model: LSTM, RNN, MLP or Q-network. The shield removes moves into
/// obstacles. A bound limits detours: the move that the network prefers is carried out while the sum of its regrets
/// stays within the bound (DetourBound); otherwise the remembered path decides the step. So any network arrives.
class NetworkGridAgent : public GridAgent {
 public:
  /// What limits the network, and how the agent may move.
  struct Options {
    bool shield = true;  ///< off: the preferred move is tried even where it was sensed to be blocked
    bool guided = true;  ///< off: nothing is remembered for the network, and nothing limits its detours
    /// Only if `guided` is false: steps without a new best distance to the goal, after which moves are drawn with the
    /// probabilities that the network gives, so that the agent leaves circles. 0: never.
    int draw_after = 0;
    DetourParameters detour = {0.0, 0.01};  ///< cells
    GridGuideParameters guide;
    CornerCutting corner_cutting = CornerCutting::kForbidden;
  };

  /// Throws std::invalid_argument when the model was not made for the grid world or its sizes do not fit.
  NetworkGridAgent(const Model& model, const Options& options);

  void start(CellIndex start, CellIndex goal) override;
  void observe(const GridObservation& observation) override;
  int decide() override { return direction_; }
  GridLeader leader() const override { return leader_; }
  Overruled overruled() const override { return overruled_; }
  bool onPath() const override { return on_path_; }
  void step(int direction, bool moved) override;
  std::size_t peakBytes() const override;
  std::size_t expandedCells() const override { return guide_ ? guide_->expandedCells() : 0; }

 private:
  void choose();
  void chooseWithinBound(int preferred);
  bool mayMove(int direction) const;
  int bestMove() const;
  int drawnMove() const;

  bool shield_;
  int draw_after_;
  CornerCutting corner_cutting_;
  Network network_;
  GridObservation observation_;
  int previous_direction_ = kNoPath;
  std::unique_ptr<GridGuide> guide_;  ///< if it is guided
  DetourBound bound_;
  double walked_ = 0.0;  ///< cells
  ProgressWatch nearest_{0.0};
  Eigen::VectorXf preferences_;
  int direction_ = kNoPath;
  GridLeader leader_ = GridLeader::kNetwork;
  Overruled overruled_ = Overruled::kNo;
  bool on_path_ = false;
};

}  // namespace lstm_planner
