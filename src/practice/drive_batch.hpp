#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "lstm_planner/common/parallel_for.hpp"
#include "practice/drive_tile.hpp"

namespace lstm_planner {

/// Drives side by side in tiles of queues, gone through window by window: what an update learns from. Threads share the
/// tiles, whose results are added up in order, the same for any number of threads.
class DriveBatch {
 public:
  /// All must outlive the batch.
  DriveBatch(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic,
             const std::vector<PracticeEpisode>& episodes)
      : threads_(parameters.threads) {
    do {
      tiles_.push_back(std::make_unique<DriveTile>(parameters, policy, critic));
    } while (static_cast<int>(tiles_.size()) * tiles_.front()->queues().count() < kQueues);
    windows_ = pack(episodes);
  }

  /// Works out advantages and returns, and moves the variances towards the advantages'.
  void judge(const Eigen::VectorXf& critic_parameters, std::vector<double>* advantage_variances) {
    judged_ =
        run(CriticSums(advantage_variances->size()), [&](DriveTile* tile) { return tile->judge(critic_parameters); });
    judged_.moveVariances(kVarianceRate, advantage_variances);
  }

  /// To before the first window, with zero hidden state.
  void rewind() {
    window_ = -1;
    for (const auto& tile : tiles_) tile->rewind();
  }
  /// To the next window; false when there is none.
  bool next() { return ++window_ < windows_; }

  /// Gradients of the errors, summed over the window; both return over how many steps. Once a window each.
  double policyGradient(const Eigen::VectorXf& parameters, const DriveBatchWeights& weights,
                        Eigen::VectorXf* gradient) {
    return addUp(
        parameters.size(), [&](DriveTile* tile) { return tile->policyGradient(window_, parameters, weights); },
        gradient);
  }
  double criticGradient(const Eigen::VectorXf& parameters, Eigen::VectorXf* gradient) {
    return addUp(
        parameters.size(), [&](DriveTile* tile) { return tile->criticGradient(window_, parameters); }, gradient);
  }

  double entropy() {  ///< mean so far, nat
    const DriveTileEntropy all = run(DriveTileEntropy(), [](DriveTile* tile) { return tile->entropy(); });
    return all.steps > 0.0 ? all.sum / all.steps : 0.0;
  }
  const CriticSums& judged() const { return judged_; }  ///< by the critic before it learned from the batch

 private:
  /// Share by which the variances move towards those of one batch.
  static constexpr double kVarianceRate = 0.3;

  /// Of drives, in all tiles together.
  static constexpr int kQueues = 128;

  /// Each drive to the queue that is shortest so far. Returns how many windows all have.
  int pack(const std::vector<PracticeEpisode>& episodes) {
    for (const PracticeEpisode& episode : episodes) {
      DriveTile* shortest = nullptr;
      std::size_t queue = 0;
      for (const auto& tile : tiles_) {
        const std::size_t own = tile->queues().shortestQueue();
        if (shortest != nullptr && tile->queues().lengthOf(own) >= shortest->queues().lengthOf(queue)) continue;
        shortest = tile.get();
        queue = own;
      }
      shortest->queues().append(queue, episode);
    }
    std::size_t longest = 0;
    for (const auto& tile : tiles_) longest = std::max(longest, tile->queues().longest());
    const int window = tiles_.front()->queues().window();
    const int windows = (static_cast<int>(longest) + window - 1) / window;
    for (const auto& tile : tiles_) tile->queues().close(windows);
    return windows;
  }
  /// The sum of what `work` says of each tile. `zero`: of a tile with nothing in it.
  template <typename Sum, typename Work>
  Sum run(const Sum& zero, const Work& work) {
    return parallelSum(static_cast<int>(tiles_.size()), threads_, zero,
                       [&](int tile, int) { return work(tiles_[static_cast<std::size_t>(tile)].get()); });
  }
  /// Adds up the gradients, of `size` numbers, that `work` leaves in the tiles, and the steps that it says they are
  /// over.
  template <typename Work>
  double addUp(Eigen::Index size, const Work& work, Eigen::VectorXf* gradient) {
    const double steps = run(0.0, work);
    gradient->setZero(size);
    for (const auto& tile : tiles_) *gradient += tile->gradient();
    return steps;
  }

  int threads_;
  std::vector<std::unique_ptr<DriveTile>> tiles_;
  int windows_ = 0;
  int window_ = -1;
  CriticSums judged_;
};

}  // namespace lstm_planner
