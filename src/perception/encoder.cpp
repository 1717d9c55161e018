#include "lstm_planner/perception/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace lstm_planner {
namespace {

constexpr double kSmallestScale = 1e-3;
constexpr double kLargestScale = 1e6;
constexpr char kSectorPrefix[] = "sector_";

// The classic locale: a decimal comma of the user's locale must not change a model file.
std::string toText(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(17) << value;
  return text.str();
}

const std::string& find(const std::map<std::string, std::string>& metadata, const std::string& key) {
  const auto entry = metadata.find(key);
  if (entry == metadata.end()) throw std::invalid_argument("the model's metadata lacks '" + key + "'");
  return entry->second;
}

double readNumber(const std::map<std::string, std::string>& metadata, const std::string& key) {
  const std::string& text = find(metadata, key);
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (!(stream >> value) || !(stream >> std::ws).eof()) {
    throw std::invalid_argument("the model's metadata has " + key + " '" + text + "', expected a number");
  }
  return value;
}

void checkScale(const std::string& name, double value) {
  if (!(value >= kSmallestScale && value <= kLargestScale)) {
    throw std::invalid_argument(name + " is " + toText(value) + ", expected a number in [0.001, 1000000]");
  }
}

/// The sector that an input name asks for, -1 when it is no sector.
int sectorOf(const std::string& name) {
  for (int sector = 0; sector < kSectorCount; ++sector) {
    if (name == kSectorPrefix + std::to_string(sector)) return sector;
  }
  return -1;
}

}  // namespace

void validate(const EncoderParameters& parameters) {
  if (parameters.input_layout.empty()) {
    throw std::invalid_argument("input_layout is empty, expected at least one input name");
  }
  static const std::set<std::string> kNames = {"goal_distance", "goal_bearing", "goal_bearing_sin", "goal_bearing_cos",
                                               "heading",       "heading_sin",  "heading_cos",      "previous_action"};
  std::set<std::string> seen;
  for (const std::string& name : parameters.input_layout) {
    if (sectorOf(name) < 0 && kNames.count(name) == 0) {
      throw std::invalid_argument("input_layout names '" + name +
                                  "', expected sector_0 .. sector_7, goal_distance, goal_bearing, goal_bearing_sin, "
                                  "goal_bearing_cos, heading, heading_sin, heading_cos or previous_action");
    }
    if (!seen.insert(name).second) {
      throw std::invalid_argument("input_layout names '" + name + "' twice, expected each input once");
    }
  }
  if (parameters.sector_count != kSectorCount) {
    throw std::invalid_argument("sector_count is " + std::to_string(parameters.sector_count) + ", expected " +
                                std::to_string(kSectorCount));
  }
  if (!(std::abs(parameters.angle_span - M_PI) < 1e-3)) {
    throw std::invalid_argument("angle_span is " + toText(parameters.angle_span) + ", expected pi");
  }
  checkScale("range_cap", parameters.range_cap);
  checkScale("distance_scale", parameters.distance_scale);
  checkScale("angle_scale", parameters.angle_scale);
  checkScale("action_scale", parameters.action_scale);
  if (!(parameters.position_cell >= 0.0 && parameters.position_cell <= kLargestScale)) {
    throw std::invalid_argument("position_cell is " + toText(parameters.position_cell) +
                                ", expected a number in [0, 1000000]");
  }
}

void writeMetadata(const EncoderParameters& parameters, std::map<std::string, std::string>* metadata) {
  std::string layout;
  for (const std::string& name : parameters.input_layout) layout += (layout.empty() ? "" : ",") + name;
  (*metadata)["input_layout"] = layout;
  (*metadata)["sector_count"] = std::to_string(parameters.sector_count);
  (*metadata)["angle_span"] = toText(parameters.angle_span);
  (*metadata)["range_cap"] = toText(parameters.range_cap);
  (*metadata)["distance_scale"] = toText(parameters.distance_scale);
  (*metadata)["angle_scale"] = toText(parameters.angle_scale);
  (*metadata)["action_scale"] = toText(parameters.action_scale);
  (*metadata)["position_cell"] = toText(parameters.position_cell);
}

EncoderParameters readEncoderParameters(const std::map<std::string, std::string>& metadata) {
  EncoderParameters parameters;
  parameters.input_layout.clear();
  std::istringstream layout(find(metadata, "input_layout"));
  for (std::string name; std::getline(layout, name, ',');) {
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    parameters.input_layout.push_back(name);
  }
  const double sector_count = readNumber(metadata, "sector_count");
  if (sector_count != kSectorCount) {
    throw std::invalid_argument("the model's metadata has sector_count '" + find(metadata, "sector_count") +
                                "', expected " + std::to_string(kSectorCount));
  }
  parameters.sector_count = kSectorCount;
  parameters.angle_span = readNumber(metadata, "angle_span");
  parameters.range_cap = readNumber(metadata, "range_cap");
  parameters.distance_scale = readNumber(metadata, "distance_scale");
  parameters.angle_scale = readNumber(metadata, "angle_scale");
  parameters.action_scale = readNumber(metadata, "action_scale");
  parameters.position_cell = readNumber(metadata, "position_cell");
  validate(parameters);
  return parameters;
}

Encoder::Encoder(EncoderParameters parameters) : parameters_(std::move(parameters)) {
  validate(parameters_);
  static const std::map<std::string, Feature> kFeatures = {{"goal_distance", Feature::kGoalDistance},
                                                           {"goal_bearing", Feature::kGoalBearing},
                                                           {"goal_bearing_sin", Feature::kGoalBearingSin},
                                                           {"goal_bearing_cos", Feature::kGoalBearingCos},
                                                           {"heading", Feature::kHeading},
                                                           {"heading_sin", Feature::kHeadingSin},
                                                           {"heading_cos", Feature::kHeadingCos},
                                                           {"previous_action", Feature::kPreviousAction}};
  for (const std::string& name : parameters_.input_layout) {
    const int sector = sectorOf(name);
    features_.push_back(sector >= 0 ? Input{Feature::kSector, sector} : Input{kFeatures.at(name), 0});
  }
}

void Encoder::encode(const Observation& observation, Eigen::Ref<Eigen::VectorXf> input) const {
  if (input.size() != size()) {
    throw std::invalid_argument("the input has " + std::to_string(input.size()) + " values, expected " +
                                std::to_string(size()));
  }
  for (int i = 0; i < size(); ++i) {
    input[i] = static_cast<float>(value(features_[static_cast<std::size_t>(i)], observation));
  }
}

double Encoder::value(const Input& input, const Observation& observation) const {
  switch (input.feature) {
    case Feature::kSector: {
      const double range = observation.sector_ranges[static_cast<std::size_t>(input.sector)];
      return std::clamp(range / parameters_.range_cap, 0.0, 1.0);
    }
    case Feature::kGoalDistance: {
      const double distance = std::max(0.0, observation.goal_distance);
      return distance / (distance + parameters_.distance_scale);
    }
    case Feature::kGoalBearing:
      return normalizeAngle(observation.goal_bearing) / parameters_.angle_scale;
    case Feature::kGoalBearingSin:
      return std::sin(observation.goal_bearing);
    case Feature::kGoalBearingCos:
      return std::cos(observation.goal_bearing);
    case Feature::kHeading:
      return normalizeAngle(observation.heading) / parameters_.angle_scale;
    case Feature::kHeadingSin:
      return std::sin(observation.heading);
    case Feature::kHeadingCos:
      return std::cos(observation.heading);
    case Feature::kPreviousAction:
      return normalizeAngle(observation.previous_action) / parameters_.action_scale;
  }
  return 0.0;
}

}  // namespace lstm_planner
