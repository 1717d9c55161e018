#include "tools/option_text.hpp"

#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <type_traits>

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

template <typename Number>
Number numberOf(const std::string& name, const std::string& text, Range range) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Number number{};
  stream >> std::noskipws >> number;
  const bool is_number = !stream.fail() && stream.peek() == std::istringstream::traits_type::eof();
  // A stream takes -1 for the greatest of all numbers without a sign.
  const bool is_wrapped = std::is_unsigned_v<Number> && text.find('-') != std::string::npos;
  if (is_number && !is_wrapped && range.contains(static_cast<double>(number))) return number;
  const bool quoted = text.find_first_not_of("+-.0123456789e") != std::string::npos || text.empty();
  throw std::invalid_argument(name + " is " + (quoted ? "'" + text + "'" : text) + ", expected a " +
                              (std::is_integral_v<Number> ? "whole " : "") + "number in " + toText(range));
}

template int numberOf(const std::string&, const std::string&, Range);
template long numberOf(const std::string&, const std::string&, Range);
template unsigned long numberOf(const std::string&, const std::string&, Range);
template double numberOf(const std::string&, const std::string&, Range);

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
