#include "practice/drive_views.hpp"

namespace lstm_planner {

DriveViews::DriveViews(const PolicyDescription& policy)
    : views_(policy.encoder.views),
      encoder_(policy.encoder),
      action_views_(views_ == 1 ? std::vector<int>() : viewsOf(policy.actions)) {}

void DriveViews::forget(int step, int queue, LaneNetwork* network) const {
  for (int view = 0; view < views_; ++view) network->forget(step, queue * views_ + view);
}

void DriveViews::fillInputs(const DriveSlot& slot, int queue, float* rows) const {
  const int stride = networkLanes();
  float* first = rows + queue * views_;
  const float* ahead = inputsOf(slot, encoder_.size());
  if (views_ == 1 || !ahead) {
    for (int row = 0; row < encoder_.size(); ++row) {
      for (int view = 0; view < views_; ++view) first[row * stride + view] = ahead ? ahead[row] : 0.0f;
    }
    return;
  }
  encoder_.turn(ahead, slot.episode->bearings[slot.step], first, stride);
}

int DriveViews::outputAt(const DriveSlot& slot, int queue, int action) const {
  if (views_ == 1) return action * networkLanes() + queue;
  const int ahead = slot.episode->bearings[slot.step].ahead;
  return queue * views_ + (ahead + action_views_[static_cast<std::size_t>(action)]) % views_;
}

}  // namespace lstm_planner
