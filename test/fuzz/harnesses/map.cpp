#include <string>

#include "fuzz/harness.hpp"
#include "fuzz/scratch_file.hpp"
#include "lstm_planner/grid/map_server_map.hpp"

namespace lstm_planner::fuzz::map_harness {
namespace {

constexpr const char* kImageName = "map.image";  // stands for the image's path in the description
constexpr const char* kSeparator = "\n--image--\n";

/// A description, the separator, and an image.
void readMap(const std::uint8_t* data, std::size_t size) {
  static ScratchFile description(".yaml");
  static ScratchFile image;
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = input.find(kSeparator);
  std::string text = input.substr(0, end);
  if (const std::size_t name = text.find(kImageName); name != std::string::npos) {
    text.replace(name, std::string(kImageName).size(), image.path());
  }
  description.write(text);
  image.write(end == std::string::npos ? "" : input.substr(end + std::string(kSeparator).size()));
  expectRefusal<MapFileError>([] {
    const OccupancyGrid grid = readMapServerMap(description.path());
    require(grid.columns() > 0 && grid.rows() > 0, "a map has cells");
    require(isFinite(grid.origin()) && grid.resolution() > 0.0, "the map's place is finite");
  });
}

const Registration registration("map", &readMap);

}  // namespace
}  // namespace lstm_planner::fuzz::map_harness
