#pragma once

#include <csignal>

namespace lstm_planner {

/// Takes Ctrl-C (SIGINT) and SIGTERM as the wish to end soon, while the object lives; the second of them, whichever,
/// ends the program at once. One object at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// On any rank: several agree, and each has to ask.
  bool wanted() const;
  /// What a program that ended by the signal returns: 130 after Ctrl-C.
  int exitStatus() const;

 private:
  struct sigaction interrupt_before_ {};
  struct sigaction terminate_before_ {};
};

}  // namespace lstm_planner
