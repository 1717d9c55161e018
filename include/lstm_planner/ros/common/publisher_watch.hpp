#pragma once

#include <string>
#include <utility>

namespace lstm_planner {

/// Notices that two nodes publish in turn what must come from one. A node that has taken another one's place does not
/// count.
class PublisherWatch {
 public:
  /// `publisher`: the node that a message is from. `now`: s. True once, when two are noticed.
  bool note(const std::string& publisher, double now) {
    constexpr double kLongestTurn = 5.0;  // s
    if (publisher == newest_) return false;
    const bool in_turn = publisher == other_ && now - changed_ <= kLongestTurn;
    other_ = std::exchange(newest_, publisher);
    changed_ = now;
    return in_turn && !std::exchange(is_noticed_, true);
  }

  const std::string& newest() const { return newest_; }  ///< node
  const std::string& other() const { return other_; }    ///< the node before it

 private:
  std::string newest_;
  std::string other_;
  double changed_ = 0.0;  ///< s
  bool is_noticed_ = false;
};

}  // namespace lstm_planner
