#include "lstm_planner/grid/map_server_map.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <locale>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "common/image_codecs.hpp"
#include "grid/map_image.hpp"
#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/common/output_file.hpp"

namespace lstm_planner {
namespace {

constexpr double kThresholdOfFile = -1.0;
constexpr std::uintmax_t kLargestImageFile = std::uintmax_t{1} << 29;
// Nobody's is longer, and libraries of some systems follow nested brackets until the stack ends.
constexpr std::uintmax_t kLargestDescription = 4096;

struct MapDescription {
  std::string image;
  double resolution = 0.0;
  Pose2 origin;
  bool negate = false;
  bool counts_alpha = true;  ///< in the mean of a pixel
  double occupied_threshold = 0.0;
  double free_threshold = 0.0;
};

std::string readWhole(const std::string& kind, const std::string& path, std::uintmax_t largest) {
  try {
    return readInputFile(path, largest);
  } catch (const InputFileError& error) {
    throw MapFileError("the " + kind + " " + path + " cannot be read: " + error.what());
  }
}

/// Reads the fields of one yaml file and says which one is wrong.
class DescriptionReader {
 public:
  explicit DescriptionReader(const std::string& path) : path_(path) {
    try {
      root_ = YAML::Load(readWhole("map's yaml file", path, kLargestDescription));
    } catch (const YAML::Exception& error) {
      throw MapFileError("the map " + path + " cannot be read as yaml: " + error.what());
    }
    if (!root_.IsMap()) throw MapFileError("the map " + path + " is no yaml mapping with image, resolution and origin");
  }

  MapDescription read() const {
    MapDescription description;
    description.image = text("image");
    description.resolution = number("resolution", field("resolution"));
    if (!(description.resolution > 0.0))
      refuse("resolution", text("resolution"), "a positive number of metres a pixel");
    description.origin = origin();
    description.negate = flag("negate");
    description.occupied_threshold = share("occupied_thresh");
    description.free_threshold = share("free_thresh");
    description.counts_alpha = mode() == "trinary";
    return description;
  }

 private:
  [[noreturn]] void refuse(const std::string& name, const std::string& value, const std::string& expected) const {
    throw MapFileError("the map " + path_ + " has " + name + " '" + value + "', expected " + expected);
  }

  YAML::Node field(const std::string& name) const {
    const YAML::Node node = root_[name];
    if (!node) throw MapFileError("the map " + path_ + " lacks the field " + name);
    return node;
  }

  std::string text(const std::string& name) const {
    const YAML::Node node = field(name);
    if (!node.IsScalar() || node.Scalar().empty()) refuse(name, YAML::Dump(node), "a single value");
    return node.Scalar();
  }

  double number(const std::string& name, const YAML::Node& node) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      refuse(name, YAML::Dump(node), "a finite number");
    }
    return value;
  }

  double share(const std::string& name) const {
    const double value = number(name, field(name));
    if (value < 0.0 || value > 1.0) refuse(name, text(name), "a number in [0, 1]");
    return value;
  }

  bool flag(const std::string& name) const {
    const std::string value = text(name);
    if (value == "0" || value == "false") return false;
    if (value == "1" || value == "true") return true;
    refuse(name, value, "0 or 1");
  }

  std::string mode() const {
    if (!root_["mode"]) return "trinary";
    const std::string mode = text("mode");
    if (mode != "trinary" && mode != "scale") {
      refuse("mode", mode, "trinary or scale: the values of raw are costs, and say nothing of walls");
    }
    return mode;
  }

  Pose2 origin() const {
    const YAML::Node node = field("origin");
    if (!node.IsSequence() || node.size() != 3) refuse("origin", YAML::Dump(node), "[x, y, yaw]");
    return {number("origin", node[0]), number("origin", node[1]), number("origin", node[2])};
  }

  std::string path_;
  YAML::Node root_;
};

std::string imagePath(const std::string& yaml_path, const std::string& image) {
  const std::size_t slash = yaml_path.find_last_of('/');
  return image.front() == '/' || slash == std::string::npos ? image : yaml_path.substr(0, slash + 1) + image;
}

/// From 0..white to 0..255; of one byte rounded down, as by the library that map_server reads with.
void stretch(int white, cv::Mat* image) {
  if (image->depth() == CV_16U) image->convertTo(*image, CV_8U, 255.0 / white);
  if (image->depth() != CV_8U || white >= 255) return;
  for (int row = 0; row < image->rows; ++row) {
    std::uint8_t* line = image->ptr<std::uint8_t>(row);
    for (int i = 0; i < image->cols * image->channels(); ++i) {
      line[i] = static_cast<std::uint8_t>(std::min(255, line[i] * 255 / white));
    }
  }
}

/// Of a path that came from another computer.
std::string hintAtImageBeside(const std::string& yaml_path, const std::string& path) {
  const std::string name = path.substr(path.find_last_of('/') + 1);
  const std::string beside = imagePath(yaml_path, name);
  std::error_code ignored;
  const bool is_beside = beside != path && std::filesystem::exists(beside, ignored);
  return is_beside ? "; beside the map there is one of that name: write image: " + name : "";
}

std::string readImageFile(const std::string& yaml_path, const std::string& path) {
  try {
    return readWhole("map image", path, kLargestImageFile);
  } catch (const MapFileError& error) {
    throw MapFileError(error.what() + hintAtImageBeside(yaml_path, path));
  }
}

cv::Mat readImage(const std::string& yaml_path, const std::string& name) {
  const std::string path = imagePath(yaml_path, name);
  const std::string bytes = readImageFile(yaml_path, path);
  checkMapImage(bytes, path);
  cv::Mat image;
  try {
    image = imageCodecs().decode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw MapFileError("the map image " + path + " cannot be decoded: " + error.err);
  } catch (const std::runtime_error& error) {
    throw MapFileError("the map image " + path + " cannot be decoded: " + error.what());
  }
  if (image.empty())
    throw MapFileError("the map image " + path + " cannot be decoded; expected a whole pgm, png, bmp or jpg");
  const int white = whiteOf(bytes);
  stretch(white > 0 ? white : image.depth() == CV_16U ? 65535 : 255, &image);
  if (image.depth() != CV_8U) throw MapFileError("the map image " + path + " has no 8 or 16 bit pixels");
  return image;
}

void checkHasFreeCell(const OccupancyGrid& grid, const MapDescription& map, double free_below,
                      const std::string& path) {
  long occupied = 0;
  for (const CellIndex cell : grid.cells()) {
    if (grid.at(cell) == Cell::kFree) return;
    occupied += grid.at(cell) == Cell::kOccupied ? 1 : 0;
  }
  std::ostringstream message;
  message << "the map " << path << " has no free cell by map_server's rule: " << occupied << " of "
          << static_cast<long>(grid.columns()) * grid.rows()
          << " are occupied (above occupied_thresh = " << map.occupied_threshold
          << "), the others unknown, none is below free_thresh = " << free_below << "; with negate = " << map.negate
          << ' ' << (map.negate ? "light" : "dark") << " is occupied, and the mean of all channels counts, alpha "
          << (map.counts_alpha ? "included" : "left out");
  throw MapFileError(message.str());
}

void writeImage(const OccupancyGrid& grid, std::ostream* image) {
  image->imbue(std::locale::classic());
  *image << "P5\n" << grid.columns() << " " << grid.rows() << "\n255\n";
  std::vector<char> line(static_cast<std::size_t>(grid.columns()));
  for (int row = grid.rows() - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const Cell cell = grid.at({column, row});
      // 205 lies between the thresholds written below: 50 / 255 is just above 0.196.
      const int value = cell == Cell::kFree ? 254 : cell == Cell::kOccupied ? 0 : 205;
      line[static_cast<std::size_t>(column)] = static_cast<char>(value);
    }
    image->write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

void writeDescription(const OccupancyGrid& grid, const std::string& image, std::ostream* yaml) {
  yaml->imbue(std::locale::classic());
  *yaml << std::setprecision(17) << "image: " << YAML::Dump(YAML::Node(image)) << "\nresolution: " << grid.resolution()
        << "\norigin: [" << grid.origin().x << ", " << grid.origin().y << ", " << grid.origin().yaw
        << "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

}  // namespace

OccupancyGrid readMapServerMap(const std::string& yaml_path, double free_threshold) {
  const MapDescription map = DescriptionReader(yaml_path).read();
  const double free_below = free_threshold >= 0.0 ? free_threshold : map.free_threshold;
  const cv::Mat image = readImage(yaml_path, map.image);

  OccupancyGrid grid;
  try {
    grid = OccupancyGrid(image.cols, image.rows, map.resolution, map.origin, Cell::kUnknown);
  } catch (const std::invalid_argument& error) {
    throw MapFileError("the map " + yaml_path + " cannot be used: " + error.what());
  }
  const bool has_alpha = image.channels() == 2 || image.channels() == 4;
  const int channels = image.channels() - (has_alpha && !map.counts_alpha ? 1 : 0);
  for (int row = 0; row < image.rows; ++row) {
    const std::uint8_t* line = image.ptr<std::uint8_t>(image.rows - 1 - row);  // the first line is the highest row
    for (int column = 0; column < image.cols; ++column) {
      double sum = 0.0;
      for (int channel = 0; channel < channels; ++channel) sum += line[column * image.channels() + channel];
      const double value = sum / channels;
      const double occupied = (map.negate ? value : 255.0 - value) / 255.0;
      if (occupied > map.occupied_threshold) {
        grid.set({column, row}, Cell::kOccupied);
      } else if (occupied < free_below) {
        grid.set({column, row}, Cell::kFree);
      }
    }
  }
  checkHasFreeCell(grid, map, free_below, yaml_path);
  return grid;
}

std::pair<std::string, double> splitFreeThreshold(const std::string& text) {
  const std::size_t sign = text.rfind('=');
  if (sign == std::string::npos) return {text, kThresholdOfFile};
  std::istringstream stream(text.substr(sign + 1));
  stream.imbue(std::locale::classic());
  double threshold = 0.0;
  if (!(stream >> threshold) || !stream.eof()) return {text, kThresholdOfFile};
  if (threshold < 0.0 || threshold > 1.0) {
    throw MapFileError("the map " + text + " has free_thresh '" + text.substr(sign + 1) +
                       "', expected a number in [0, 1]");
  }
  return {text.substr(0, sign), threshold};
}

OccupancyGrid readClosedMap(const std::string& text) {
  const auto [file, free_threshold] = splitFreeThreshold(text);
  OccupancyGrid grid = readMapServerMap(file, free_threshold);
  for (const CellIndex cell : grid.cells()) {
    if (grid.at(cell) == Cell::kUnknown) grid.set(cell, Cell::kOccupied);
  }
  return grid;
}

void writeMapServerMap(const std::string& stem, const OccupancyGrid& grid) {
  if (grid.columns() == 0 || grid.rows() == 0) throw MapFileError("the map " + stem + " has no cells to write");
  const std::string image_path = stem + ".pgm";
  const std::string yaml_path = stem + ".yaml";
  try {
    OutputFile image(image_path);
    OutputFile yaml(yaml_path);
    writeImage(grid, &image.stream());
    writeDescription(grid, image_path.substr(image_path.rfind('/') + 1), &yaml.stream());
    image.commit();
    yaml.commit();
  } catch (const OutputFileError& error) {
    throw MapFileError("the map " + yaml_path + " cannot be written: " + error.what());
  }
}

}  // namespace lstm_planner
