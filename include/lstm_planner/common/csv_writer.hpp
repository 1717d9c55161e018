#pragma once

#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <type_traits>

namespace lstm_planner {

/// Writes a table as CSV (RFC 4180, but lines end in a line feed): a field with a separator, a quote or a line break in
/// it is quoted. A number that is not finite is an empty field; bools are 0 and 1.
class CsvWriter {
 public:
  /// Significant digits of numbers.
  enum class Digits {
    kSix,
    kExact  ///< as many as it takes to read the same number again
  };

  /// `out` must outlive the writer.
  explicit CsvWriter(std::ostream* out, Digits digits = Digits::kSix, char separator = ',')
      : out_(*out), digits_(digits), separator_(separator) {}

  /// The next fields of the row.
  template <typename... Values>
  void add(const Values&... values) {
    (put(values), ...);
  }
  template <typename Values>
  void addAll(const Values& values) {
    for (const auto& value : values) put(value);
  }
  /// With so many decimals.
  void addFixed(double number, int decimals) {
    const std::ios_base::fmtflags flags = out_.setf(std::ios_base::fixed, std::ios_base::floatfield);
    putFinite(number, decimals);
    out_.flags(flags);
  }

  void endRow() {
    out_ << '\n';
    at_start_ = true;
  }

  /// A whole row.
  template <typename... Values>
  void row(const Values&... values) {
    add(values...);
    endRow();
  }

 private:
  template <typename Value>
  void put(const Value& value) {
    if constexpr (std::is_floating_point_v<Value>) {
      putFinite(value, digits_ == Digits::kExact ? std::numeric_limits<Value>::max_digits10 : 6);
    } else if constexpr (std::is_arithmetic_v<Value>) {
      startField();
      out_ << value;
    } else {
      putText(value);
    }
  }

  template <typename Number>
  void putFinite(Number number, int precision) {
    startField();
    out_.precision(precision);
    if (std::isfinite(number)) out_ << number;
  }

  void putText(const std::string& text) {
    startField();
    if (text.find_first_of(std::string("\"\r\n") + separator_) == std::string::npos) {
      out_ << text;
      return;
    }
    out_ << '"';
    for (const char letter : text) out_ << (letter == '"' ? "\"\"" : std::string(1, letter));
    out_ << '"';
  }

  void startField() {
    if (!at_start_) out_ << separator_;
    at_start_ = false;
  }

  std::ostream& out_;
  Digits digits_;
  char separator_;
  bool at_start_ = true;
};

}  // namespace lstm_planner
