#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "lstm_planner/base/learning/tile_exchange.hpp"
#include "robot/learning/drive_practice.hpp"

namespace lstm_planner {

/// A step of a drive that lies in a queue. A way of learning adds what it thinks of the step.
struct DrivePlace {
  const PracticeEpisode* episode = nullptr;  ///< null where the queue has no more drives
  std::size_t step = 0;
};

/// What was recorded there, of an encoder with so many inputs: these, then the privileged ones. Null where there is no
/// drive.
inline const float* inputsOf(const DrivePlace& place, int inputs) {
  const auto all = static_cast<std::size_t>(inputs + kDrivePrivilegedInputs);
  return place.episode ? place.episode->inputs.data() + place.step * all : nullptr;
}

/// Queues of drives, one drive behind the other in each, gone through window by window. `Slot` is a DrivePlace.
template <typename Slot>
class DriveQueues {
 public:
  /// `queues`: how many. `window`: steps. `inputs`: of the encoder.
  DriveQueues(int queues, int window, int inputs)
      : window_(window), inputs_(inputs), queues_(static_cast<std::size_t>(queues)) {}

  int count() const { return static_cast<int>(queues_.size()); }

  /// The shortest queue so far, and its length in steps.
  std::size_t shortestQueue() const {
    const auto shorter = [](const auto& a, const auto& b) { return a.size() < b.size(); };
    return static_cast<std::size_t>(std::min_element(queues_.begin(), queues_.end(), shorter) - queues_.begin());
  }
  std::size_t lengthOf(std::size_t queue) const { return queues_[queue].size(); }
  std::size_t longest() const {
    std::size_t longest = 0;
    for (const auto& queue : queues_) longest = std::max(longest, queue.size());
    return longest;
  }

  void append(std::size_t queue, const PracticeEpisode& episode) {
    for (std::size_t step = 0; step < episode.steps.size(); ++step) {
      Slot slot;
      slot.episode = &episode;
      slot.step = step;
      queues_[queue].push_back(slot);
    }
  }

  /// All drives are there; fills up the queues to so many windows.
  void close(int windows) {
    windows_ = windows;
    for (auto& queue : queues_) queue.resize(static_cast<std::size_t>(steps()));
  }

  int window() const { return window_; }
  int windows() const { return windows_; }
  int steps() const { return windows_ * window_; }  ///< of each queue, once closed
  Slot& at(int time, int queue) { return queues_[static_cast<std::size_t>(queue)][static_cast<std::size_t>(time)]; }

  /// A slot's inputs into those of a network: the first `count` of what was recorded, `stride` apart.
  void fillInputs(const Slot& slot, int count, float* input, int stride) const {
    const float* values = inputsOf(slot, inputs_);
    for (int row = 0; row < count; ++row) input[row * stride] = values ? values[row] : 0.0f;
  }

 private:
  int window_;
  int inputs_;
  int windows_ = 0;
  std::vector<std::vector<Slot>> queues_;
};

/// Tiles, each with its queues(): shared among ranks and threads, and their results added up in order, the same for any
/// number of them. Every rank packs all drives, and has to call each() and addUp() as the others do.
template <typename Tile>
class DriveTiles {
 public:
  /// Of drives, in all tiles together.
  static constexpr int kQueues = 128;

  /// `make` makes a tile; all have the same number of queues.
  template <typename Make>
  DriveTiles(Communicator* ranks, int threads, const Make& make) : exchange_(ranks, threads) {
    do {
      tiles_.push_back(make());
    } while (static_cast<int>(tiles_.size()) * tiles_.front()->queues().count() < kQueues);
  }

  /// Each drive, which must outlive the tiles, to the queue that is shortest so far. Returns how many windows all have.
  int pack(const std::vector<PracticeEpisode>& episodes) {
    for (const PracticeEpisode& episode : episodes) {
      Tile* shortest = nullptr;
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

  /// What `work` says of each tile, in the order of the tiles. `zero`: of a tile with nothing in it.
  template <typename Sum, typename Work>
  std::vector<Sum> each(const Sum& zero, const Work& work) {
    return exchange_.each(count(), zero,
                          [&](int tile, int) { return work(tiles_[static_cast<std::size_t>(tile)].get()); });
  }

  /// Adds up the gradients, of `size` numbers, that `work` leaves in the tiles, and the steps that it says they are
  /// over.
  template <typename Work>
  double addUp(Eigen::Index size, const Work& work, Eigen::VectorXf* gradient) {
    double steps = 0.0;
    for (const double some : each(0.0, work)) steps += some;
    *gradient = exchange_.sumOf(count(), size, [&](int tile) -> const Eigen::VectorXf& {
      return tiles_[static_cast<std::size_t>(tile)]->gradient();
    });
    return steps;
  }

  auto begin() const { return tiles_.begin(); }
  auto end() const { return tiles_.end(); }

 private:
  int count() const { return static_cast<int>(tiles_.size()); }

  TileExchange exchange_;
  std::vector<std::unique_ptr<Tile>> tiles_;
};

}  // namespace lstm_planner
