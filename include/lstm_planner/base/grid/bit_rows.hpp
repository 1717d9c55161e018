#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lstm_planner {

/// A rectangle of bits, row by row, of which up to 64 neighbours in a row can be looked at at once.
class BitRows {
 public:
  BitRows(int columns, int rows);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  void clear();

  /// Both inside.
  bool test(int column, int row) const { return (words_[wordOf(column, row)] >> (column & 63) & 1) != 0; }
  void set(int column, int row) { words_[wordOf(column, row)] |= std::uint64_t{1} << (column & 63); }
  void reset(int column, int row) { words_[wordOf(column, row)] &= ~(std::uint64_t{1} << (column & 63)); }

  /// The bits of a row from `column` on, the lowest first. `column` may be anything from -64 to columns(), `row`
  /// anything inside; what is outside is 0.
  std::uint64_t from(int column, int row) const {
    const std::size_t word = wordOf(column, row);
    const int shift = column & 63;
    return words_[word] >> shift | words_[word + 1] << 1 << (63 - shift);
  }

  /// Moves all bits by so many columns to the left and rows down; what leaves is lost, what comes in is 0.
  void move(int left, int down);

 private:
  /// Each row is followed by an empty word, and so is what comes before the first: from() need not look where it is.
  std::size_t wordOf(int column, int row) const {
    return static_cast<std::size_t>(row) * stride_ + static_cast<std::size_t>((column >> 6) + 1);
  }

  int columns_;
  int rows_;
  std::size_t stride_;  ///< words a row
  std::vector<std::uint64_t> words_;
};

/// The lowest `count` bits, 1 to 64 of them.
inline std::uint64_t lowestBits(int count) { return ~std::uint64_t{0} >> (64 - count); }

/// Index of the lowest and the highest of the bits, of which there must be one.
inline int lowestBit(std::uint64_t bits) { return __builtin_ctzll(bits); }
inline int highestBit(std::uint64_t bits) { return 63 - __builtin_clzll(bits); }

}  // namespace lstm_planner
