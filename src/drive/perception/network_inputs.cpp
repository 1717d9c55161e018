#include "lstm_planner/drive/perception/network_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "lstm_planner/drive/perception/encoder.hpp"

namespace lstm_planner {
namespace {

constexpr double kMostLogSteps = 13.0;  ///< log2 of the longest time in steps that is told apart
constexpr double kDiagonal = 0.70710678118654752;

using O = const Observation&;
using P = const EncoderParameters&;
using B = const ViewBearings&;

/// Grows with a count or a length and stays below 1.
double saturating(double value, double half) { return std::max(0.0, value) / (std::max(0.0, value) + half); }

double loggedSteps(double steps) { return std::log2(std::max(0.0, steps) + 1.0) / kMostLogSteps; }

template <int kScale>
double placeVisits(O o, P, int i) {
  return saturating(o.places[kScale].visits[static_cast<std::size_t>(i)], 2.0);
}

template <int kScale>
double placeFreshness(O o, P, int i) {
  const PlacesAround& places = o.places[kScale];
  if (!(places.visits[static_cast<std::size_t>(i)] > 0.0)) return 0.0;
  return std::max(0.0, 1.0 - loggedSteps(places.ages[static_cast<std::size_t>(i)]));
}

double sectorRange(O o, int i) { return o.sector_ranges[static_cast<std::size_t>(i)]; }

/// By how much rounding turns a heading.
double roundedBy(O o, P p) {
  const double cell = p.heading_cell;
  return cell > 0.0 ? std::round(o.heading / cell) * cell - o.heading : 0.0;
}
double goalBearing(O o, P p) { return o.goal_bearing - roundedBy(o, p); }
double heading(O o, P p) { return o.heading + roundedBy(o, p); }
double motion(double length) { return std::clamp(length, -1.0, 1.0); }

double angleFrom(double bearing, double scale, int view) {
  return normalizeAngle(bearing - static_cast<double>(view) * kViewAngle) / scale;
}

/// Of length 1, relative to the heading.
Point2 viewDirection(int view) {
  static constexpr std::array<Point2, kDriveViews> kDirections = {{{1.0, 0.0},
                                                                   {kDiagonal, kDiagonal},
                                                                   {0.0, 1.0},
                                                                   {-kDiagonal, kDiagonal},
                                                                   {-1.0, 0.0},
                                                                   {-kDiagonal, -kDiagonal},
                                                                   {0.0, -1.0},
                                                                   {kDiagonal, -kDiagonal}}};
  return kDirections[static_cast<std::size_t>(view)];
}

double along(const Point2& direction, int view) {
  const Point2 ahead = viewDirection(view);
  return ahead.x * direction.x + ahead.y * direction.y;
}

double aside(const Point2& direction, int view) {
  const Point2 ahead = viewDirection(view);
  return ahead.x * direction.y - ahead.y * direction.x;
}

constexpr Point2 kAhead{1.0, 0.0};
constexpr auto kScanner = InputTurns::kWithScanner;
constexpr auto kBearing = InputTurns::kBearing;
constexpr auto kAround = InputTurns::kAround;
constexpr auto kFixed = InputTurns::kNot;
using M = InputMirrors;

}  // namespace

const std::vector<NetworkInput>& networkInputs() {
  static const std::vector<NetworkInput> kInputs = {
      {"sector", 8, "thesis", [](O o, P p, int i) { return std::clamp(sectorRange(o, i) / p.range_cap, 0.0, 1.0); },
       kScanner, nullptr, M::kSectors,
       "mean range of a sector of 22.5°, from right (-90°) to left (90°), limited to `range_cap`, divided by "
       "`range_cap`: 0 to 1"},
      {"goal_distance", 1, "thesis", [](O o, P p, int) { return saturating(o.goal_distance, p.distance_scale); },
       kFixed, nullptr, M::kNot, "d / (d + `distance_scale`): 0 to 1"},
      {"goal_bearing_sin", 1, "thesis", [](O o, P p, int) { return std::sin(goalBearing(o, p)); }, kBearing,
       [](B b, P, int view) { return aside(b.goal_direction, view); }, M::kSign,
       "sine of the goal's bearing, relative to the heading"},
      {"goal_bearing_cos", 1, "thesis", [](O o, P p, int) { return std::cos(goalBearing(o, p)); }, kBearing,
       [](B b, P, int view) { return along(b.goal_direction, view); }, M::kNot, "cosine of the goal's bearing"},
      {"heading_sin", 1, "thesis", [](O o, P p, int) { return std::sin(heading(o, p)); }, kBearing,
       [](B, P, int view) { return aside(kAhead, view); }, M::kSign, "sine of the heading in the odometry frame"},
      {"heading_cos", 1, "thesis", [](O o, P p, int) { return std::cos(heading(o, p)); }, kBearing,
       [](B, P, int view) { return along(kAhead, view); }, M::kNot, "cosine of the heading"},
      {"previous_action", 1, "thesis", [](O o, P p, int) { return normalizeAngle(o.previous_action) / p.action_scale; },
       kBearing, [](B b, P p, int view) { return angleFrom(b.previous_action, p.action_scale, view); }, M::kSign,
       "steering angle of the last step, divided by `action_scale`; 0 in the first step"},
      {"goal_bearing", 1, "angles", [](O o, P p, int) { return normalizeAngle(goalBearing(o, p)) / p.angle_scale; },
       kBearing, [](B b, P p, int view) { return angleFrom(b.goal, p.angle_scale, view); }, M::kSign,
       "the goal's bearing, divided by `angle_scale`: -1 to 1"},
      {"heading", 1, "angles", [](O o, P p, int) { return normalizeAngle(heading(o, p)) / p.angle_scale; }, kBearing,
       [](B, P p, int view) { return angleFrom(0.0, p.angle_scale, view); }, M::kSign,
       "the heading, divided by `angle_scale`: -1 to 1"},
      {"event", 8, "events", [](O o, P p, int i) { return sectorRange(o, i) < p.event_range ? 1.0 : 0.0; }, kScanner,
       nullptr, M::kSectors, "1 if the mean range of the sector is below `event_range`, else 0 (thesis 4.3.1)"},
      {"visits", 8, "visits", [](O o, P, int i) { return saturating(o.visits[static_cast<std::size_t>(i)], 1.0); },
       kAround, nullptr, M::kAround, "v / (v + 1) for v visits to the place a step away, from ahead to the left"},
      {"step_visits", 8, "trace", placeVisits<0>, kAround, nullptr, M::kAround,
       "v / (v + 2) for v visits to the square of 0.5 m that lies 0.8 m away, or as far as it seems to be free"},
      {"step_freshness", 8, "trace", placeFreshness<0>, kAround, nullptr, M::kAround,
       "1 - log2(steps since then + 1) / 13 of the same square; 0 where the robot never was"},
      {"room_visits", 8, "trace", placeVisits<1>, kAround, nullptr, M::kAround,
       "the same as `step_visits` for squares of 1.5 m, 2 m away"},
      {"room_freshness", 8, "trace", placeFreshness<1>, kAround, nullptr, M::kAround,
       "the same as `step_freshness` for these"},
      {"hall_visits", 8, "trace", placeVisits<2>, kAround, nullptr, M::kAround,
       "the same as `step_visits` for squares of 4.5 m, 5 m away"},
      {"hall_freshness", 8, "trace", placeFreshness<2>, kAround, nullptr, M::kAround,
       "the same as `step_freshness` for these"},
      {"room_visits", 1, "trace", [](O o, P, int) { return saturating(o.room_visits, 2.0); }, kFixed, nullptr, M::kNot,
       "v / (v + 2) for v visits to the square of 1.5 m that the robot is in"},
      {"behind_best", 1, "trace", [](O o, P p, int) { return saturating(o.behind_best, p.distance_scale); }, kFixed,
       nullptr, M::kNot, "m / (m + `distance_scale`) for the m that the goal is farther than it was at the nearest"},
      {"steps_since_best", 1, "trace", [](O o, P, int) { return std::min(1.0, loggedSteps(o.steps_since_best)); },
       kFixed, nullptr, M::kNot, "log2(steps since then + 1) / 13, at most 1"},
      {"motion_forward", 1, "motion", [](O o, P, int) { return motion(o.motion.x); }, kBearing,
       [](B b, P, int view) { return motion(along(b.motion, view)); }, M::kNot,
       "m that the robot went ahead since the step before: -1 to 1"},
      {"motion_left", 1, "motion", [](O o, P, int) { return motion(o.motion.y); }, kBearing,
       [](B b, P, int view) { return motion(aside(b.motion, view)); }, M::kSign, "m that it went to the left"},
      {"motion_turn", 1, "motion", [](O o, P p, int) { return normalizeAngle(o.turn) / p.action_scale; }, kFixed,
       nullptr, M::kSign, "its turn since the step before, divided by `action_scale`"},
      {"previous_action_sin", 1, "views", [](O o, P, int) { return std::sin(o.previous_action); }, kBearing,
       [](B b, P, int view) { return aside(b.previous_direction, view); }, M::kSign,
       "sine of the last step's steering angle"},
      {"previous_action_cos", 1, "views", [](O o, P, int) { return std::cos(o.previous_action); }, kBearing,
       [](B b, P, int view) { return along(b.previous_direction, view); }, M::kNot,
       "cosine of the last step's steering angle"},
      {"seen", 8, "views", [](O, P, int) { return 1.0; }, kScanner, nullptr, M::kSectors,
       "1 where the scanner looks into a sector of the view, else 0"}};
  return kInputs;
}

InputName inputNamed(const std::string& name) {
  const bool numbered =
      name.size() > 2 && name[name.size() - 2] == '_' && name.back() >= '0' && name.back() < '0' + kDriveViews;
  for (const NetworkInput& input : networkInputs()) {
    if (input.count == 1 && name == input.name) return {&input, 0};
    if (input.count > 1 && numbered && name.compare(0, name.size() - 2, input.name) == 0) {
      return {&input, name.back() - '0'};
    }
  }
  std::string expected;
  for (const NetworkInput& input : networkInputs()) {
    expected += (expected.empty() ? "" : ", ") + std::string(input.name) + (input.count > 1 ? "_0 .. 7" : "");
  }
  throw std::invalid_argument("input_layout names '" + name + "', expected one of " + expected);
}

std::vector<std::string> inputsOfGroup(const std::string& group) {
  std::vector<std::string> names;
  for (const NetworkInput& input : networkInputs()) {
    if (group != input.group) continue;
    for (int i = 0; i < input.count; ++i) {
      names.push_back(input.count > 1 ? std::string(input.name) + "_" + std::to_string(i) : input.name);
    }
  }
  return names;
}

}  // namespace lstm_planner
