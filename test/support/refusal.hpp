#pragma once

#include <exception>
#include <string>

namespace lstm_planner::test {

/// Why `work` is refused: the text of an exception of this type; empty when it is not. Other exceptions get out.
template <typename Error = std::exception, typename Work>
std::string refusalOf(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace lstm_planner::test
