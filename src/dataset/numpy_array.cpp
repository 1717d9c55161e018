#include "dataset/numpy_array.hpp"

#include <cstdint>
#include <stdexcept>

namespace lstm_planner {

namespace {

template <typename Number>
constexpr const char* kTypeOf = nullptr;
template <>
constexpr const char* kTypeOf<double> = "<f8";
template <>
constexpr const char* kTypeOf<float> = "<f4";
template <>
constexpr const char* kTypeOf<std::int64_t> = "<i8";

/// The format's magic, version and the dictionary that describes the array, padded to a multiple of 64 bytes.
std::string headerOf(const char* type, const std::string& shape) {
  std::string dictionary = std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
  constexpr std::size_t kPreamble = 10;
  constexpr std::size_t kAlignment = 64;
  const std::size_t used = kPreamble + dictionary.size() + 1;
  dictionary += std::string((kAlignment - used % kAlignment) % kAlignment, ' ') + '\n';
  const std::size_t length = dictionary.size();
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(length & 0xff);
  header += static_cast<char>(length >> 8);
  return header + dictionary;
}

}  // namespace

template <typename Number>
std::string toNpy(const std::vector<Number>& numbers, std::size_t row_length) {
  if (row_length > 0 && numbers.size() % row_length != 0) {
    throw std::invalid_argument(std::to_string(numbers.size()) + " numbers are no rows of " +
                                std::to_string(row_length));
  }
  const std::string shape =
      row_length == 0 ? "(" + std::to_string(numbers.size()) + ",)"
                      : "(" + std::to_string(numbers.size() / row_length) + ", " + std::to_string(row_length) + ")";
  std::string file = headerOf(kTypeOf<Number>, shape);
  return file.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

template std::string toNpy(const std::vector<double>&, std::size_t);
template std::string toNpy(const std::vector<float>&, std::size_t);
template std::string toNpy(const std::vector<std::int64_t>&, std::size_t);

}  // namespace lstm_planner
