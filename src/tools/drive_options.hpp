#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/simulation/crowd.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/drive_film.hpp"

namespace lstm_planner {

/// Among the kinds of worlds, the one whose obstacles move.
constexpr const char* kDynaBarn = "dynabarn";

/// What `lstm_planner drive` is asked to do.
struct DriveOptions {
  // Where: one of the three, or none for an empty room with walkers.
  std::vector<std::string> maps;  ///< each FILE or FILE=FREE_THRESHOLD
  std::string barn;
  std::string kind;  ///< of generated worlds

  std::string model = "models/create2_lstm.onnx";
  std::optional<int> goals;
  std::vector<int> only;  ///< numbers of the goals or worlds to drive; all when empty
  std::optional<double> shortest;
  std::optional<double> time_limit;
  std::uint64_t seed = 1;
  int threads = 2;
  CrowdParameters crowd;
  DriveParameters drive;
  AgentParameters agent;
  bool knows_map = false;  ///< from the start

  std::string json;
  std::string details;
  std::string pictures;
  std::string states;
  std::string film;  ///< folder
  FilmParameters film_parameters;
};

/// Returns false when only the help was asked for. Throws with a sentence for options that make no sense.
bool readDriveOptions(const std::vector<std::string>& arguments, DriveOptions* options);

}  // namespace lstm_planner
