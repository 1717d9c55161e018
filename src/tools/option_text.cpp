#include "tools/option_text.hpp"

#include <cmath>
#include <locale>
#include <sstream>

namespace lstm_planner {

std::string toText(double number) {
  constexpr double kReadable = 1e12;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  if (std::abs(number) <= kReadable && number == std::round(number)) {
    text << static_cast<long long>(number);
  } else {
    text << number;
  }
  return text.str();
}

std::string toText(Range range) { return "[" + toText(range.least) + ", " + toText(range.most) + "]"; }

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
