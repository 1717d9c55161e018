#include "lstm_planner/agent/obstacle_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

namespace {

/// Places that are kept as blocked; the oldest gives way.
constexpr std::size_t kMostBlocks = 32;

/// A square is seen through when the beams towards it and beside it end this much behind it, m: noise and beams that
/// graze a wall must not take it away.
constexpr double kBehind = 0.1;
constexpr long kBeamsBeside = 2;

/// Bits of a judgement.
constexpr std::uint8_t kNothingNear = 0x80;
constexpr std::uint8_t kExitsKnown = 0x40;

double squaredDistanceToLine(const Point2& point, const Point2& from, const Point2& to) {
  const Point2 line{to.x - from.x, to.y - from.y};
  const Point2 off{point.x - from.x, point.y - from.y};
  const double length = line.x * line.x + line.y * line.y;
  const double share = length > 0.0 ? std::clamp((off.x * line.x + off.y * line.y) / length, 0.0, 1.0) : 0.0;
  const double dx = off.x - share * line.x;
  const double dy = off.y - share * line.y;
  return dx * dx + dy * dy;
}

/// The nearest that any of a few neighbouring beams sees; 0 when one of them knows nothing.
float nearestRange(const RangeProfile& profile, long beam) {
  const long last = static_cast<long>(profile.ranges.size()) - 1;
  float nearest = std::numeric_limits<float>::infinity();
  for (long i = std::max(0L, beam - kBeamsBeside); i <= std::min(last, beam + kBeamsBeside); ++i) {
    nearest = std::min(nearest, profile.ranges[static_cast<std::size_t>(i)]);
  }
  return nearest;
}

}  // namespace

ObstacleMemory::ObstacleMemory(const MemoryParameters& parameters, const ShieldParameters& shield)
    : parameters_(parameters),
      side_(static_cast<int>(std::ceil(parameters.width / (kSquares * parameters.resolution)))),
      cell_size_(kSquares * parameters.resolution),
      footprint_radius_(shield.footprint_radius),
      tight_clearance_(shield.tight_clearance),
      tight_radius_(shield.footprint_radius + 0.5 * shield.tight_clearance),
      narrow_radius_(shield.footprint_radius + shield.clearance + 0.5 * parameters.resolution),
      roomy_radius_(std::max(shield.footprint_radius + parameters.comfort, narrow_radius_)),
      near_cells_(static_cast<int>(std::ceil(roomy_radius_ / cell_size_))) {
  const auto cells = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  occupied_.resize(cells);
  judged_.resize(cells);
  exits_.resize(cells);
  blocks_.reserve(kMostBlocks);
  forget();
}

void ObstacleMemory::forget() {
  placed_ = false;
  std::fill(occupied_.begin(), occupied_.end(), std::uint16_t{0});
  std::fill(judged_.begin(), judged_.end(), kUnknown);
  blocks_.clear();
}

void ObstacleMemory::look(const Situation& situation) {
  if (!isFinite(situation.pose)) {
    return;
  }
  moveWindow(situation.pose);
  forgetSeenThrough(situation);
  const double reach = parameters_.reach;
  for (const Point2& obstacle : situation.obstacles) {
    if (obstacle.x * obstacle.x + obstacle.y * obstacle.y <= reach * reach) {
      set(squareAt(toParentFrame(situation.pose, obstacle)), true);
    }
  }
  // Where the robot stands nothing else can be.
  const Square here = squareAt({situation.pose.x, situation.pose.y});
  const int squares = static_cast<int>(footprint_radius_ / parameters_.resolution);
  for (int row = here.row - squares; row <= here.row + squares; ++row) {
    for (int column = here.column - squares; column <= here.column + squares; ++column) {
      if (distanceBetween(centerOf({column, row}), situation.pose) < 0.9 * footprint_radius_) {
        set({column, row}, false);
      }
    }
  }
}

void ObstacleMemory::block(const Point2& place) {
  if (blocks_.size() == kMostBlocks) {
    outdate(squareAt(blocks_.front()));
    blocks_.erase(blocks_.begin());
  }
  blocks_.push_back(place);
  outdate(squareAt(place));
}

void ObstacleMemory::squeeze(bool on) {
  const double radius = footprint_radius_ + (on ? -0.5 * parameters_.resolution : 0.5 * tight_clearance_);
  if (radius != tight_radius_) {
    tight_radius_ = radius;
    std::fill(judged_.begin(), judged_.end(), kUnknown);
  }
}

int ObstacleMemory::cellAt(const Point2& position) const {
  const int column = static_cast<int>(std::floor(position.x / cell_size_)) - origin_column_;
  const int row = static_cast<int>(std::floor(position.y / cell_size_)) - origin_row_;
  return column < 0 || row < 0 || column >= side_ || row >= side_ ? -1 : row * side_ + column;
}

Point2 ObstacleMemory::centerOf(int cell) const {
  return {(origin_column_ + cell % side_ + 0.5) * cell_size_, (origin_row_ + cell / side_ + 0.5) * cell_size_};
}

ObstacleMemory::Passage ObstacleMemory::passage(int cell) {
  std::uint8_t& judged = judged_[static_cast<std::size_t>(cell)];
  if (judged == kUnknown) {
    judged = judge(cell);
  }
  return static_cast<Passage>(judged >> 4 & 3);
}

Point2 ObstacleMemory::bestPlace(int cell) {
  passage(cell);
  const int square = judged_[static_cast<std::size_t>(cell)] & 0xf;
  return centerOf({(origin_column_ + cell % side_) * kSquares + square % kSquares,
                   (origin_row_ + cell / side_) * kSquares + square / kSquares});
}

std::uint8_t ObstacleMemory::exits(int cell) {
  passage(cell);
  const auto i = static_cast<std::size_t>(cell);
  if ((judged_[i] & kExitsKnown) == 0) {
    exits_[i] = judgeExits(cell);
    judged_[i] |= kExitsKnown;
  }
  return exits_[i];
}

bool ObstacleMemory::isFree(const Point2& from, const Point2& to, Passage passage_wanted) {
  const double wanted = passage_wanted == Passage::kRoomy    ? roomy_radius_
                        : passage_wanted == Passage::kNarrow ? narrow_radius_
                                                             : tight_radius_;
  // The squares round: a way from best place to best place may come this much nearer in between.
  const double radius = wanted - 0.5 * parameters_.resolution;
  const double length = distanceBetween(from, to);
  const int parts = std::max(1, static_cast<int>(std::ceil(length / (2.0 * parameters_.resolution))));
  for (int i = 0; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    const Point2 at{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    const int cell = cellAt(at);
    if (cell < 0) {
      return false;
    }
    passage(cell);
    if ((judged_[static_cast<std::size_t>(cell)] & kNothingNear) == 0 && gap(at) < radius) {
      return false;
    }
  }
  return true;
}

ObstacleMemory::Square ObstacleMemory::squareAt(const Point2& position) const {
  return {static_cast<int>(std::floor(position.x / parameters_.resolution)),
          static_cast<int>(std::floor(position.y / parameters_.resolution))};
}

Point2 ObstacleMemory::centerOf(const Square& square) const {
  return {(square.column + 0.5) * parameters_.resolution, (square.row + 0.5) * parameters_.resolution};
}

void ObstacleMemory::moveWindow(const Pose2& pose) {
  const int column = static_cast<int>(std::floor(pose.x / cell_size_)) - side_ / 2;
  const int row = static_cast<int>(std::floor(pose.y / cell_size_)) - side_ / 2;
  if (placed_ && std::max(std::abs(column - origin_column_), std::abs(row - origin_row_)) <= side_ / 8) {
    return;
  }
  if (placed_) {
    const std::vector<std::uint16_t> before = occupied_;
    std::fill(occupied_.begin(), occupied_.end(), std::uint16_t{0});
    const int right = column - origin_column_;
    const int up = row - origin_row_;
    for (int to_row = std::max(0, -up); to_row < std::min(side_, side_ - up); ++to_row) {
      for (int to_column = std::max(0, -right); to_column < std::min(side_, side_ - right); ++to_column) {
        occupied_[static_cast<std::size_t>(to_row * side_ + to_column)] =
            before[static_cast<std::size_t>((to_row + up) * side_ + to_column + right)];
      }
    }
    std::fill(judged_.begin(), judged_.end(), kUnknown);
  }
  origin_column_ = column;
  origin_row_ = row;
  placed_ = true;
}

void ObstacleMemory::forgetSeenThrough(const Situation& situation) {
  const RangeProfile& profile = situation.profile;
  if (profile.ranges.empty()) {
    return;
  }
  const Point2 scanner = toParentFrame(situation.pose, profile.origin);
  const int reach = static_cast<int>(parameters_.reach / cell_size_);
  const int middle_column = static_cast<int>(std::floor(scanner.x / cell_size_)) - origin_column_;
  const int middle_row = static_cast<int>(std::floor(scanner.y / cell_size_)) - origin_row_;
  for (int row = std::max(0, middle_row - reach); row <= std::min(side_ - 1, middle_row + reach); ++row) {
    for (int column = std::max(0, middle_column - reach); column <= std::min(side_ - 1, middle_column + reach);
         ++column) {
      const std::uint16_t mask = occupied_[static_cast<std::size_t>(row * side_ + column)];
      for (int bit = 0; mask >> bit != 0; ++bit) {
        if ((mask >> bit & 1) == 0) {
          continue;
        }
        const Square square{(origin_column_ + column) * kSquares + bit % kSquares,
                            (origin_row_ + row) * kSquares + bit / kSquares};
        const Point2 center = centerOf(square);
        const long beam = profile.beamTowards(directionTo(scanner, center) - situation.pose.yaw);
        if (beam >= 0 && nearestRange(profile, beam) > distanceBetween(scanner, center) + kBehind) {
          set(square, false);
        }
      }
    }
  }
}

void ObstacleMemory::set(const Square& square, bool occupied) {
  const int cell = cellAt(centerOf(square));
  if (cell < 0) {
    return;
  }
  const int bit = (square.row & (kSquares - 1)) * kSquares + (square.column & (kSquares - 1));
  std::uint16_t& mask = occupied_[static_cast<std::size_t>(cell)];
  const auto changed =
      static_cast<std::uint16_t>(occupied ? mask | 1u << bit : mask & ~(1u << bit));
  if (changed != mask) {
    mask = changed;
    outdate(square);
  }
}

void ObstacleMemory::outdate(const Square& square) {
  const int cell = cellAt(centerOf(square));
  if (cell < 0) {
    return;
  }
  const int column = cell % side_;
  const int row = cell / side_;
  const int reach = near_cells_ + 1;  // the exits depend on the neighbours, too
  for (int r = std::max(0, row - reach); r <= std::min(side_ - 1, row + reach); ++r) {
    const int first = std::max(0, column - reach);
    const int last = std::min(side_ - 1, column + reach);
    std::fill(judged_.begin() + r * side_ + first, judged_.begin() + r * side_ + last + 1, kUnknown);
  }
}

std::uint8_t ObstacleMemory::judge(int cell) const {
  const int column = cell % side_;
  const int row = cell / side_;
  collect(column, row, near_cells_, &nearby_);
  int best_square = kSquares / 2 * kSquares + kSquares / 2;
  if (nearby_.empty()) {
    return static_cast<std::uint8_t>(kNothingNear | static_cast<int>(Passage::kRoomy) << 4 | best_square);
  }
  double best = -1.0;
  for (int square = 0; square < kSquares * kSquares; ++square) {
    const Point2 center = centerOf({(origin_column_ + column) * kSquares + square % kSquares,
                                    (origin_row_ + row) * kSquares + square / kSquares});
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point2& obstacle : nearby_) {
      const double dx = obstacle.x - center.x;
      const double dy = obstacle.y - center.y;
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
    if (nearest > best) {
      best = nearest;
      best_square = square;
    }
  }
  const Passage passage = best < tight_radius_ * tight_radius_     ? Passage::kBlocked
                          : best < narrow_radius_ * narrow_radius_ ? Passage::kTight
                          : best < roomy_radius_ * roomy_radius_   ? Passage::kNarrow
                                                                   : Passage::kRoomy;
  return static_cast<std::uint8_t>(static_cast<int>(passage) << 4 | best_square);
}

std::uint8_t ObstacleMemory::judgeExits(int cell) {
  const int column = cell % side_;
  const int row = cell / side_;
  if (column == 0 || row == 0 || column == side_ - 1 || row == side_ - 1 || passage(cell) == Passage::kBlocked) {
    return 0;
  }
  std::array<int, kGridRayCount> neighbours;
  std::array<bool, kGridRayCount> enters;
  for (std::size_t direction = 0; direction < neighbours.size(); ++direction) {
    neighbours[direction] = cell + kGridRaySteps[direction].row * side_ + kGridRaySteps[direction].column;
    enters[direction] = passage(neighbours[direction]) != Passage::kBlocked;
  }
  collect(column, row, near_cells_ + 1, &nearby_);
  // The squares round: a way from best place to best place may come this much nearer in between.
  const double radius = tight_radius_ - 0.5 * parameters_.resolution;
  const Point2 from = bestPlace(cell);
  std::uint8_t exits = 0;
  for (std::size_t direction = 0; direction < neighbours.size(); ++direction) {
    if (!enters[direction]) {
      continue;
    }
    const Point2 to = bestPlace(neighbours[direction]);
    const bool free = std::none_of(nearby_.begin(), nearby_.end(), [&](const Point2& obstacle) {
      return squaredDistanceToLine(obstacle, from, to) < radius * radius;
    });
    exits = static_cast<std::uint8_t>(exits | (free ? 1u << direction : 0u));
  }
  return exits;
}

void ObstacleMemory::collect(int column, int row, int reach, std::vector<Point2>* squares) const {
  squares->clear();
  for (int r = std::max(0, row - reach); r <= std::min(side_ - 1, row + reach); ++r) {
    for (int c = std::max(0, column - reach); c <= std::min(side_ - 1, column + reach); ++c) {
      const std::uint16_t mask = occupied_[static_cast<std::size_t>(r * side_ + c)];
      for (int bit = 0; mask >> bit != 0; ++bit) {
        if ((mask >> bit & 1) != 0) {
          squares->push_back(centerOf({(origin_column_ + c) * kSquares + bit % kSquares,
                                       (origin_row_ + r) * kSquares + bit / kSquares}));
        }
      }
    }
  }
  const Point2 middle{(origin_column_ + column + 0.5) * cell_size_, (origin_row_ + row + 0.5) * cell_size_};
  for (const Point2& block : blocks_) {
    if (distanceBetween(block, middle) < (reach + 1) * cell_size_) {
      squares->push_back(block);
    }
  }
}

double ObstacleMemory::gap(const Point2& position) const {
  const int cell = cellAt(position);
  collect(cell % side_, cell / side_, near_cells_, &nearby_);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point2& obstacle : nearby_) {
    nearest = std::min(nearest, distanceBetween(position, obstacle));
  }
  return nearest;
}

}  // namespace lstm_planner
