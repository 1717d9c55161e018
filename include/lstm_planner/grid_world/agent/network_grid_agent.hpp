#pragma once

#include <cstddef>
#include <optional>

#include "lstm_planner/base/network/batch_network.hpp"
#include "lstm_planner/base/network/model_file.hpp"
#include "lstm_planner/base/network/network.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/grid_progress_watch.hpp"
#include "lstm_planner/grid_world/agent/grid_rescue.hpp"

namespace lstm_planner {

/// An agent whose decisions a network makes: LSTM, RNN, MLP or Q-network, whatever the model holds. The rescue takes
/// over when it gets into difficulties, and makes it certain that it arrives. From then on the network and what it
/// remembers are not needed any more.
class NetworkGridAgent : public GridAgent {
 public:
  /// What watches over the network, and how it may move.
  struct Options {
    bool shield = true;  ///< off: the preferred move is tried even where it was sensed to be blocked
    bool escape = true;
    /// Without escape: steps in which the agent has come neither nearer to the goal nor to a new place, after which
    /// moves are drawn with the probabilities that the network gives, so that it leaves circles. 0: never.
    int draw_after = 0;
    GridRescueParameters rescue;
    CornerCutting corner_cutting = CornerCutting::kForbidden;
  };

  /// Throws std::invalid_argument when the model was not made for the grid world or its sizes do not fit.
  NetworkGridAgent(const Model& model, const Options& options);

  void start(CellIndex start, CellIndex goal) override;
  void observe(const GridObservation& observation) override;
  int decide() override;
  GridLeader leader() const override { return isRescued() ? rescue_->leader() : GridLeader::kNetwork; }
  int searchedDirection() const override;
  void step(int direction, bool moved) override;
  std::size_t peakBytes() const override;

  bool isRescued() const { return rescue_ && rescue_->active(); }

 private:
  void judgeMoves();
  bool mayMove(int direction) const;
  int preferredMove() const;
  int drawnMove() const;
  void takeOver(const GridObservation& observation);

  bool shield_;
  int draw_after_;
  CornerCutting corner_cutting_;
  GridEncoder encoder_;
  std::optional<Network> network_;     ///< of the only view
  std::optional<BatchNetwork> views_;  ///< or of several, which go through it side by side
  std::optional<GridMemory> memory_;   ///< until the rescue takes over
  std::optional<GridRescue> rescue_;
  GridProgressWatch watch_;      ///< without rescue
  std::size_t peak_bytes_ = 0;   ///< of what is not needed at the same time
  BatchNetwork::Values inputs_;  ///< a column a view
  Eigen::VectorXf preferences_;
};

}  // namespace lstm_planner
