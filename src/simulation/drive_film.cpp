#include "lstm_planner/simulation/drive_film.hpp"

#include <cstdio>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "lstm_planner/common/picture_file.hpp"
#include "lstm_planner/simulation/trace_picture.hpp"
#include "simulation/map_canvas.hpp"

namespace lstm_planner {
namespace {

const cv::Scalar kScan(200, 60, 160);  // colours are blue, green, red
const cv::Scalar kPlan(0, 140, 255);

constexpr double kTraceWidth = 5.0;  // thousandths of the longer side
constexpr double kPlanWidth = 4.0;
constexpr double kRobotWidth = 4.0;
constexpr int kScanRadius = 1;  // pixels

/// The picture, and what has been driven and seen so far.
class Screen {
 public:
  Screen(const OccupancyGrid& floor, const DriveTask& task, const std::string& folder, const FilmParameters& parameters)
      : floor_(floor), canvas_(floor_, parameters.longest_side), task_(task), folder_(folder), parameters_(parameters) {
    seen_ = cv::Mat::zeros(canvas_.image().size(), CV_8UC1);
  }

  void show(const DriveMoment& moment) {
    moment_ = &moment;
    see();
    const Decision& decision = moment.agent.decision();
    goOn({moment.pose.x, moment.pose.y}, decision.choice, decision.on_route, &parts_);
    if (moment.time < next_frame_) return;
    next_frame_ += parameters_.period;
    draw();
    char name[32];
    std::snprintf(name, sizeof(name), "/%04d.png", frames_++);
    writePicture(folder_ + name, canvas_.image());
  }

 private:
  /// From the odometry frame, as the robot is where it is. What it remembers lies beside where it is by what the
  /// odometry was wrong by since.
  Point2 toWorld(const Point2& place) const {
    return toParentFrame(moment_->pose, toLocalFrame(moment_->situation.pose, place));
  }

  /// All that lies before the returns of the scan has been seen.
  void see() {
    const RangeProfile& profile = moment_->situation.profile;
    const double far = moment_->agent.policy().description().encoder.range_cap;
    std::vector<cv::Point> outline = {canvas_.pixelAt(toParentFrame(moment_->pose, profile.origin))};
    for (std::size_t beam = 0; beam < profile.ranges.size(); ++beam) {
      const float measured = profile.ranges[beam];
      const double range = profile.isMeasured(beam) ? measured : measured > 0.0f ? far : 0.0;
      const Point2 end = pointAlong(profile.origin, profile.direction(beam), range);
      outline.push_back(canvas_.pixelAt(toParentFrame(moment_->pose, end)));
    }
    cv::fillPoly(seen_, std::vector<std::vector<cv::Point>>{outline}, cv::Scalar(255));
  }

  void draw() {
    canvas_.image().setTo(colours::kUnknown);
    canvas_.image().setTo(colours::kFree, seen_);
    drawMemory();
    drawScan();
    for (const TracePicture::Part& part : parts_)
      canvas_.polyline(part.path, colorOf(part.choice, part.on_path), kTraceWidth);
    drawPlan();
    const double radius = moment_->agent.parameters().shield.footprint_radius;
    canvas_.circle(task_.goal, radius, colours::kGoal, cv::FILLED);
    drawRobot();
    canvas_.polyline({{moment_->pose.x, moment_->pose.y}, pointAlong(moment_->pose, moment_->pose.yaw, 2.0 * radius)},
                     colours::kStart, kRobotWidth);
  }

  void drawRobot() {
    const Footprint& footprint = moment_->agent.shield().footprint();
    if (footprint.isCircle()) {
      canvas_.circle({moment_->pose.x, moment_->pose.y}, footprint.circumscribedRadius(), colours::kStart, cv::FILLED);
      return;
    }
    std::vector<cv::Point> corners;
    for (const Point2& corner : footprint.corners()) {
      corners.push_back(canvas_.pixelAt(toParentFrame(moment_->pose, corner)));
    }
    cv::fillConvexPoly(canvas_.image(), corners, colours::kStart);
  }

  void drawMemory() {
    const double half = 0.5 * moment_->agent.parameters().memory.resolution;
    for (const Point2& place : moment_->agent.rememberedObstacles()) {
      const Point2 middle = toWorld(place);
      cv::rectangle(canvas_.image(), canvas_.pixelAt({middle.x - half, middle.y - half}),
                    canvas_.pixelAt({middle.x + half, middle.y + half}), colours::kObstacle, cv::FILLED);
    }
  }

  void drawScan() {
    for (const Point2& place : moment_->situation.obstacles) {
      cv::circle(canvas_.image(), canvas_.pixelAt(toParentFrame(moment_->pose, place)), kScanRadius, kScan, cv::FILLED);
    }
  }

  void drawPlan() {
    std::vector<Point2> line;
    for (const Pose2& pose : moment_->plan) line.push_back(toWorld({pose.x, pose.y}));
    canvas_.polyline(line, kPlan, kPlanWidth);
  }

  OccupancyGrid floor_;
  MapCanvas canvas_;
  DriveTask task_;
  std::string folder_;
  FilmParameters parameters_;
  cv::Mat seen_;  ///< a pixel each, 255: seen
  std::vector<TracePicture::Part> parts_;
  double next_frame_ = 0.0;  ///< s
  int frames_ = 0;
  const DriveMoment* moment_ = nullptr;  ///< that is shown
};

}  // namespace

DriveListener filmOf(const OccupancyGrid& floor, const DriveTask& task, const std::string& folder,
                     const FilmParameters& parameters) {
  if (floor.columns() == 0 || floor.rows() == 0) throw std::invalid_argument("an empty map cannot be drawn");
  const auto screen = std::make_shared<Screen>(floor, task, folder, parameters);
  return [screen](const DriveMoment& moment) { screen->show(moment); };
}

}  // namespace lstm_planner
