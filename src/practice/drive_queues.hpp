#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "practice/practice_episode.hpp"

namespace lstm_planner {

/// A step of a drive that lies in a queue, and what is thought of it.
struct DriveSlot {
  const PracticeEpisode* episode = nullptr;  ///< null where the queue has no more drives
  std::size_t step = 0;
  float value = 0.0f;
  float advantage = 0.0f;
};

/// What was recorded there, of an encoder with so many inputs: these, then the privileged ones. Null where there is no
/// drive.
inline const float* inputsOf(const DriveSlot& slot, int inputs) {
  const auto all = static_cast<std::size_t>(inputs + kDrivePrivilegedInputs);
  return slot.episode ? slot.episode->inputs.data() + slot.step * all : nullptr;
}

/// Queues of drives, one drive behind the other in each, gone through window by window.
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
      DriveSlot slot;
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
  DriveSlot& at(int time, int queue) {
    return queues_[static_cast<std::size_t>(queue)][static_cast<std::size_t>(time)];
  }

  /// A slot's inputs into those of a network: the first `count` of what was recorded, `stride` apart.
  void fillInputs(const DriveSlot& slot, int count, float* input, int stride) const {
    const float* values = inputsOf(slot, inputs_);
    for (int row = 0; row < count; ++row) input[row * stride] = values ? values[row] : 0.0f;
  }

 private:
  int window_;
  int inputs_;
  int windows_ = 0;
  std::vector<std::vector<DriveSlot>> queues_;
};

}  // namespace lstm_planner
