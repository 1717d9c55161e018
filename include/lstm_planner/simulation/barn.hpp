#pragma once

#include <string>
#include <vector>

#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// A world of the BARN benchmark (D. Perille, A. Truong, X. Xiao, P. Stone, "Benchmarking Metric Ground Navigation",
/// SSRR 2020): cylinders of 0.15 m diameter between the start, (-2.25, 3) looking along y, and a goal 10 m ahead.
struct BarnWorld {
  int number = 0;
  std::vector<Circle> circles;
  DriveTask task;  ///< `shortest` is the length of the reference path, 0 if it is not known
};

/// Reads a CSV file with a line "world,x,y" for each cylinder, in any order, and the lengths of the reference paths
/// from `barn_reference_paths.csv` (columns world and path_length_m) beside it, if it exists. Worlds are in the order
/// of their numbers. Throws std::invalid_argument naming the file, the line and what was expected.
std::vector<BarnWorld> readBarnWorlds(const std::string& path);

/// BARN's rules: 100 s, and a goal radius of 1 m by the true position.
DriveParameters barnRules(DriveParameters parameters);

/// BARN's score of one drive (The BARN Challenge, ICRA 2022): success * T* / clip(T, k T*, 8 T*), where T is the time
/// and T* that of the reference path at 2 m/s; a drive with a contact is no success. So it is at most 1 / k; k was 4 at
/// first and 2 later. 0 if the reference path is not known.
double barnScore(const DriveResult& result, double k);

}  // namespace lstm_planner
