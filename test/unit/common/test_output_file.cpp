#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <iterator>

#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "support/folder_test.hpp"

namespace lstm_planner::test_output_file {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public test::FolderTest {
 protected:
  long files() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }
  std::string content(const std::string& name) const { return readInputFile(in(name), 1000); }
  void write(const std::string& name, const std::string& text) const {
    writeOutputFile("file", in(name), [&](std::ostream& file) { file << text; });
  }
};

TEST_F(OutputFileTest, AppearsWholeOrNotAtAll) {
  {
    OutputFile file(in("a"));
    file.stream() << "half";
    EXPECT_FALSE(fs::exists(in("a")));
  }
  EXPECT_EQ(files(), 0);
  write("a", "whole");
  EXPECT_EQ(content("a"), "whole");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, LeavesTheOldFileWhereTheDiskIsFull) {
  write("a", "old");
  const auto none = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit little = before;
  little.rlim_cur = 4096;
  ::setrlimit(RLIMIT_FSIZE, &little);
  std::string sentence;
  try {
    write("a", std::string(100000, 'x'));
  } catch (const std::runtime_error& error) {
    sentence = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, none);
  EXPECT_EQ(sentence, "file '" + in("a") + "' cannot be written: File too large");
  EXPECT_EQ(content("a"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, NothingIsLeftOfWhatASignalInterrupts) {
  OutputFile file(in("a"));
  OutputFile other(in("b"));
  file.stream() << "half" << std::flush;
  other.stream() << "half" << std::flush;
  ASSERT_EQ(files(), 2);
  removeUnfinishedFiles();
  EXPECT_EQ(files(), 0);
}

TEST_F(OutputFileTest, KeepsLinksAndRights) {
  write("a", "old");
  fs::permissions(in("a"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(in("a"), in("link"));
  write("link", "new");
  EXPECT_TRUE(fs::is_symlink(in("link")));
  EXPECT_EQ(content("a"), "new");
  EXPECT_EQ(fs::status(in("a")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFileTest, KeepsLinksToFilesThatAreNotThereYet) {
  fs::create_symlink("next", in("link"));
  fs::create_symlink("later", in("next"));
  write("link", "new");
  EXPECT_TRUE(fs::is_symlink(in("link")) && fs::is_symlink(in("next")));
  EXPECT_EQ(content("later"), "new");
  fs::create_symlink("ring", in("ring"));
  write("ring", "new");
  EXPECT_EQ(content("ring"), "new");
}

TEST_F(OutputFileTest, WritesDevicesDirectly) {
  EXPECT_NO_THROW(writeOutputFile("file", "/dev/null", [](std::ostream& file) { file << "text"; }));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(OutputFileTest, DoesNotReplaceWhatIsNotToBeReplaced) {
  OutputFile file(in("a"), OutputFile::Existing::kRefuse);
  file.stream() << "new";
  write("a", "somebody else's");
  try {
    file.commit();
    ADD_FAILURE() << "replaced";
  } catch (const OutputFileError& error) {
    EXPECT_STREQ(error.what(), "there is such a file already");
  }
  EXPECT_EQ(content("a"), "somebody else's");
}

}  // namespace
}  // namespace lstm_planner::test_output_file
