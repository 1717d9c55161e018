#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lstm_planner/common/csv_file.hpp"
#include "support/folder_test.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_csv_file {
namespace {

class CsvFileTest : public test::FolderTest {
 protected:
  CsvFile read(const std::string& text) const {
    return {scratch_.write("file.csv", text), {"x", "y"}, {"radius", "world"}};
  }
  std::string refusal(const std::string& text) const {
    return test::refusalOf([&] { read(text); });
  }
};

TEST_F(CsvFileTest, TellsWhichOptionalColumnsAreThere) {
  const CsvFile file = read("world,y,x\r\n3,2.5,-1\r\n");
  ASSERT_EQ(file.lines(), 1u);
  EXPECT_TRUE(file.has(0));
  EXPECT_FALSE(file.has(2));
  EXPECT_TRUE(file.has(3));
  EXPECT_EQ(file.number(0, 0), -1.0);
  EXPECT_EQ(file.number(0, 1), 2.5);
  EXPECT_TRUE(std::isnan(file.number(0, 2)));
  EXPECT_EQ(file.number(0, 3), 3.0);
}

TEST_F(CsvFileTest, MayBeginWithAByteOrderMark) { EXPECT_EQ(read("\xef\xbb\xbfx,y\n1,2\n").number(0, 0), 1.0); }

TEST_F(CsvFileTest, LinesHaveABoundedLength) {
  EXPECT_NE(refusal("x,y\n1,2\n" + std::string(70000, ',')).find("line 3: it is longer than 65536 letters"),
            std::string::npos);
}

TEST_F(CsvFileTest, AnOptionalColumnThatIsThereMustHoldNumbers) {
  EXPECT_NE(refusal("x,y,radius\n1,2,wide\n").find("line 2: column radius is 'wide'"), std::string::npos);
  EXPECT_NE(refusal("x,y,radius\n1,2\n").find("line 2: column radius is ''"), std::string::npos);
}

TEST_F(CsvFileTest, RefusesAFileWithoutAColumnThatIsNeeded) {
  EXPECT_NE(refusal("x,radius\n1,2\n").find("names no column 'y'"), std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_csv_file
