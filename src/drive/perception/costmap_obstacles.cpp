#include "lstm_planner/drive/perception/costmap_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lstm_planner {

namespace {

// As in costmap_2d/cost_values.h.
constexpr unsigned char kInscribed = 253;
constexpr unsigned char kLethal = 254;

constexpr double kPointSpacing = 0.06;  // m between the points of a large cell, at most
constexpr double kNear = 0.5;           // m within which obstacles count wherever they are
constexpr int kWord = 64;               // cells

/// Whether one of so many costs is an obstacle's; without a jump, for compilers to do many at once.
bool isAnyOccupied(const unsigned char* costs, int count) {
  unsigned char any = 0;
  for (int i = 0; i < count; ++i) {
    any = static_cast<unsigned char>(any | static_cast<unsigned char>(costs[i] == kInscribed) |
                                     static_cast<unsigned char>(costs[i] == kLethal));
  }
  return any != 0;
}

/// A bit for each of the costs that is `cost`.
std::uint64_t bitsOf(const unsigned char* costs, int count, unsigned char cost) {
  std::uint64_t bits = 0;
  for (int i = 0; i < count; ++i) bits |= static_cast<std::uint64_t>(costs[i] == cost) << i;
  return bits;
}

}  // namespace

void CostmapObstacles::find(const CostGrid& grid, const Pose2& base, const std::vector<Point2>& returns, double reach,
                            std::vector<Point2>* obstacles) {
  obstacles->clear();
  if (grid.costs == nullptr || !(grid.resolution > 0.0) || !isFinite(base)) return;
  // What is inscribed may have its reason a little farther away.
  const double far = reach + grid.inscribed_radius + 2.0 * grid.resolution;
  const auto index = [&](double position, double origin, int count) {
    return static_cast<int>(
        std::clamp(std::floor((position - origin) / grid.resolution), 0.0, static_cast<double>(count)));
  };
  window_.first_column = index(base.x - far, grid.origin.x, grid.columns);
  window_.first_row = index(base.y - far, grid.origin.y, grid.rows);
  window_.columns = index(base.x + far + grid.resolution, grid.origin.x, grid.columns) - window_.first_column;
  window_.rows = index(base.y + far + grid.resolution, grid.origin.y, grid.rows) - window_.first_row;
  window_.words = (window_.columns + kWord - 1) / kWord;
  if (window_.columns <= 0 || window_.rows <= 0 || !collect(grid)) return;
  addUnexplained(grid);
  showReturns(grid, base, returns);
  addPoints(grid, base, reach, obstacles);
}

/// Whether there is anything.
bool CostmapObstacles::collect(const CostGrid& grid) {
  const auto words = static_cast<std::size_t>(window_.words) * static_cast<std::size_t>(window_.rows);
  occupied_.assign(words, 0);
  inscribed_.assign(words, 0);
  bool any = false;
  std::size_t word = 0;
  for (int row = 0; row < window_.rows; ++row) {
    const unsigned char* const costs =
        grid.costs + static_cast<std::ptrdiff_t>(window_.first_row + row) * grid.columns + window_.first_column;
    for (int first = 0; first < window_.columns; first += kWord, ++word) {
      const int count = std::min(kWord, window_.columns - first);
      if (!isAnyOccupied(costs + first, count)) continue;
      occupied_[word] = bitsOf(costs + first, count, kLethal);
      inscribed_[word] = bitsOf(costs + first, count, kInscribed);
      any = true;
    }
  }
  return any;
}

void CostmapObstacles::addUnexplained(const CostGrid& grid) {
  constexpr int kWidest = 31;
  const int around = std::min(kWidest, static_cast<int>(std::ceil(grid.inscribed_radius / grid.resolution)) + 1);
  dilate(occupied_, around, &other_);
  for (std::size_t word = 0; word < occupied_.size(); ++word) occupied_[word] |= inscribed_[word] & ~other_[word];
}

void CostmapObstacles::dilate(const Bits& bits, int around, Bits* dilated) {
  const auto stride = static_cast<std::size_t>(window_.words);
  wide_.assign(bits.size(), 0);
  for (std::size_t word = 0; word < bits.size(); ++word) {
    const std::uint64_t here = bits[word];
    if (here == 0) continue;
    const bool has_left = word % stride > 0;
    const bool has_right = word % stride + 1 < stride;
    wide_[word] |= here;
    for (int aside = 1; aside <= around; ++aside) {
      wide_[word] |= here << aside | here >> aside;
      if (has_left) wide_[word - 1] |= here << (kWord - aside);
      if (has_right) wide_[word + 1] |= here >> (kWord - aside);
    }
  }
  dilated->assign(bits.size(), 0);
  for (int row = 0; row < window_.rows; ++row) {
    const int last = std::min(window_.rows - 1, row + around);
    for (int other = std::max(0, row - around); other <= last; ++other) {
      std::uint64_t* const to = dilated->data() + static_cast<std::size_t>(row) * stride;
      const std::uint64_t* const from = wide_.data() + static_cast<std::size_t>(other) * stride;
      for (std::size_t word = 0; word < stride; ++word) to[word] |= from[word];
    }
  }
}

void CostmapObstacles::showReturns(const CostGrid& grid, const Pose2& base, const std::vector<Point2>& returns) {
  other_.assign(occupied_.size(), 0);
  const double scale = 1.0 / grid.resolution;
  const double c = std::cos(base.yaw) * scale;
  const double s = std::sin(base.yaw) * scale;
  const double x = (base.x - grid.origin.x) * scale - window_.first_column;
  const double y = (base.y - grid.origin.y) * scale - window_.first_row;
  for (const Point2& place : returns) {
    const double column = x + c * place.x - s * place.y;
    const double row = y + s * place.x + c * place.y;
    if (!(column >= 0.0 && row >= 0.0 && column < window_.columns && row < window_.rows)) continue;
    const int at = static_cast<int>(column);
    other_[static_cast<std::size_t>(static_cast<int>(row) * window_.words + at / kWord)] |= std::uint64_t{1}
                                                                                            << at % kWord;
  }
  dilate(other_, 1, &shown_);
}

/// Of a word of cells, those with obstacles on all four sides.
std::uint64_t CostmapObstacles::surrounded(int row, int word) const {
  if (row == 0 || row + 1 == window_.rows) return 0;
  const std::uint64_t* const here = occupied_.data() + static_cast<std::ptrdiff_t>(row * window_.words + word);
  const std::uint64_t left = here[0] << 1 | (word > 0 ? here[-1] >> (kWord - 1) : 0);
  const std::uint64_t right = here[0] >> 1 | (word + 1 < window_.words ? here[1] << (kWord - 1) : 0);
  return left & right & here[-window_.words] & here[window_.words];
}

void CostmapObstacles::addPoints(const CostGrid& grid, const Pose2& base, double reach,
                                 std::vector<Point2>* obstacles) const {
  const int parts = static_cast<int>(std::ceil(grid.resolution / kPointSpacing));
  const double part = grid.resolution / parts;
  const double half = 0.5 * grid.resolution;
  const double c = std::cos(base.yaw);
  const double s = std::sin(base.yaw);
  for (int row = 0; row < window_.rows; ++row) {
    const double bottom = grid.origin.y + (window_.first_row + row) * grid.resolution - base.y;
    for (int word = 0; word < window_.words; ++word) {
      const auto i = static_cast<std::size_t>(row * window_.words + word);
      const std::uint64_t inside = occupied_[i] == 0 ? 0 : surrounded(row, word);
      for (std::uint64_t bits = occupied_[i] & ~shown_[i]; bits != 0; bits &= bits - 1) {
        const int column = word * kWord + __builtin_ctzll(bits);
        const double left = grid.origin.x + (window_.first_column + column) * grid.resolution - base.x;
        const double squared = (left + half) * (left + half) + (bottom + half) * (bottom + half);
        const bool is_inside = (inside >> (column % kWord) & 1) != 0;
        if (squared > reach * reach || (is_inside && squared > kNear * kNear)) continue;
        for (int k = 0; k < parts * parts; ++k) {
          const double x = left + (k % parts + 0.5) * part;
          const double y = bottom + (k / parts + 0.5) * part;
          obstacles->push_back({c * x + s * y, c * y - s * x});
        }
      }
    }
  }
}

}  // namespace lstm_planner
