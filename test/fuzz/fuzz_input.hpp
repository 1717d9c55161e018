#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

namespace lstm_planner::fuzz {

/// Takes values from an input's bytes, from front to back; zeros when they are used up. Equal inputs give equal values
/// on every machine.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  bool empty() const { return next_ == end_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - next_); }

  std::uint8_t byte() { return empty() ? std::uint8_t{0} : *next_++; }
  bool flag() { return (byte() & 1) != 0; }

  /// From `lowest` to `highest`, at most 2^32 values.
  std::int64_t integer(std::int64_t lowest, std::int64_t highest) {
    const auto values = static_cast<std::uint64_t>(highest - lowest) + 1;
    std::uint64_t bits = byte();
    for (std::uint64_t reach = 256; reach < values; reach *= 256) bits = bits * 256 + byte();
    return lowest + static_cast<std::int64_t>(bits % values);
  }

  template <typename Value, std::size_t count>
  const Value& pick(const std::array<Value, count>& values) {
    return values[static_cast<std::size_t>(byte()) % count];
  }

  template <typename Value>
  Value raw() {
    Value value{};
    std::array<std::uint8_t, sizeof(Value)> bytes{};
    for (std::uint8_t& one : bytes) one = byte();
    std::memcpy(&value, bytes.data(), sizeof(Value));
    return value;
  }

  /// Any double: plain ones often, the ends of ranges and what is not finite sometimes, any bits at all at times.
  double number() {
    const std::uint8_t kind = byte();
    if (kind < 160) return static_cast<double>(raw<std::int16_t>()) / 1000.0;
    if (kind < 208) return special();
    if (kind < 232) return static_cast<double>(raw<std::int32_t>());
    return raw<double>();
  }

  /// From `lowest` to `highest`.
  double numberIn(double lowest, double highest) {
    return lowest + (highest - lowest) * static_cast<double>(raw<std::uint16_t>()) / 65535.0;
  }

  /// At most `longest` bytes.
  std::string text(std::size_t longest) {
    const auto length = static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(longest)));
    std::string letters;
    while (letters.size() < length && !empty()) letters += static_cast<char>(byte());
    return letters;
  }

  std::string rest() {
    std::string letters(next_, end_);
    next_ = end_;
    return letters;
  }

 private:
  double special() {
    using Limits = std::numeric_limits<double>;
    static constexpr std::array<double, 32> kSpecial = {0.0,
                                                        -0.0,
                                                        1.0,
                                                        -1.0,
                                                        Limits::infinity(),
                                                        -Limits::infinity(),
                                                        Limits::quiet_NaN(),
                                                        Limits::max(),
                                                        Limits::lowest(),
                                                        Limits::min(),
                                                        Limits::denorm_min(),
                                                        Limits::epsilon(),
                                                        1e-9,
                                                        1e-45,
                                                        1e10,
                                                        -1e10,
                                                        1e100,
                                                        1e300,
                                                        -1e300,
                                                        32767.0,
                                                        65535.0,
                                                        65.53,
                                                        2147483647.0,
                                                        -2147483648.0,
                                                        2147483648.0,
                                                        4294967296.0,
                                                        9223372036854775807.0,
                                                        3.14159265358979312,
                                                        -3.14159265358979312,
                                                        6.28318530717958623,
                                                        1e7,
                                                        -1e7};
    return pick(kSpecial);
  }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

}  // namespace lstm_planner::fuzz
