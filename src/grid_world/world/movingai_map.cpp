#include <array>

#include "grid_world/world/movingai_text.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner {
namespace {

constexpr std::uintmax_t kLargestMapFile = std::uintmax_t{1} << 28;  // the largest grid with room for any line ends

struct MapSize {
  int rows = 0;
  int columns = 0;
};

/// The next line's words; refuses the end of the file.
std::vector<std::string_view> headerWords(TextLines* lines, const std::string& expected) {
  if (!lines->next()) lines->refuse("the file ends, expected " + expected);
  return wordsOf(lines->line());
}

/// Reads `height` and `width`, whichever comes first.
MapSize readSize(TextLines* lines) {
  MapSize size;
  for (int line = 0; line < 2; ++line) {
    const std::vector<std::string_view> words = headerWords(lines, "height and width");
    int* side = nullptr;
    if (words.size() == 2 && words[0] == "height" && size.rows == 0) side = &size.rows;
    if (words.size() == 2 && words[0] == "width" && size.columns == 0) side = &size.columns;
    if (side == nullptr) lines->refuse(printable(lines->line()) + ", expected one line 'height N' and one 'width N'");
    if (!parseInteger(words[1], side) || *side < 1 || *side > PassableGrid::kMostCells) {
      lines->refuse(std::string(words[0]) + " is " + printable(words[1]) + ", expected a whole number from 1 to 2^26");
    }
  }
  if (std::int64_t{size.rows} * size.columns > PassableGrid::kMostCells) {
    lines->refuse("height and width make " + std::to_string(std::int64_t{size.rows} * size.columns) +
                  " cells, expected at most 2^26");
  }
  return size;
}

MapSize readHeader(TextLines* lines) {
  const std::vector<std::string_view> type = headerWords(lines, "'type octile'");
  if (type.size() != 2 || type[0] != "type" || type[1] != "octile") {
    lines->refuse(printable(lines->line()) + ", expected 'type octile'");
  }
  const MapSize size = readSize(lines);
  const std::vector<std::string_view> map = headerWords(lines, "'map'");
  if (map.size() != 1 || map[0] != "map") lines->refuse(printable(lines->line()) + ", expected 'map'");
  return size;
}

/// What a letter means under a rule.
enum class Terrain : std::uint8_t { kNone, kPassable, kBlocked };

std::array<Terrain, 256> terrainOf(PassableRule rule) {
  std::array<Terrain, 256> terrain{};
  const auto set = [&](const char* letters, Terrain kind) {
    for (; *letters != '\0'; ++letters) terrain[static_cast<unsigned char>(*letters)] = kind;
  };
  set(".GSW@OT", Terrain::kBlocked);
  set(rule == PassableRule::kBenchmark ? ".GS" : ".", Terrain::kPassable);
  return terrain;
}

void checkRow(const TextLines& lines, const MapSize& size, int row, const std::array<Terrain, 256>& terrain) {
  const std::string_view letters = lines.line();
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (terrain[static_cast<unsigned char>(letters[i])] == Terrain::kNone) {
      lines.refuseLetter(i + 1, printable(letters.substr(i, 1)) + " is no terrain, expected one of . G S W T @ O");
    }
  }
  if (letters.size() != static_cast<std::size_t>(size.columns)) {
    lines.refuse("row " + std::to_string(row + 1) + " has " + std::to_string(letters.size()) + " letters, expected " +
                 std::to_string(size.columns) + " as width says");
  }
}

/// All rows, checked; so the grid is made only for a file that fills it.
std::vector<std::string_view> readRows(TextLines* lines, const MapSize& size, const std::array<Terrain, 256>& terrain) {
  std::vector<std::string_view> rows;
  for (int row = 0; row < size.rows; ++row) {
    if (!lines->next() || (lines->line().empty() && lines->onlyEmptyLinesFollow())) {
      lines->refuse("the file ends after " + std::to_string(row) + " rows, expected " + std::to_string(size.rows) +
                    " as height says");
    }
    checkRow(*lines, size, row, terrain);
    rows.push_back(lines->line());
  }
  if (!lines->onlyEmptyLinesFollow()) {
    lines->next();
    lines->refuse("more lines follow the " + std::to_string(size.rows) + " rows that height says");
  }
  return rows;
}

void writeRows(const PassableGrid& grid, std::ostream* file) {
  *file << "type octile\nheight " << std::to_string(grid.rows()) << "\nwidth " << std::to_string(grid.columns())
        << "\nmap\n";
  std::string letters(static_cast<std::size_t>(grid.columns()) + 1, '\n');
  for (int row = 0; row < grid.rows() && *file; ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      letters[static_cast<std::size_t>(column)] = grid.passable({column, row}) ? '.' : '@';
    }
    *file << letters;
  }
}

}  // namespace

PassableGrid readMovingAiMap(const std::string& path, PassableRule rule) {
  TextLines lines("map", path, kLargestMapFile);
  const MapSize size = readHeader(&lines);
  const std::array<Terrain, 256> terrain = terrainOf(rule);
  const std::vector<std::string_view> rows = readRows(&lines, size, terrain);
  PassableGrid grid(size.columns, size.rows, false);
  for (const CellIndex cell : grid.cells()) {
    const char letter = rows[static_cast<std::size_t>(cell.row)][static_cast<std::size_t>(cell.column)];
    grid.set(cell, terrain[static_cast<unsigned char>(letter)] == Terrain::kPassable);
  }
  return grid;
}

void writeMovingAiMap(const std::string& path, const PassableGrid& grid) {
  if (grid.size() == 0) throw MovingAiFileError("the map " + path + " has no cells to write");
  try {
    OutputFile file(path);
    writeRows(grid, &file.stream());
    file.commit();
  } catch (const OutputFileError& error) {
    throw MovingAiFileError("the map " + path + " cannot be written: " + error.what());
  }
}

}  // namespace lstm_planner
