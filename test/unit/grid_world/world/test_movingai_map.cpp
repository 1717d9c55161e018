#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "unit/grid_world/world/movingai_fixtures.hpp"

namespace lstm_planner::test_movingai_map {
namespace {

class MovingAiMap : public MovingAiFiles {
 protected:
  /// What reading says about a map with this content.
  std::string said(const std::string& content) const {
    const std::string path = write("a.map", content);
    return refusal([&] { readMovingAiMap(path); });
  }
};

/// One letter a cell: `.` passable, `@` not; rows behind each other.
std::string lettersOf(const PassableGrid& grid) {
  std::string letters;
  for (const CellIndex cell : grid.cells()) letters += grid.passable(cell) ? '.' : '@';
  return letters;
}

TEST_F(MovingAiMap, HasItsFirstLineAsRowZero) {
  const PassableGrid grid = readMovingAiMap(write("a.map", "type octile\nheight 2\nwidth 3\nmap\n.@@\n@.@\n"));
  EXPECT_EQ(grid.columns(), 3);
  EXPECT_EQ(grid.rows(), 2);
  EXPECT_EQ(lettersOf(grid), ".@@@.@");
}

TEST_F(MovingAiMap, KnowsAllLettersUnderBothRules) {
  const std::string path = write("a.map", "type octile\nheight 1\nwidth 7\nmap\n.GSWT@O\n");
  EXPECT_EQ(lettersOf(readMovingAiMap(path, PassableRule::kBenchmark)), "...@@@@");
  EXPECT_EQ(lettersOf(readMovingAiMap(path, PassableRule::kThesis)), ".@@@@@@");
}

TEST_F(MovingAiMap, MayHaveForeignLineEndsAndNoLastOne) {
  for (const std::string content :
       {"type octile\r\nheight 2\r\nwidth 2\r\nmap\r\n.@\r\n@.\r\n", "type octile\nheight 2\nwidth 2\nmap\n.@\n@.",
        "type octile\r\nheight 2\r\nwidth 2\r\nmap\r\n.@\r\n@.", "type octile\nwidth 2\nheight 2\nmap\n.@\n@.\n\n\r\n",
        "type  octile\nheight\t2\nwidth 2 \nmap \n.@\n@.\n"}) {
    EXPECT_EQ(lettersOf(readMovingAiMap(write("a.map", content))), ".@@.") << content;
  }
}

TEST_F(MovingAiMap, RefusesUnknownLettersWithLineAndColumn) {
  const std::string head = "type octile\nheight 2\nwidth 3\nmap\n";
  EXPECT_EQ(said(head + "...\n.x.\n"),
            "the map a.map, line 6, column 2: 'x' is no terrain, expected one of . G S W T @ O");
  EXPECT_EQ(said(head + "..\t\n...\n"),
            "the map a.map, line 5, column 3: '\\x09' is no terrain, expected one of . G S W T @ O");
}

TEST_F(MovingAiMap, RefusesRowsThatAreNotAsSaid) {
  const std::string head = "type octile\nheight 2\nwidth 3\nmap\n";
  EXPECT_EQ(said(head + "...\n..\n"), "the map a.map, line 6: row 2 has 2 letters, expected 3 as width says");
  EXPECT_EQ(said(head + "....\n...\n"), "the map a.map, line 5: row 1 has 4 letters, expected 3 as width says");
  EXPECT_EQ(said(head + "\n...\n"), "the map a.map, line 5: row 1 has 0 letters, expected 3 as width says");
  EXPECT_EQ(said(head + "...\n"), "the map a.map, line 6: the file ends after 1 rows, expected 2 as height says");
  EXPECT_EQ(said(head + "...\n...\n...\n"), "the map a.map, line 7: more lines follow the 2 rows that height says");
}

TEST_F(MovingAiMap, RefusesSizesThatNoGridHas) {
  const auto saidOf = [&](const std::string& height, const std::string& width) {
    return said("type octile\nheight " + height + "\nwidth " + width + "\nmap\n.\n");
  };
  const std::string expected = ", expected a whole number from 1 to 2^26";
  EXPECT_EQ(saidOf("0", "1"), "the map a.map, line 2: height is '0'" + expected);
  EXPECT_EQ(saidOf("1", "-1"), "the map a.map, line 3: width is '-1'" + expected);
  EXPECT_EQ(saidOf("1", "1.5"), "the map a.map, line 3: width is '1.5'" + expected);
  EXPECT_EQ(saidOf("1", "wide"), "the map a.map, line 3: width is 'wide'" + expected);
  EXPECT_EQ(saidOf("99999999999999999999", "1"), "the map a.map, line 2: height is '99999999999999999999'" + expected);
  EXPECT_EQ(saidOf("8193", "8192"),
            "the map a.map, line 3: height and width make 67117056 cells, expected at most 2^26");
}

/// Exits with 0 when a map with 64 MiB of cells and one letter is refused in a process that may take 32 MiB more.
[[noreturn]] void refuseWithLittleMemory(const std::string& path) {
  std::ifstream statistics("/proc/self/statm");
  rlim_t pages = 0;
  statistics >> pages;
  const rlim_t limit = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{32} << 20);
  const rlimit address_space{limit, limit};
  if (!statistics || setrlimit(RLIMIT_AS, &address_space) != 0) std::_Exit(2);
  try {
    readMovingAiMap(path);
  } catch (const MovingAiFileError&) {
    std::_Exit(0);
  } catch (const std::bad_alloc&) {
    std::_Exit(1);
  }
  std::_Exit(3);
}

TEST_F(MovingAiMap, IsRefusedBeforeMemoryForTheGridIsTaken) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer takes more address space than may be left";
#endif
  const std::string path = write("a.map", "type octile\nheight 8192\nwidth 8192\nmap\n.\n");
  EXPECT_EXIT(refuseWithLittleMemory(path), ::testing::ExitedWithCode(0), "");
}

TEST_F(MovingAiMap, RefusesOtherHeaders) {
  EXPECT_EQ(said(""), "the map a.map is empty");
  EXPECT_EQ(said("type tile\n"), "the map a.map, line 1: 'type tile', expected 'type octile'");
  EXPECT_EQ(said("type octile\nheight 1\nheight 1\n"),
            "the map a.map, line 3: 'height 1', expected one line 'height N' and one 'width N'");
  EXPECT_EQ(said("type octile\nheight 1\nwidth 1\n.\n"), "the map a.map, line 4: '.', expected 'map'");
  EXPECT_EQ(said("type octile\nheight 1\n"), "the map a.map, line 3: the file ends, expected height and width");
}

TEST_F(MovingAiMap, RefusesWhatIsNoFile) {
  EXPECT_EQ(refusal([&] { readMovingAiMap(in("missing.map")); }),
            "the map missing.map cannot be read: there is no such file");
  EXPECT_EQ(refusal([&] { readMovingAiMap(folder_); }), "the map  cannot be read: it is a folder, expected a file");
  EXPECT_THROW(readMovingAiMap("/dev/zero"), MovingAiFileError);
}

TEST_F(MovingAiMap, IsWrittenAsItIsRead) {
  Random random(1);
  PassableGrid grid(31, 17, true);
  for (const CellIndex cell : grid.cells()) grid.set(cell, uniform(random) < 0.5);
  const std::string path = in("b.map");
  writeMovingAiMap(path, grid);
  const PassableGrid again = readMovingAiMap(path);
  EXPECT_EQ(again.columns(), 31);
  EXPECT_EQ(lettersOf(again), lettersOf(grid));
  EXPECT_EQ(lettersOf(readMovingAiMap(path, PassableRule::kThesis)), lettersOf(grid));
}

TEST_F(MovingAiMap, IsNotWrittenWithoutCellsOrWhereItCannotBe) {
  EXPECT_THROW(writeMovingAiMap(in("b.map"), PassableGrid()), MovingAiFileError);
  EXPECT_EQ(refusal([&] { writeMovingAiMap(in("missing/b.map"), PassableGrid(1, 1, true)); }),
            "the map missing/b.map cannot be written: No such file or directory");
}

}  // namespace
}  // namespace lstm_planner::test_movingai_map
