#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace lstm_planner {

/// The lowest `count` bits set; `count` in 1 .. 64.
inline std::uint64_t lowestBits(int count) { return ~std::uint64_t{0} >> (64 - count); }

/// Index of the lowest bit that is set. At least one must be set.
inline int lowestBit(std::uint64_t bits) { return __builtin_ctzll(bits); }

/// A rectangle of bits, stored row by row. Up to 64 neighbouring bits of a row can be read at once.
class BitRows {
 public:
  BitRows(int columns, int rows)
      : columns_(columns), rows_(rows), stride_(static_cast<std::size_t>((columns + 63) / 64) + 1) {
    words_.resize(stride_ * static_cast<std::size_t>(rows) + 2);
  }

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  void clear() { std::fill(words_.begin(), words_.end(), std::uint64_t{0}); }

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
  void move(int left, int down) {
    if (std::abs(left) >= columns_ || std::abs(down) >= rows_) {
      return clear();
    }
    const int words = (columns_ + 63) / 64;
    const std::uint64_t last_mask = lowestBits((columns_ - 1) % 64 + 1);
    // In such an order that no word is overwritten before it was moved.
    for (int i = 0; i < rows_; ++i) {
      const int row = down >= 0 ? i : rows_ - 1 - i;
      const int source = row + down;
      for (int j = 0; j < words; ++j) {
        const int word = left >= 0 ? j : words - 1 - j;
        const int column = word * 64 + left;
        const bool inside = source >= 0 && source < rows_ && column > -64 && column < columns_;
        const std::uint64_t bits = inside ? from(column, source) : 0;
        words_[wordOf(word * 64, row)] = word == words - 1 ? bits & last_mask : bits;
      }
    }
  }

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

}  // namespace lstm_planner
