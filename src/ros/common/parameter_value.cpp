#include "ros/common/parameter_value.hpp"

#include <cmath>
#include <limits>
#include <sstream>

namespace lstm_planner {
namespace {

using XmlRpc::XmlRpcValue;

/// With as many digits as it takes to read the same number again.
std::string textOfNumber(double number) {
  for (int digits = std::numeric_limits<double>::digits10;; ++digits) {
    std::ostringstream text;
    text.precision(digits);
    text << number;
    double again = 0.0;
    std::istringstream(text.str()) >> again;
    if (again == number || digits == std::numeric_limits<double>::max_digits10) return text.str();
  }
}

std::optional<std::string> textOfList(XmlRpcValue list) {
  std::string text = "[";
  for (int i = 0; i < list.size(); ++i) {
    const auto entry = asText(list[i]);
    if (!entry) return std::nullopt;
    text += (i > 0 ? ", " : "") + *entry;
  }
  return text + "]";
}

}  // namespace

std::optional<double> asNumber(XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeDouble:
      return static_cast<double&>(value);
    case XmlRpcValue::TypeInt:
      return static_cast<int&>(value);
    case XmlRpcValue::TypeString: {
      const auto numbers = asNumbers(value);
      return numbers && numbers->size() == 1 ? std::optional(numbers->front()) : std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

std::optional<std::vector<double>> asNumbers(XmlRpcValue value) {
  std::vector<double> numbers;
  if (value.getType() == XmlRpcValue::TypeString) {
    std::istringstream text(static_cast<std::string&>(value));
    while (!(text >> std::ws).eof()) {
      double number = 0.0;
      if (!(text >> number)) return std::nullopt;  // also where the text ends within a number
      numbers.push_back(number);
    }
  } else if (value.getType() == XmlRpcValue::TypeArray) {
    for (int i = 0; i < value.size(); ++i) {
      const auto number = asNumber(value[i]);
      if (!number) return std::nullopt;
      numbers.push_back(*number);
    }
  } else {
    return std::nullopt;
  }
  return numbers;
}

std::optional<int> asWholeNumber(XmlRpcValue value) {
  const auto number = asNumber(value);
  if (!number || *number != std::floor(*number)) return std::nullopt;
  if (std::abs(*number) > std::numeric_limits<int>::max()) return std::nullopt;
  return static_cast<int>(*number);
}

std::optional<bool> asTruth(XmlRpcValue value) {
  if (value.getType() == XmlRpcValue::TypeBoolean) return static_cast<bool&>(value);
  const std::string text = asText(value).value_or("");
  if (text != "true" && text != "false") return std::nullopt;
  return text == "true";
}

std::optional<std::string> asText(XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeString:
      return static_cast<std::string&>(value);
    case XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int&>(value));
    case XmlRpcValue::TypeDouble:
      return textOfNumber(static_cast<double&>(value));
    case XmlRpcValue::TypeArray:
      return textOfList(value);
    default:
      return std::nullopt;
  }
}

}  // namespace lstm_planner
