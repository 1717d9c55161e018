#pragma once

#include <memory>

#if __has_include(<boost/timer/progress_display.hpp>)
#include <boost/timer/progress_display.hpp>
#else
#include <boost/progress.hpp>
#endif

namespace lstm_planner {

/// A progress bar on the terminal; silent where standard error is not one, and but for the first of several ranks.
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

}  // namespace lstm_planner
