#include "lstm_planner/grid_world/evaluation/thesis_maps.hpp"

#include <algorithm>
#include <stdexcept>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"

namespace lstm_planner {
namespace {

constexpr std::size_t kTrainingMaps = 5;
constexpr std::size_t kValidationMaps = 3;
constexpr std::size_t kTestMaps = 10;

GridSetFiles trainingSet(std::vector<GridSetFiles>* sets, const std::string& kind, const std::string& number,
                         Random& random) {
  for (GridSetFiles& set : *sets) {
    if (!isGridSet(set.name, kind, number)) continue;
    if (set.maps.size() < 2) {
      throw std::invalid_argument("set " + set.name + " has " + std::to_string(set.maps.size()) +
                                  " maps, expected at least 2 for the thesis's training");
    }
    shuffle(&set.maps, random);
    return set;
  }
  throw std::invalid_argument("there is no set of " + kind + " " + number +
                              ", expected mazes of width 2 and 4 and random fill of 25 and 40 % (Mazes_2w, Mazes_4w, "
                              "Random25, Random40) for the thesis's training");
}

bool contains(const std::vector<GridMapFiles>& maps, const GridMapFiles& map) {
  return std::any_of(maps.begin(), maps.end(),
                     [&](const GridMapFiles& other) { return other.scenario_files == map.scenario_files; });
}

}  // namespace

ThesisMaps chooseThesisMaps(const std::vector<GridSetFiles>& sets, std::uint64_t seed) {
  Random random(seed);
  std::vector<GridSetFiles> drawn = sets;
  std::vector<GridSetFiles> trained;
  for (const auto& [kind, number] : {std::pair{"random", "25"}, {"maze", "2"}, {"maze", "4"}, {"random", "40"}}) {
    trained.push_back(trainingSet(&drawn, kind, number, random));
  }
  ThesisMaps maps;
  for (std::size_t i = 0; i < kTrainingMaps + kValidationMaps; ++i) {
    std::vector<GridMapFiles>& chosen = i < kTrainingMaps ? maps.training : maps.validation;
    chosen.push_back(trained[i % trained.size()].maps[i / trained.size()]);
  }
  for (const GridSetFiles& set : sets) {
    if (thesisTableOf(set.name) == nullptr) continue;
    GridSetFiles test = set;
    const auto used = [&](const GridMapFiles& map) {
      return contains(maps.training, map) || contains(maps.validation, map);
    };
    std::vector<GridMapFiles>& tests = test.maps;
    tests.erase(std::remove_if(tests.begin(), tests.end(), used), tests.end());
    shuffle(&tests, random);
    if (tests.size() > kTestMaps) tests.resize(kTestMaps);
    std::sort(tests.begin(), tests.end(),
              [](const auto& a, const auto& b) { return a.scenario_files.front() < b.scenario_files.front(); });
    if (!tests.empty()) maps.tests.push_back(std::move(test));
  }
  if (maps.tests.empty()) {
    throw std::invalid_argument(
        "there is no set to test in, expected Dragon Age, mazes of width 8 or random fill of 25 %");
  }
  return maps;
}

}  // namespace lstm_planner
