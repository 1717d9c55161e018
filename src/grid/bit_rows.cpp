#include "lstm_planner/grid/bit_rows.hpp"

#include <algorithm>
#include <cstdlib>

namespace lstm_planner {

BitRows::BitRows(int columns, int rows)
    : columns_(columns), rows_(rows), stride_(static_cast<std::size_t>((columns + 63) / 64) + 1) {
  words_.resize(stride_ * static_cast<std::size_t>(rows) + 2);
}

void BitRows::clear() { std::fill(words_.begin(), words_.end(), std::uint64_t{0}); }

void BitRows::move(int left, int down) {
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

}  // namespace lstm_planner
