#include "collection.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <morsel/error.hpp>

#include "base/test_folder.hpp"

namespace morsel::bench {
namespace {

namespace fs = std::filesystem;

class CollectionTest : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text = "") const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }

  TestFolder temporary_;
  fs::path folder_ = temporary_.path();
};

TEST_F(CollectionTest, ReadsAPrincetonClassification) {
  write("models/m7.off");
  write("models/m12.off");
  write("models/m99.off");
  write("train.cla", "PSB 1\n3 3\n\nanimal 0 0\n\ncat animal 2\n7\n12\n\ndog animal 1\n5\n");
  const auto shapes = read_classification(folder_ / "train.cla", folder_ / "models");
  ASSERT_EQ(shapes.size(), 2U);
  EXPECT_EQ(shapes[0].name, "m12");
  EXPECT_EQ(shapes[0].category, "cat");
  write("bad.cla", "PSB 1\n1 1\ncat animal\n");
  EXPECT_THROW((void)read_classification(folder_ / "bad.cla", folder_), Error);
}

TEST_F(CollectionTest, FoldersAreClasses) {
  write("set/cups/a.ply");
  write("set/cups/b.ply");
  write("set/forks/c.ply");
  const auto shapes = list_shapes(folder_ / "set", {});
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(shapes[1].category, "cups");
  EXPECT_EQ(shapes[2].category, "forks");
}

TEST_F(CollectionTest, NumberedMeshesAreCategoriesOfTwenty) {
  write("off/20.off");
  write("off/21.off");
  const auto shapes = list_shapes(folder_, {});
  ASSERT_EQ(shapes.size(), 2U);
  EXPECT_EQ(shapes[0].category, "Human");
  EXPECT_EQ(shapes[1].category, "Cup");
}

}  // namespace
}  // namespace morsel::bench
