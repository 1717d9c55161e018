#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/harness.hpp"
#include "lstm_planner/common/random.hpp"

// What the fuzzers do for hours, in a moment: every input of the corpus, among them all that failed once, and some
// mutations of them, the same ones every time.

namespace lstm_planner::fuzz {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kMutations = 100;  // of each harness

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const auto& [name, harness] : harnesses()) names.push_back(name);
  return names;
}

std::vector<std::filesystem::path> corpus(const std::string& harness) {
  const std::filesystem::path folder = std::filesystem::path(LSTM_PLANNER_SOURCE_DIR "/test/fuzz/corpus") / harness;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Bytes bytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

std::string hexadecimal(const Bytes& bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) text += {kDigits[byte / 16], kDigits[byte % 16]};
  return text;
}

/// Changes, removes, repeats or inserts some bytes, or swaps the end for another input's.
void mutate(const Bytes& other, Random* random, Bytes* bytes) {
  const auto place = [&](const Bytes& in) { return static_cast<std::ptrdiff_t>(uniformIndex(*random, in.size() + 1)); };
  const std::ptrdiff_t first = place(*bytes);
  const std::ptrdiff_t last = std::min<std::ptrdiff_t>(
      first + 1 + static_cast<std::ptrdiff_t>(uniformIndex(*random, 8)), static_cast<std::ptrdiff_t>(bytes->size()));
  switch (uniformIndex(*random, 5)) {
    case 0:
      for (auto i = first; i < last; ++i)
        (*bytes)[static_cast<std::size_t>(i)] ^= static_cast<std::uint8_t>(1U << uniformIndex(*random, 8));
      break;
    case 1:
      for (auto i = first; i < last; ++i)
        (*bytes)[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(uniformIndex(*random, 256));
      break;
    case 2:
      bytes->erase(bytes->begin() + first, bytes->begin() + last);
      break;
    case 3: {
      const Bytes repeated(bytes->begin() + first, bytes->begin() + last);
      bytes->insert(bytes->begin() + first, repeated.begin(), repeated.end());
      break;
    }
    default:
      bytes->resize(static_cast<std::size_t>(first));
      bytes->insert(bytes->end(), other.begin() + place(other), other.end());
  }
}

class FuzzCorpus : public ::testing::TestWithParam<std::string> {
 protected:
  void run(const Bytes& input, const std::string& origin) {
    try {
      harnesses().at(GetParam())(input.data(), input.size());
    } catch (const std::exception& error) {
      ADD_FAILURE() << origin << ": " << error.what() << "\ninput: " << hexadecimal(input).substr(0, 2000);
    }
  }
};

TEST_P(FuzzCorpus, IsTakenOrRefused) {
  const std::vector<std::filesystem::path> files = corpus(GetParam());
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) run(bytesOf(file), file.filename());
  run({}, "nothing");
}

TEST_P(FuzzCorpus, MutationsAreTakenOrRefused) {
  std::vector<Bytes> inputs;
  for (const auto& file : corpus(GetParam())) inputs.push_back(bytesOf(file));
  ASSERT_FALSE(inputs.empty());
  Random random(1);
  for (int i = 0; i < kMutations && !HasFailure(); ++i) {
    Bytes input = inputs[uniformIndex(random, inputs.size())];
    for (std::size_t change = 0; change <= uniformIndex(random, 4); ++change) {
      mutate(inputs[uniformIndex(random, inputs.size())], &random, &input);
    }
    run(input, "mutation " + std::to_string(i));
  }
}

INSTANTIATE_TEST_SUITE_P(Harnesses, FuzzCorpus, ::testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace lstm_planner::fuzz
