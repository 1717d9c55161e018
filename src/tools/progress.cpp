#include "tools/progress.hpp"

#include <unistd.h>

#include <iostream>

#include "lstm_planner/common/output_file.hpp"

namespace lstm_planner {
namespace {

constexpr unsigned long kTicks = 1000;

volatile std::sig_atomic_t caught_signal = 0;

/// The first is remembered. Whoever sends another has no patience left; nothing stays half written all the same.
void remember(int signal) {
  if (caught_signal != 0) {
    removeUnfinishedFiles();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  caught_signal = signal;
}

}  // namespace

Progress::Progress() {
  if (isatty(STDERR_FILENO) != 0) {
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

Interruption::Interruption() {
  caught_signal = 0;
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, &interrupt_before_);
  ::sigaction(SIGTERM, &action, &terminate_before_);
}

Interruption::~Interruption() {
  ::sigaction(SIGINT, &interrupt_before_, nullptr);
  ::sigaction(SIGTERM, &terminate_before_, nullptr);
}

bool Interruption::wanted() const { return caught_signal != 0; }

int Interruption::exitStatus() const { return 128 + caught_signal; }

}  // namespace lstm_planner
