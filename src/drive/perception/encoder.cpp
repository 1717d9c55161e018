#include "lstm_planner/drive/perception/encoder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace lstm_planner {
namespace {

constexpr double kSmallestScale = 1e-3;
constexpr double kLargestScale = 1e6;
constexpr double kSameSpan = 1e-3;      ///< rad
constexpr double kMostLogSteps = 13.0;  ///< log2 of the longest time in steps that is told apart
constexpr std::array<const char*, kPlaceScales> kPlaceNames = {"step", "room", "hall"};

double freshness(double visits, double age) {
  if (!(visits > 0.0)) return 0.0;
  return std::max(0.0, 1.0 - std::log2(std::max(0.0, age) + 1.0) / kMostLogSteps);
}

/// Grows with a count and stays below 1.
double frequency(double count) { return std::max(0.0, count) / (std::max(0.0, count) + 2.0); }

void checkScale(const std::string& name, double value) {
  if (!(value >= kSmallestScale && value <= kLargestScale)) {
    throw std::invalid_argument(name + " is " + metadataText(value) + ", expected a number in [0.001, 1000000]");
  }
}

/// Splits "sector_3" into the name "sector_" and 3; false when `name` does not end in one of the digits 0 .. 7.
bool splitNumbered(const std::string& name, std::string* stem, std::uint8_t* index) {
  if (name.size() < 2 || name[name.size() - 2] != '_' || name.back() < '0' || name.back() > '7') return false;
  *stem = name.substr(0, name.size() - 1);
  *index = static_cast<std::uint8_t>(name.back() - '0');
  return true;
}

/// A view takes over what another one saw there: each direction must be told.
void checkGroupsAreWhole(const std::vector<std::string>& layout) {
  std::map<std::string, int> counts;
  for (const std::string& name : layout) {
    std::string stem;
    std::uint8_t index = 0;
    if (splitNumbered(name, &stem, &index)) ++counts[stem];
  }
  for (const auto& [stem, count] : counts) {
    if (count == kDriveViews) continue;
    throw std::invalid_argument("input_layout names " + std::to_string(count) + " of " + stem + "0 .. " + stem +
                                "7, expected all of them or none for eight views");
  }
}

bool hasEvents(const std::vector<std::string>& layout) {
  return std::any_of(layout.begin(), layout.end(),
                     [](const std::string& name) { return name.rfind("event_", 0) == 0; });
}

}  // namespace

void validate(const EncoderParameters& parameters) {
  if (parameters.input_layout.empty()) {
    throw std::invalid_argument("input_layout is empty, expected at least one input name");
  }
  std::set<std::string> seen;
  for (const std::string& name : parameters.input_layout) {
    Encoder::inputNamed(name);
    if (!seen.insert(name).second) {
      throw std::invalid_argument("input_layout names '" + name + "' twice, expected each input once");
    }
  }
  if (parameters.sector_count != kSectorCount) {
    throw std::invalid_argument("sector_count is " + std::to_string(parameters.sector_count) + ", expected " +
                                std::to_string(kSectorCount));
  }
  if (!(std::abs(parameters.angle_span - M_PI) < kSameSpan)) {
    throw std::invalid_argument("angle_span is " + metadataText(parameters.angle_span) + ", expected pi");
  }
  checkScale("range_cap", parameters.range_cap);
  checkScale("distance_scale", parameters.distance_scale);
  checkScale("angle_scale", parameters.angle_scale);
  checkScale("action_scale", parameters.action_scale);
  if (!(parameters.position_cell >= 0.0 && parameters.position_cell <= kLargestScale)) {
    throw std::invalid_argument("position_cell is " + metadataText(parameters.position_cell) +
                                ", expected a number in [0, 1000000]");
  }
  if (!(parameters.heading_cell >= 0.0 && parameters.heading_cell <= M_PI)) {
    throw std::invalid_argument("heading_cell is " + metadataText(parameters.heading_cell) +
                                ", expected a number in [0, pi]");
  }
  if (parameters.heading_cell > 0.0 && parameters.views != 1) {
    throw std::invalid_argument("heading_cell is " + metadataText(parameters.heading_cell) +
                                ", expected 0 with eight views, which do not depend on the odometry frame");
  }
  checkScale("event_range", parameters.event_range);
  if (parameters.views != 1 && parameters.views != kDriveViews) {
    throw std::invalid_argument("views is " + std::to_string(parameters.views) + ", expected 1 or 8");
  }
  if (parameters.views != 1) checkGroupsAreWhole(parameters.input_layout);
}

void writeMetadata(const EncoderParameters& parameters, std::map<std::string, std::string>* metadata) {
  std::string layout;
  for (const std::string& name : parameters.input_layout) layout += (layout.empty() ? "" : ",") + name;
  (*metadata)["input_layout"] = layout;
  (*metadata)["sector_count"] = std::to_string(parameters.sector_count);
  (*metadata)["angle_span"] = metadataText(parameters.angle_span);
  (*metadata)["range_cap"] = metadataText(parameters.range_cap);
  (*metadata)["distance_scale"] = metadataText(parameters.distance_scale);
  (*metadata)["angle_scale"] = metadataText(parameters.angle_scale);
  (*metadata)["action_scale"] = metadataText(parameters.action_scale);
  (*metadata)["position_cell"] = metadataText(parameters.position_cell);
  if (parameters.heading_cell > 0.0) (*metadata)["heading_cell"] = metadataText(parameters.heading_cell);
  if (hasEvents(parameters.input_layout)) (*metadata)["event_range"] = metadataText(parameters.event_range);
  if (parameters.views != 1) (*metadata)["views"] = std::to_string(parameters.views);
}

EncoderParameters readEncoderParameters(MetadataReader* metadata) {
  EncoderParameters parameters;
  parameters.input_layout.clear();
  std::istringstream layout(metadata->text("input_layout"));
  for (std::string name; std::getline(layout, name, ',');) {
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    parameters.input_layout.push_back(name);
  }
  parameters.input_layout.shrink_to_fit();
  parameters.sector_count = metadata->whole("sector_count", kSectorCount, kSectorCount);
  parameters.angle_span = metadata->number("angle_span", M_PI - kSameSpan, M_PI + kSameSpan);
  const auto scale = [metadata](const char* key) { return metadata->number(key, kSmallestScale, kLargestScale); };
  parameters.range_cap = scale("range_cap");
  parameters.distance_scale = scale("distance_scale");
  parameters.angle_scale = scale("angle_scale");
  parameters.action_scale = scale("action_scale");
  parameters.position_cell = metadata->number("position_cell", 0.0, kLargestScale);
  if (metadata->has("heading_cell")) parameters.heading_cell = metadata->number("heading_cell", 0.0, M_PI);
  if (hasEvents(parameters.input_layout)) parameters.event_range = scale("event_range");
  if (metadata->has("views")) parameters.views = metadata->whole("views", 1, kDriveViews);
  if (!metadata->has("input_layout")) return parameters;
  try {
    validate(parameters);
  } catch (const std::invalid_argument& error) {
    metadata->note(error.what());
  }
  return parameters;
}

Encoder::Encoder(const EncoderParameters& parameters)
    : Encoder(std::make_shared<const EncoderParameters>(parameters)) {}

Encoder::Encoder(std::shared_ptr<const EncoderParameters> parameters) : parameters_(std::move(parameters)) {
  validate(*parameters_);
  findGroups();
}

void Encoder::findGroups() {
  using Key = std::pair<Feature, std::uint8_t>;
  std::map<Key, std::map<std::uint8_t, std::int16_t>> found;
  std::int16_t at = 0;
  for (const std::string& name : parameters_->input_layout) {
    const Input input = inputNamed(name);
    found[{input.feature, input.scale}][input.index] = at++;
  }
  groups_.reserve(found.size());
  for (const auto& [key, places] : found) {
    Group group{key.first, key.second, 0, {}, {}};
    for (const auto& [index, place] : places) {
      group.index[group.count] = index;
      group.at[group.count++] = place;
    }
    groups_.push_back(group);
  }
}

Encoder::Input Encoder::inputNamed(const std::string& name) {
  static const std::map<std::string, Feature> kSingle = {{"goal_distance", Feature::kGoalDistance},
                                                         {"goal_bearing", Feature::kGoalBearing},
                                                         {"goal_bearing_sin", Feature::kGoalBearingSin},
                                                         {"goal_bearing_cos", Feature::kGoalBearingCos},
                                                         {"heading", Feature::kHeading},
                                                         {"heading_sin", Feature::kHeadingSin},
                                                         {"heading_cos", Feature::kHeadingCos},
                                                         {"previous_action", Feature::kPreviousAction},
                                                         {"room_visits", Feature::kRoomVisits},
                                                         {"behind_best", Feature::kBehindBest},
                                                         {"steps_since_best", Feature::kStepsSinceBest},
                                                         {"motion_forward", Feature::kMotionForward},
                                                         {"motion_left", Feature::kMotionLeft},
                                                         {"motion_turn", Feature::kMotionTurn},
                                                         {"previous_action_sin", Feature::kPreviousActionSin},
                                                         {"previous_action_cos", Feature::kPreviousActionCos}};
  static const std::map<std::string, Feature> kNumbered = {{"sector_", Feature::kSector},
                                                           {"event_", Feature::kEvent},
                                                           {"visits_", Feature::kVisits},
                                                           {"seen_", Feature::kSeen}};
  const auto single = kSingle.find(name);
  if (single != kSingle.end()) return {single->second, 0, 0};
  std::string stem;
  std::uint8_t index = 0;
  if (splitNumbered(name, &stem, &index)) {
    const auto numbered = kNumbered.find(stem);
    if (numbered != kNumbered.end()) return {numbered->second, index, 0};
    for (std::uint8_t scale = 0; scale < kPlaceNames.size(); ++scale) {
      if (stem == std::string(kPlaceNames[scale]) + "_visits_") return {Feature::kPlaceVisits, index, scale};
      if (stem == std::string(kPlaceNames[scale]) + "_freshness_") return {Feature::kPlaceFreshness, index, scale};
    }
  }
  std::string expected = "sector_0 .. sector_7, event_0 .. event_7, visits_0 .. visits_7, seen_0 .. seen_7";
  for (const char* place : kPlaceNames) {
    expected += std::string(", ") + place + "_visits_0 .. 7, " + place + "_freshness_0 .. 7";
  }
  for (const auto& entry : kSingle) expected += ", " + entry.first;
  throw std::invalid_argument("input_layout names '" + name + "', expected one of " + expected);
}

void Encoder::encode(const Observation& observation, Eigen::Ref<Eigen::VectorXf> input) const {
  if (input.size() != size()) {
    throw std::invalid_argument("the input has " + std::to_string(input.size()) + " values, expected " +
                                std::to_string(size()));
  }
  Observation seen = observation;
  if (parameters_->views != 1) {
    const ViewBearings bearings = bearingsOf(observation);
    seen.heading = 0.0;
    seen.previous_action = bearings.previous_action;
    seen.motion = bearings.motion;
  }
  for (const Group& group : groups_) fill(group, seen, input.data());
}

/// By how much rounding turns a heading.
double Encoder::roundedBy(double heading) const {
  const double cell = parameters_->heading_cell;
  return cell > 0.0 ? std::round(heading / cell) * cell - heading : 0.0;
}

template <typename Value>
void Encoder::fill(const Group& group, const Value& value, float* input) {
  for (std::size_t i = 0; i < group.count; ++i) input[group.at[i]] = static_cast<float>(value(group.index[i]));
}

void Encoder::fill(const Group& group, const Observation& observation, float* input) const {
  const auto each = [&](const auto& value) { fill(group, value, input); };
  const auto only = [&](double value) { input[group.at[0]] = static_cast<float>(value); };
  const auto& sectors = observation.sector_ranges;
  const PlacesAround& places = observation.places[group.scale];
  const double rounded_by = roundedBy(observation.heading);
  switch (group.feature) {
    case Feature::kSector:
      return each([&](int i) { return std::clamp(sectors[i] / parameters_->range_cap, 0.0, 1.0); });
    case Feature::kEvent:
      return each([&](int i) { return sectors[i] < parameters_->event_range ? 1.0 : 0.0; });
    case Feature::kSeen:
      return each([](int) { return 1.0; });
    case Feature::kVisits:
      return each([&](int i) {
        const double visits = std::max(0.0, observation.visits[i]);
        return visits / (visits + 1.0);
      });
    case Feature::kPlaceVisits:
      return each([&](int i) { return frequency(places.visits[i]); });
    case Feature::kPlaceFreshness:
      return each([&](int i) { return freshness(places.visits[i], places.ages[i]); });
    case Feature::kGoalDistance: {
      const double distance = std::max(0.0, observation.goal_distance);
      return only(distance / (distance + parameters_->distance_scale));
    }
    case Feature::kGoalBearing:
      return only(normalizeAngle(observation.goal_bearing - rounded_by) / parameters_->angle_scale);
    case Feature::kGoalBearingSin:
      return only(std::sin(observation.goal_bearing - rounded_by));
    case Feature::kGoalBearingCos:
      return only(std::cos(observation.goal_bearing - rounded_by));
    case Feature::kHeading:
      return only(normalizeAngle(observation.heading + rounded_by) / parameters_->angle_scale);
    case Feature::kHeadingSin:
      return only(std::sin(observation.heading + rounded_by));
    case Feature::kHeadingCos:
      return only(std::cos(observation.heading + rounded_by));
    case Feature::kPreviousAction:
      return only(normalizeAngle(observation.previous_action) / parameters_->action_scale);
    case Feature::kPreviousActionSin:
      return only(std::sin(observation.previous_action));
    case Feature::kPreviousActionCos:
      return only(std::cos(observation.previous_action));
    case Feature::kRoomVisits:
      return only(frequency(observation.room_visits));
    case Feature::kBehindBest: {
      const double behind = std::max(0.0, observation.behind_best);
      return only(behind / (behind + parameters_->distance_scale));
    }
    case Feature::kStepsSinceBest:
      return only(std::min(1.0, std::log2(std::max(0.0, observation.steps_since_best) + 1.0) / kMostLogSteps));
    case Feature::kMotionForward:
      return only(std::clamp(observation.motion.x, -1.0, 1.0));
    case Feature::kMotionLeft:
      return only(std::clamp(observation.motion.y, -1.0, 1.0));
    case Feature::kMotionTurn:
      return only(normalizeAngle(observation.turn) / parameters_->action_scale);
  }
}

}  // namespace lstm_planner
