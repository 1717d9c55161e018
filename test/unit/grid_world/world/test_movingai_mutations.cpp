#include <string>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "unit/grid_world/world/movingai_fixtures.hpp"

namespace lstm_planner::test_movingai_mutations {
namespace {

class MovingAiMutations : public MovingAiFiles {};

constexpr int kMutations = 3000;

/// A piece of the content removed, doubled or replaced by what readers stumble over.
std::string mutated(std::string content, Random& random) {
  const std::vector<std::string> pieces = {
      "\n",  "\r",  "\t",     " ",      std::string(1, '\0'), "\xff", "-", "0", "9999999999", "@", "x", "1e308",
      "nan", "map", "octile", "version"};
  for (std::size_t change = 0; change <= uniformIndex(random, 3); ++change) {
    const std::size_t at = uniformIndex(random, content.size() + 1);
    const std::size_t length = uniformIndex(random, 6);
    switch (uniformIndex(random, 4)) {
      case 0:
        content.erase(at, length);
        break;
      case 1:
        content.insert(at, content.substr(at, length));
        break;
      case 2:
        content.replace(at, length, pieces[uniformIndex(random, pieces.size())]);
        break;
      default:
        content.resize(at);
    }
  }
  return content;
}

/// Reads mutations of a file; returns how many were refused. Any other exception fails the test.
template <typename Read>
int refusedOf(const std::string& content, std::uint64_t seed, const Read& read) {
  Random random(seed);
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string changed = mutated(content, random);
    try {
      read(changed);
    } catch (const MovingAiFileError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  return refused;
}

TEST_F(MovingAiMutations, OfMapsAreReadAsSaidOrRefused) {
  const std::string valid = "type octile\nheight 3\nwidth 4\nmap\n.@.G\nTSW.\nO..@\n";
  const int refused = refusedOf(valid, 1, [&](const std::string& content) {
    const PassableGrid grid = readMovingAiMap(write("a.map", content));
    EXPECT_LE(grid.size(), content.size()) << "a cell without a letter in: " << content;
  });
  EXPECT_GT(refused, kMutations / 2);  // most changes of a file this small break it
  EXPECT_LT(refused, kMutations);      // others turn one letter into another
}

TEST_F(MovingAiMutations, OfScenariosAreReadAsSaidOrRefused) {
  const std::string valid = "version 1\n0\ta.map\t4\t3\t0\t1\t3\t2\t3.41421\n1\ta.map\t4\t3\t0\t0\t3\t2\t4\n";
  const int refused = refusedOf(valid, 2, [&](const std::string& content) {
    const std::vector<Scenario> scenarios = readScenarios(write("a.scen", content));
    std::filesystem::remove(in("again.scen"));
    EXPECT_NO_THROW(writeScenarios(in("again.scen"), scenarios)) << "read, but not to be written: " << content;
  });
  EXPECT_GT(refused, kMutations / 3);
  EXPECT_LT(refused, kMutations);
}

}  // namespace
}  // namespace lstm_planner::test_movingai_mutations
