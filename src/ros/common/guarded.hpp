#pragma once

#include <exception>
#include <string>

namespace lstm_planner {

/// What work() returns; what it throws goes to refuse(why) instead, whose answer it must be then. So no exception
/// leaves a plugin.
template <typename Work, typename Refuse>
auto guarded(const Work& work, const Refuse& refuse) -> decltype(work()) {
  try {
    return work();
  } catch (const std::exception& error) {
    return refuse(error.what());
  } catch (...) {
    return refuse("the reason is not known");
  }
}

}  // namespace lstm_planner
