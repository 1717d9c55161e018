#include "lstm_planner/dataset/event_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lstm_planner {

EventOrder::Verdict EventOrder::add(DriveEvent event) {
  const double stamp = stampOf(event);
  if (newest_ && std::abs(stamp - *newest_) > horizon_) return Verdict::kClockSet;
  if (taken_ && stamp < *taken_) return Verdict::kLate;
  newest_ = newest_ ? std::max(*newest_, stamp) : stamp;
  const auto key = std::make_pair(stamp, event.index());
  events_.emplace(key, std::move(event));
  return Verdict::kTaken;
}

std::optional<DriveEvent> EventOrder::take(bool all) {
  if (events_.empty()) return std::nullopt;
  const bool is_due = events_.begin()->first.first <= *newest_ - delay_ || events_.size() > kMostWaiting;
  if (!is_due && !all) return std::nullopt;
  std::optional<DriveEvent> event = std::move(events_.begin()->second);
  taken_ = events_.begin()->first.first;
  events_.erase(events_.begin());
  return event;
}

void EventOrder::clear() {
  events_.clear();
  newest_.reset();
  taken_.reset();
}

}  // namespace lstm_planner
