#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lstm_planner/training/tile_exchange.hpp"
#include "practice/drive_tile.hpp"

namespace lstm_planner {

/// Drives side by side in tiles of queues, gone through window by window: what an update learns from. Tiles are shared
/// among ranks and threads, and their results added up in order, the same for any number of them. Every rank has all
/// drives, and has to ask for the same.
class DriveBatch {
 public:
  /// All must outlive the batch.
  DriveBatch(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic,
             const std::vector<PracticeEpisode>& episodes);

  /// Works out advantages and returns, and moves the variances towards the advantages'.
  void judge(const Eigen::VectorXf& critic_parameters, std::vector<double>* advantage_variances);

  /// To before the first window, with zero hidden state.
  void rewind();
  /// To the next window; false when there is none.
  bool next() { return ++window_ < windows_; }

  /// Gradients of the errors, summed over the window; both return over how many steps. Once a window each.
  double policyGradient(const Eigen::VectorXf& parameters, const DriveBatchWeights& weights, Eigen::VectorXf* gradient);
  double criticGradient(const Eigen::VectorXf& parameters, Eigen::VectorXf* gradient);

  double entropy();                                     ///< mean so far, nat
  const CriticSums& judged() const { return judged_; }  ///< by the critic before it learned from the batch

 private:
  /// Each drive to the queue that is shortest so far. Returns how many windows all have.
  int pack(const std::vector<PracticeEpisode>& episodes);
  /// The sum of what `work` says of each tile. `zero`: of a tile with nothing in it.
  template <typename Sum, typename Work>
  Sum run(const Sum& zero, const Work& work);
  /// Adds up the gradients, of `size` numbers, that `work` leaves in the tiles, and the steps that it says they are
  /// over.
  template <typename Work>
  double addUp(Eigen::Index size, const Work& work, Eigen::VectorXf* gradient);

  TileExchange exchange_;
  std::vector<std::unique_ptr<DriveTile>> tiles_;
  int windows_ = 0;
  int window_ = -1;
  CriticSums judged_;
};

}  // namespace lstm_planner
