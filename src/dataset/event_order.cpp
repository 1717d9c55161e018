#include "lstm_planner/dataset/event_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lstm_planner {

namespace {

/// The variant lists them in the order in which events of the same moment are worked on.
bool isBefore(const DriveEvent& a, const DriveEvent& b) {
  return std::make_pair(stampOf(a), a.index()) < std::make_pair(stampOf(b), b.index());
}

}  // namespace

EventOrder::Verdict EventOrder::add(DriveEvent event) {
  const double stamp = stampOf(event);
  if (newest_ && std::abs(stamp - *newest_) > horizon_) return Verdict::kClockSet;
  if (taken_ && stamp < *taken_) return Verdict::kLate;
  newest_ = newest_ ? std::max(*newest_, stamp) : stamp;
  const auto later = std::upper_bound(events_.begin(), events_.end(), event, isBefore);
  events_.insert(later, std::move(event));
  return Verdict::kTaken;
}

std::optional<DriveEvent> EventOrder::take(bool all) {
  if (events_.empty() || (!all && stampOf(events_.front()) > *newest_ - delay_)) return std::nullopt;
  std::optional<DriveEvent> event = std::move(events_.front());
  events_.pop_front();
  taken_ = stampOf(*event);
  return event;
}

void EventOrder::clear() {
  events_.clear();
  newest_.reset();
  taken_.reset();
}

}  // namespace lstm_planner
