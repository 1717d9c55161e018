#include "tools/progress.hpp"

#include <unistd.h>

#include <iostream>

#include "tools/ranks.hpp"

namespace lstm_planner {

namespace {
constexpr unsigned long kTicks = 1000;
}

Progress::Progress() {
  if (isatty(STDERR_FILENO) != 0 && isFirstRank()) {
    bar_ = std::make_unique<Bar>(kTicks, std::cerr);
  }
}

void Progress::show(double share) {
  if (!bar_) {
    return;
  }
  const auto ticks = static_cast<unsigned long>(share * kTicks);
  if (ticks > bar_->count() && ticks <= kTicks) {
    *bar_ += ticks - bar_->count();
  }
}

}  // namespace lstm_planner
