#pragma once

#include <csignal>
#include <memory>

#if __has_include(<boost/timer/progress_display.hpp>)
#include <boost/timer/progress_display.hpp>
#else
#include <boost/progress.hpp>
#endif

namespace lstm_planner {

/// A progress bar on the terminal; silent where standard error is not one.
class Progress {
 public:
#if __has_include(<boost/timer/progress_display.hpp>)
  using Bar = boost::timer::progress_display;
#else
  using Bar = boost::progress_display;
#endif

  Progress();
  void show(double share);  ///< of the whole, in [0, 1]; going back is ignored

 private:
  std::unique_ptr<Bar> bar_;
};

/// Takes Ctrl-C (SIGINT) and SIGTERM as the wish to end soon, while the object lives; the second of them, whichever,
/// ends the program at once. One object at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool wanted() const;
  /// What a program that ended by the signal returns: 130 after Ctrl-C.
  int exitStatus() const;

 private:
  struct sigaction interrupt_before_ {};
  struct sigaction terminate_before_ {};
};

}  // namespace lstm_planner
