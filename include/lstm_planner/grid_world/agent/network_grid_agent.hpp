#pragma once

#include <cstddef>
#include <optional>

#include "lstm_planner/base/network/batch_network.hpp"
#include "lstm_planner/base/network/model_file.hpp"
#include "lstm_planner/base/network/network.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/grid_escape.hpp"

namespace lstm_planner {

/// An agent whose decisions a network makes: LSTM, RNN, MLP or Q-network, whatever the model holds. The escape takes
/// over when it gets nowhere, and makes it certain that it arrives.
class NetworkGridAgent : public GridAgent {
 public:
  struct Options {
    bool shield = true;  ///< off: the preferred move is tried even where it was sensed to be blocked
    bool escape = true;
    GridEscapeParameters escape_parameters;
    CornerCutting corner_cutting = CornerCutting::kForbidden;
  };

  /// Throws std::invalid_argument when the model was not made for the grid world or its sizes do not fit.
  NetworkGridAgent(const Model& model, const Options& options);

  void start(CellIndex start, CellIndex goal) override;
  void observe(const GridObservation& observation) override;
  int decide() override;
  GridLeader leader() const override { return isEscaping() ? GridLeader::kBoundary : GridLeader::kNetwork; }
  int searchedDirection() const override;
  void step(int direction, bool moved) override;
  std::size_t peakBytes() const override;

  bool isEscaping() const { return escape_ && escape_->active(); }

 private:
  void judgeMoves();

  Options options_;
  GridEncoder encoder_;
  std::optional<Network> network_;     ///< of the only view
  std::optional<BatchNetwork> views_;  ///< or of several, which go through it side by side
  GridMemory memory_;
  std::optional<GridEscape> escape_;
  BatchNetwork::Values inputs_;  ///< a column a view
  Eigen::VectorXf preferences_;
};

}  // namespace lstm_planner
