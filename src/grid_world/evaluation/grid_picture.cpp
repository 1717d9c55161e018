#include "lstm_planner/grid_world/evaluation/grid_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "lstm_planner/common/canvas.hpp"
#include "lstm_planner/common/picture_file.hpp"

namespace lstm_planner {
namespace {

constexpr int kPictureSide = 1000;  // pixels of the map's longer side, about
constexpr int kLine = 26;           // pixels a line of text
constexpr double kText = 0.55;

const cv::Scalar kFree(255, 255, 255);  // colours are blue, green, red
const cv::Vec3b kBlocked(90, 90, 90);
const cv::Scalar kInk(20, 20, 20);
const cv::Scalar kGoal(60, 160, 30);
// Told apart by people who are blind to red and green, too.
const std::array<cv::Scalar, 4> kPathColors = {cv::Scalar(0, 94, 213), cv::Scalar(178, 114, 0), cv::Scalar(115, 158, 0),
                                               cv::Scalar(167, 121, 204)};

/// The cells that are drawn: those around everything of interest.
cv::Rect frame(const PassableGrid& grid, const GridPicture& picture) {
  std::vector<CellIndex> cells = {picture.start, picture.goal};
  for (const GridPicture::Path& path : picture.paths) cells.insert(cells.end(), path.cells.begin(), path.cells.end());
  int left = grid.columns(), top = grid.rows(), right = 0, bottom = 0;
  for (const CellIndex& cell : cells) {
    left = std::min(left, cell.column);
    right = std::max(right, cell.column);
    top = std::min(top, cell.row);
    bottom = std::max(bottom, cell.row);
  }
  constexpr int kSmallest = 48;
  const int longest = std::max({right - left, bottom - top, kSmallest});
  const int margin = 4 + longest / 16;
  // Long, thin pictures show little of what is around the path.
  const int extra_columns = std::max(0, longest / 2 - (right - left)) / 2;
  const int extra_rows = std::max(0, longest / 2 - (bottom - top)) / 2;
  const cv::Rect wanted(cv::Point(left - margin - extra_columns, top - margin - extra_rows),
                        cv::Point(right + margin + extra_columns + 1, bottom + margin + extra_rows + 1));
  return wanted & cv::Rect(0, 0, grid.columns(), grid.rows());
}

cv::Mat cellsOf(const PassableGrid& grid, const cv::Rect& frame) {
  cv::Mat cells(frame.height, frame.width, CV_8UC3, kFree);
  for (int row = 0; row < frame.height; ++row) {
    for (int column = 0; column < frame.width; ++column) {
      if (!grid.passable({frame.x + column, frame.y + row})) cells.at<cv::Vec3b>(row, column) = kBlocked;
    }
  }
  return cells;
}

/// The cells of a frame, row 0 at the top.
class GridCanvas : public Canvas {
 public:
  GridCanvas(const PassableGrid& grid, const cv::Rect& frame)
      : Canvas(cellsOf(grid, frame), kPictureSide), frame_(frame) {}

  /// The middle of a cell.
  cv::Point at(CellIndex cell) const {
    return fine((cell.column - frame_.x + 0.5) * scale() - 0.5, (cell.row - frame_.y + 0.5) * scale() - 0.5);
  }

 private:
  cv::Rect frame_;
};

const cv::Scalar& colorOf(std::size_t path) { return kPathColors[path % kPathColors.size()]; }

/// Narrower from path to path, so that those below show at the sides.
int widthOf(std::size_t path, std::size_t paths, double scale) {
  const double widest = std::min(0.8 * scale, 4.0 * static_cast<double>(paths));
  return std::max(1 + static_cast<int>(paths - path), cvRound(widest / std::pow(1.8, static_cast<double>(path))));
}

void drawPaths(const GridPicture& picture, GridCanvas* canvas) {
  for (std::size_t i = 0; i < picture.paths.size(); ++i) {
    const GridPicture::Path& path = picture.paths[i];
    if (path.cells.empty()) continue;
    std::vector<cv::Point> places;
    for (const CellIndex& cell : path.cells) places.push_back(canvas->at(cell));
    canvas->polyline(places, colorOf(i), widthOf(i, picture.paths.size(), canvas->scale()));
    if (!path.arrived) canvas->cross(places.back(), 10.0, colorOf(i), 4);
  }
}

/// The map with a line of text above it, and one below it for each path.
cv::Mat withText(const cv::Mat& map, const GridPicture& picture) {
  constexpr int kMargin = 10;
  const int lines = static_cast<int>(picture.paths.size());
  constexpr int kNarrowest = 640;
  cv::Mat page(map.rows + (lines + 2) * kLine, std::max(map.cols, kNarrowest), CV_8UC3, kFree);
  map.copyTo(page(cv::Rect(0, kLine, map.cols, map.rows)));
  const auto write = [&](const std::string& text, int left, int line_bottom) {
    writeText(text, {left, line_bottom - 8}, kText, kInk, 1, &page);
  };
  write(picture.title, kMargin, kLine);
  int bottom = kLine + map.rows;
  for (std::size_t i = 0; i < picture.paths.size(); ++i) {
    bottom += kLine;
    constexpr int kSample = 40;
    cv::line(page, {kMargin, bottom - kLine / 2}, {kMargin + kSample, bottom - kLine / 2}, colorOf(i), 5, cv::LINE_AA);
    write(picture.paths[i].label, 2 * kMargin + kSample, bottom);
  }
  bottom += kLine;
  cv::circle(page, {kMargin + 7, bottom - kLine / 2}, 6, kInk, cv::FILLED, cv::LINE_AA);
  write("start", 2 * kMargin + 10, bottom);
  cv::circle(page, {kMargin + 107, bottom - kLine / 2}, 7, kGoal, 3, cv::LINE_AA);
  write("goal", 2 * kMargin + 110, bottom);
  return page;
}

}  // namespace

void writeGridPicture(const std::string& path, const PassableGrid& grid, const GridPicture& picture) {
  if (grid.size() == 0) throw std::invalid_argument("an empty map cannot be drawn");
  GridCanvas canvas(grid, frame(grid, picture));
  drawPaths(picture, &canvas);
  canvas.circle(canvas.at(picture.start), 6.0, kInk, cv::FILLED);
  canvas.circle(canvas.at(picture.goal), 8.0, kGoal, 3);
  writePicture(path, withText(canvas.image(), picture));
}

}  // namespace lstm_planner
