#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "lstm_planner/grid/bit_rows.hpp"
#include "support/case_name.hpp"

namespace lstm_planner::test_bit_rows {
namespace {

/// Bits in a plain array.
struct Plain {
  int columns;
  int rows;
  std::vector<char> bits;
  bool at(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns && row < rows &&
           bits[static_cast<std::size_t>(row * columns + column)] != 0;
  }
};

Plain randomBits(int columns, int rows, std::mt19937* random) {
  Plain plain{columns, rows, std::vector<char>(static_cast<std::size_t>(columns * rows))};
  for (char& bit : plain.bits) bit = (*random)() % 3 == 0 ? 1 : 0;
  return plain;
}

BitRows toRows(const Plain& plain) {
  BitRows rows(plain.columns, plain.rows);
  for (int row = 0; row < plain.rows; ++row) {
    for (int column = 0; column < plain.columns; ++column) {
      if (plain.at(column, row)) rows.set(column, row);
    }
  }
  return rows;
}

class BitRowsOfWidth : public ::testing::TestWithParam<int> {};

TEST_P(BitRowsOfWidth, ShowsNeighboursFromAnyColumnOnAndNothingOutside) {
  std::mt19937 random(1);
  const Plain plain = randomBits(GetParam(), 3, &random);
  const BitRows rows = toRows(plain);
  for (int row = 0; row < plain.rows; ++row) {
    for (int column = -64; column <= plain.columns; ++column) {
      const std::uint64_t bits = rows.from(column, row);
      for (int i = 0; i < 64; ++i) {
        ASSERT_EQ((bits >> i & 1) != 0, plain.at(column + i, row)) << column << " + " << i << ", row " << row;
      }
    }
  }
}

TEST_P(BitRowsOfWidth, MovesAsAPlainArrayDoes) {
  std::mt19937 random(2);
  const Plain plain = randomBits(GetParam(), 9, &random);
  for (const int left : {0, 1, -1, 4, -7, 63, -64, 65, GetParam() - 1, 1 - GetParam(), GetParam(), 1000}) {
    for (const int down : {0, 2, -3, 8, -9}) {
      BitRows rows = toRows(plain);
      rows.move(left, down);
      for (int row = 0; row < plain.rows; ++row) {
        for (int column = 0; column < plain.columns; ++column) {
          ASSERT_EQ(rows.test(column, row), plain.at(column + left, row + down))
              << left << " left, " << down << " down: " << column << " " << row;
        }
        ASSERT_EQ(rows.from(plain.columns, row), 0u) << "nothing outside";
      }
    }
  }
}

TEST(BitRows, SetsAndResetsOneBit) {
  BitRows rows(70, 2);
  rows.set(65, 1);
  EXPECT_TRUE(rows.test(65, 1));
  EXPECT_FALSE(rows.test(65, 0));
  rows.reset(65, 1);
  EXPECT_EQ(rows.from(60, 1), 0u);
}

INSTANTIATE_TEST_SUITE_P(Widths, BitRowsOfWidth, ::testing::Values(63, 64, 65, 100, 128, 130), test::caseName("Bits"));

}  // namespace
}  // namespace lstm_planner::test_bit_rows
