#pragma once

#include <exception>
#include <stdexcept>
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

/// Whether validate() refuses these parameters once `change` has made one of them wrong. Refuses nothing unchanged.
template <typename Parameters>
bool isRefused(Parameters parameters, void (*change)(Parameters*)) {
  change(&parameters);
  return !refusalOf<std::invalid_argument>([&] { validate(parameters); }).empty();
}

}  // namespace lstm_planner::test
