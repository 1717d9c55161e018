#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lstm_planner {

/// A rectangle of bits, stored row by row. Up to 64 neighbouring bits of a row can be read at once.
class BitRows {
 public:
  BitRows(int columns, int rows);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  void clear();

  /// Column and row must be inside.
  bool test(int column, int row) const { return (words_[wordOf(column, row)] >> (column & 63) & 1) != 0; }
  void set(int column, int row) { words_[wordOf(column, row)] |= std::uint64_t{1} << (column & 63); }
  void reset(int column, int row) { words_[wordOf(column, row)] &= ~(std::uint64_t{1} << (column & 63)); }

  /// 64 bits of a row, the bit at `column` in the lowest place. `column` must be in -64 .. columns(), `row` must be
  /// inside; bits outside are 0.
  std::uint64_t from(int column, int row) const {
    const std::size_t word = wordOf(column, row);
    const int shift = column & 63;
    return words_[word] >> shift | words_[word + 1] << 1 << (63 - shift);
  }

  /// Shifts all bits to the left and down by so many columns and rows. Bits that leave are lost; new bits are 0.
  void move(int left, int down);

 private:
  /// An empty word stands before the first row and after each row, so that from() needs no check of the borders.
  std::size_t wordOf(int column, int row) const {
    return static_cast<std::size_t>(row) * stride_ + static_cast<std::size_t>((column >> 6) + 1);
  }

  int columns_;
  int rows_;
  std::size_t stride_;  ///< words a row
  std::vector<std::uint64_t> words_;
};

/// The lowest `count` bits set; `count` in 1 .. 64.
inline std::uint64_t lowestBits(int count) { return ~std::uint64_t{0} >> (64 - count); }

/// Index of the lowest bit that is set. At least one must be set.
inline int lowestBit(std::uint64_t bits) { return __builtin_ctzll(bits); }

}  // namespace lstm_planner
