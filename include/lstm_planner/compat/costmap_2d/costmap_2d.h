#pragma once

#include <mutex>
#include <vector>

namespace costmap_2d {

/// The part of costmap_2d::Costmap2D that the plugins read, for distributions that do not have costmap_2d. It has no
/// layers: unless somebody writes into it, it has no cells, and no obstacles.
class Costmap2D {
 public:
  using mutex_t = std::recursive_mutex;
  mutex_t* getMutex() { return &mutex_; }

  /// All cells are free afterwards.
  void resizeMap(unsigned int size_x, unsigned int size_y, double resolution, double origin_x, double origin_y) {
    size_x_ = size_x;
    size_y_ = size_y;
    resolution_ = resolution;
    origin_x_ = origin_x;
    origin_y_ = origin_y;
    costs_.assign(static_cast<std::size_t>(size_x) * size_y, 0);
  }
  void setCost(unsigned int mx, unsigned int my, unsigned char cost) { costs_.at(mx + my * size_x_) = cost; }

  unsigned char* getCharMap() const { return costs_.data(); }
  unsigned int getSizeInCellsX() const { return size_x_; }
  unsigned int getSizeInCellsY() const { return size_y_; }
  double getResolution() const { return resolution_; }
  double getOriginX() const { return origin_x_; }
  double getOriginY() const { return origin_y_; }

 private:
  mutex_t mutex_;
  mutable std::vector<unsigned char> costs_;
  unsigned int size_x_ = 0;
  unsigned int size_y_ = 0;
  double resolution_ = 0.05;  ///< m
  double origin_x_ = 0.0;     ///< m
  double origin_y_ = 0.0;     ///< m
};

}  // namespace costmap_2d
