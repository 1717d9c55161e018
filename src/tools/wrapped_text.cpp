#include "tools/wrapped_text.hpp"

#include <sstream>

namespace lstm_planner {

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent, std::size_t used) {
  std::istringstream words(text);
  std::string result;
  std::string word;
  bool is_first = true;  // of its line
  while (words >> word) {
    if (!is_first && used + 1 + word.size() > width) {
      result += "\n" + std::string(indent, ' ');
      used = indent;
      is_first = true;
    }
    result += (is_first ? "" : " ") + word;
    used += (is_first ? 0 : 1) + word.size();
    is_first = false;
  }
  return result;
}

}  // namespace lstm_planner
