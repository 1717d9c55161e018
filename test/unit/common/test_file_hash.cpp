#include <gtest/gtest.h>

#include "lstm_planner/common/file_hash.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner::test_file_hash {
namespace {

TEST(FileHash, IsWhatSha1sumPrints) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("abc", "abc");
  EXPECT_EQ(sha1OfFile(path), "a9993e364706816aba3e25717850c26c9cd0d89d");  // FIPS 180-4, the first example
  EXPECT_EQ(sha1OfFile(path + "?"), "unreadable");
}

}  // namespace
}  // namespace lstm_planner::test_file_hash
