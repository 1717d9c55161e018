#include <cmath>
#include <nlohmann/json.hpp>

#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/ros/demo/demo_runner.hpp"

namespace lstm_planner {
namespace {

std::string contactsText(unsigned contacts) {
  return std::to_string(contacts) + (contacts == 1 ? " contact" : " contacts");
}

std::string drivenText(double time, double path) {
  return fixedText(time, 1) + " s, path " + fixedText(path, 1) + " m";
}

bool hasRatio(const DemoLeg& leg) { return leg.reached && leg.shortest > 0.0 && std::isfinite(leg.shortest); }

struct Totals {
  std::size_t reached = 0;
  unsigned contacts = 0;
  double time = 0.0;
  double path = 0.0;
  double mean_ratio = 0.0;  ///< of the legs that arrived; 0 when none did
};

Totals totalsOf(const std::vector<DemoLeg>& legs) {
  Totals totals;
  std::size_t ratios = 0;
  for (const DemoLeg& leg : legs) {
    totals.reached += leg.reached ? 1 : 0;
    totals.contacts += leg.contacts;
    totals.time += leg.time;
    totals.path += leg.path;
    if (!hasRatio(leg)) continue;
    totals.mean_ratio += leg.path / leg.shortest;
    ++ratios;
  }
  if (ratios > 0) totals.mean_ratio /= static_cast<double>(ratios);
  return totals;
}

nlohmann::json toJson(const DemoLeg& leg) {
  nlohmann::json json = {{"name", leg.name},       {"x", leg.goal.x},          {"y", leg.goal.y},
                         {"reached", leg.reached}, {"text", leg.text},         {"time_s", leg.time},
                         {"path_m", leg.path},     {"contacts", leg.contacts}, {"remaining_m", leg.remaining}};
  json["shortest_m"] = std::isfinite(leg.shortest) ? nlohmann::json(leg.shortest) : nlohmann::json();
  json["ratio"] = hasRatio(leg) ? nlohmann::json(leg.path / leg.shortest) : nlohmann::json();
  return json;
}

}  // namespace

std::string describeLeg(const DemoLeg& leg) {
  std::string line = "goal " + leg.name + " (" + fixedText(leg.goal.x, 1) + ", " + fixedText(leg.goal.y, 1) + "): ";
  if (leg.reached) {
    line += "reached in " + drivenText(leg.time, leg.path);
    if (hasRatio(leg)) line += " = " + fixedText(leg.path / leg.shortest, 2) + " x shortest";
  } else {
    line += "MISSED after " + drivenText(leg.time, leg.path) + ", " + fixedText(leg.remaining, 1) + " m away";
    if (!std::isfinite(leg.shortest)) line += ", no path on the map";
  }
  line += ", " + contactsText(leg.contacts);
  if (!leg.reached && !leg.text.empty()) line += " (" + leg.text + ")";
  return line;
}

std::string describeDemo(const std::vector<DemoLeg>& legs, std::size_t planned) {
  const Totals totals = totalsOf(legs);
  std::string line = std::to_string(totals.reached) + " of " + std::to_string(planned) + " goals reached in " +
                     drivenText(totals.time, totals.path);
  if (totals.mean_ratio > 0.0) line += " = " + fixedText(totals.mean_ratio, 2) + " x shortest on average";
  return line + ", " + contactsText(totals.contacts);
}

int demoExitCode(const std::vector<DemoLeg>& legs, std::size_t planned) {
  const Totals totals = totalsOf(legs);
  return totals.reached == planned && totals.contacts == 0 ? 0 : 1;
}

void writeDemoResult(const std::string& path, int exit_code, const std::vector<DemoLeg>& legs, std::size_t planned,
                     const std::string& error) {
  const Totals totals = totalsOf(legs);
  nlohmann::json json = {{"goals", planned},
                         {"reached", totals.reached},
                         {"contacts", totals.contacts},
                         {"mean_ratio", totals.mean_ratio},
                         {"mean_time_s", legs.empty() ? 0.0 : totals.time / static_cast<double>(legs.size())},
                         {"legs", nlohmann::json::array()}};
  for (const DemoLeg& leg : legs) json["legs"].push_back(toJson(leg));
  if (!error.empty()) json["error"] = error;
  writeOutputFile("result file", path, [&](std::ostream& file) { file << exit_code << '\n' << json.dump(2) << '\n'; });
}

}  // namespace lstm_planner
