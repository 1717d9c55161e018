#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/ros/demo/demo_runner.hpp"

namespace lstm_planner {
namespace {

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof(text), pattern, arguments);
  va_end(arguments);
  return text;
}

std::string contactsText(unsigned contacts) { return format("%u contact%s", contacts, contacts == 1 ? "" : "s"); }

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
  std::string line = format("goal %s (%.1f, %.1f): ", leg.name.c_str(), leg.goal.x, leg.goal.y);
  if (leg.reached) {
    line += format("reached in %.1f s, path %.1f m", leg.time, leg.path);
    if (hasRatio(leg)) line += format(" = %.2f x shortest", leg.path / leg.shortest);
  } else {
    line += format("MISSED after %.1f s, path %.1f m, %.1f m away", leg.time, leg.path, leg.remaining);
    if (!std::isfinite(leg.shortest)) line += ", no path on the map";
  }
  line += ", " + contactsText(leg.contacts);
  if (!leg.reached && !leg.text.empty()) line += " (" + leg.text + ")";
  return line;
}

std::string describeDemo(const std::vector<DemoLeg>& legs, std::size_t planned) {
  const Totals totals = totalsOf(legs);
  std::string line =
      format("%zu of %zu goals reached in %.1f s, path %.1f m", totals.reached, planned, totals.time, totals.path);
  if (totals.mean_ratio > 0.0) line += format(" = %.2f x shortest on average", totals.mean_ratio);
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
