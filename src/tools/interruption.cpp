#include "tools/interruption.hpp"

#include "tools/ranks.hpp"

namespace lstm_planner {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void remember(int signal) { caught_signal = signal; }

}  // namespace

Interruption::Interruption() {
  caught_signal = 0;
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, &interrupt_before_);
  ::sigaction(SIGTERM, &action, &terminate_before_);
}

Interruption::~Interruption() {
  ::sigaction(SIGINT, &interrupt_before_, nullptr);
  ::sigaction(SIGTERM, &terminate_before_, nullptr);
}

bool Interruption::wanted() const {
  // A signal that comes while the ranks exchange is asked about the next time.
  const int agreed = largestOfRanks(ranks(), caught_signal);
  if (agreed != 0) caught_signal = agreed;
  return agreed != 0;
}

int Interruption::exitStatus() const { return 128 + caught_signal; }

}  // namespace lstm_planner
