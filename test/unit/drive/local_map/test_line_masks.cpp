#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/local_map/line_masks.hpp"

namespace lstm_planner::test_line_masks {
namespace {

TEST(LineMasks, CoverWhatIsNearerToTheLineThanTheRadius) {
  constexpr double kRadius = 3.3;
  constexpr int kLongest = 7;
  LineMasks masks(kLongest);
  masks.setRadius(kRadius);
  ASSERT_EQ(masks.margin(), 3);
  for (int rows = 0; rows <= kLongest; ++rows) {
    for (int columns = -kLongest; columns <= kLongest; ++columns) {
      const int left = std::min(0, columns) - masks.margin();
      for (int y = -masks.margin(); y <= rows + masks.margin(); ++y) {
        for (int x = left; x <= left + 20; ++x) {
          // The least distance from points along the line, a thousandth of it apart.
          double nearest = 1e9;
          for (double share = 0.0; share < 1.0005; share += 0.001) {
            nearest = std::min(nearest, std::hypot(x - share * columns, y - share * rows));
          }
          const bool covered = (masks.mask(columns, rows)[y + masks.margin()] >> (x - left) & 1) != 0;
          if (std::abs(nearest - kRadius) > 1e-4) {
            ASSERT_EQ(covered, nearest < kRadius) << columns << " " << rows << ": " << x << " " << y;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_line_masks
