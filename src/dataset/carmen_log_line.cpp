#include "dataset/carmen_log_line.hpp"

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

namespace {

constexpr int kMostReadings = 10000;

/// The words of a line, one after the other.
class Words {
 public:
  explicit Words(const std::string& text) : at_(text.c_str()) {}

  double number(const char* what) {
    char* end = nullptr;
    const double value = std::strtod(at_, &end);
    const bool is_word = end != at_ && (*end == '\0' || *end == ' ' || *end == '\t' || *end == '\r');
    if (!is_word || !std::isfinite(value)) {
      throw std::invalid_argument(std::string("has no number where ") + what + " should be");
    }
    at_ = end;
    return value;
  }

  int count(const char* what, int least) {
    const double value = number(what);
    if (value != std::floor(value) || value < least || value > kMostReadings) {
      throw std::invalid_argument(std::string("has ") + what + " of " + numberText(value) + ", expected " +
                                  std::to_string(least) + " to " + std::to_string(kMostReadings));
    }
    return static_cast<int>(value);
  }

  Pose2 pose(const char* what) {
    const double x = number(what);
    const double y = number(what);
    return {x, y, number(what)};
  }

  void skip(int numbers, const char* what) {
    for (int i = 0; i < numbers; ++i) number(what);
  }

 private:
  const char* at_;
};

void readRanges(Words* words, int count, LaserScan* scan) {
  scan->ranges.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) scan->ranges.push_back(static_cast<float>(words->number("a reading")));
}

/// The largest range that is not yet the one that means that nothing came back.
double below(double longest) { return std::nextafter(static_cast<float>(longest), 0.0f); }

void guessAngles(int count, LaserScan* scan) {
  const bool is_narrow = count == 400 || count == 401;
  const double span = degreesToRadians(is_narrow ? 100.0 : 180.0);
  const bool is_sick = is_narrow || count == 180 || count == 181 || count == 360 || count == 361;
  // An even number of a SICK's readings lacks the last one.
  scan->angle_increment = span / (is_sick ? count - count % 2 : count - 1);
  scan->angle_min = -0.5 * span;
}

/// The angle between readings (rad). Some loggers write how many there are in the field of view instead.
double angleBetween(double resolution, double field_of_view, std::size_t readings) {
  const double count = static_cast<double>(readings);
  const bool is_count =
      resolution >= 2.0 && resolution == std::floor(resolution) && std::abs(resolution - count) <= 1.0;
  if (!is_count) return resolution;
  const bool counts_both_ends = resolution == count && readings % 2 == 1;
  return field_of_view / (counts_both_ends ? count - 1.0 : resolution);
}

}  // namespace

CarmenLine parseCarmenOdometry(const std::string& text) {
  Words words(text);
  CarmenLine line;
  line.robot = words.pose("the pose");
  words.skip(3, "speed and acceleration");
  line.stamp = words.number("the time");
  return line;
}

CarmenLine parseCarmenFrontLaser(const std::string& text) {
  constexpr double kNothingCameBack = 50.0;  // m
  Words words(text);
  CarmenLine line;
  line.has_scan = true;
  const int count = words.count("a number of readings", 2);
  guessAngles(count, &line.scan);
  line.scan.range_max = below(kNothingCameBack);
  readRanges(&words, count, &line.scan);
  line.laser = words.pose("the laser's pose");
  line.robot = words.pose("the robot's pose");
  line.stamp = words.number("the time");
  return line;
}

CarmenLine parseCarmenRobotLaser(const std::string& text) {
  Words words(text);
  CarmenLine line;
  line.has_scan = true;
  words.skip(1, "the type");
  line.scan.angle_min = words.number("the first angle");
  const double field_of_view = words.number("the field of view");
  const double resolution = words.number("the angle between readings");
  line.scan.range_max = below(words.number("the longest range"));
  words.skip(2, "accuracy and remission mode");
  readRanges(&words, words.count("a number of readings", 2), &line.scan);
  line.scan.angle_increment = angleBetween(resolution, field_of_view, line.scan.ranges.size());
  words.skip(words.count("a number of remissions", 0), "a remission");
  line.laser = words.pose("the laser's pose");
  line.robot = words.pose("the robot's pose");
  words.skip(5, "speeds, safety distances and turn axis");
  line.stamp = words.number("the time");
  if (line.scan.angle_increment == 0.0) throw std::invalid_argument("has an angle of 0 between readings");
  return line;
}

}  // namespace lstm_planner
