#include "dataset.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <morsel/error.hpp>

#include "base/test_folder.hpp"

namespace morsel::bench {
namespace {

namespace fs = std::filesystem;

class DatasetTest : public testing::Test {
 protected:
  DatasetTest() { fs::create_directories(folder_ / "off"); }

  fs::path write(const fs::path& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  TestFolder temporary_;
  fs::path folder_ = temporary_.path();
};

TEST(IdFilter, TakesAllOrAResidue) {
  EXPECT_TRUE(IdFilter::parse("all").accepts(7));
  EXPECT_TRUE(IdFilter::parse("3mod4").accepts(7));
  EXPECT_FALSE(IdFilter::parse("1mod4").accepts(7));
  for (const char* text : {"", "odd", "4mod4", "1mod", "mod4", "-1mod4", "1mod0"}) {
    EXPECT_THROW(static_cast<void>(IdFilter::parse(text)), Error) << text;
  }
}

TEST(Categories, AreTwentyIdsEach) {
  EXPECT_EQ(category_name(category_of(1)), "Human");
  EXPECT_EQ(category_name(category_of(20)), "Human");
  EXPECT_EQ(category_name(category_of(21)), "Cup");
  EXPECT_EQ(category_name(category_of(281)), "Armadillo");
  EXPECT_EQ(category_name(category_of(400)), "FourLeg");
  EXPECT_EQ(category_name(category_of(401)), "(other)");
}

TEST_F(DatasetTest, ListsWhatIsThereInNumericOrder) {
  for (const char* name : {"off/10.off", "off/9.off", "off/2.off", "off/readme.txt", "off/x.off",
                           "seg/9/9_10.seg", "seg/9/9_2.seg", "seg/9/8_1.seg"}) {
    write(name, "");
  }
  const auto models = list_models(folder_, {});
  ASSERT_EQ(models.size(), 3U);
  EXPECT_EQ(models[0].id, 2);
  EXPECT_EQ(models[1].id, 9);
  EXPECT_EQ(models[2].id, 10);
  ASSERT_EQ(models[1].people.size(), 2U);
  EXPECT_EQ(models[1].people[0].filename(), "9_2.seg");
  EXPECT_EQ(models[1].people[1].filename(), "9_10.seg");
  EXPECT_TRUE(models[0].people.empty());
}

TEST_F(DatasetTest, SaysWhenNothingIsThere) {
  EXPECT_THROW(static_cast<void>(list_models(folder_, {})), Error);
  EXPECT_THROW(static_cast<void>(list_models(folder_ / "missing", {})), Error);
}

TEST_F(DatasetTest, ReadsLabels) {
  EXPECT_EQ(read_face_labels(write("a.seg", "0\n2\r\n 1 \n\n"), 3), (std::vector<int>{0, 2, 1}));
  EXPECT_THROW(static_cast<void>(read_face_labels(write("b.seg", "0\n1\n"), 3)), Error);
  EXPECT_THROW(static_cast<void>(read_face_labels(write("c.seg", "0\nx\n1\n"), 3)), Error);
  EXPECT_THROW(static_cast<void>(read_face_labels(folder_ / "missing.seg", 3)), Error);
}

TEST_F(DatasetTest, ReadsAllPeople) {
  write("off/9.off", "");
  const auto people = [&](std::size_t faces) {
    return read_people(list_models(folder_, {}).front(), faces);
  };
  EXPECT_THROW(static_cast<void>(people(2)), Error) << "there is nobody";
  write("seg/9/9_1.seg", "0\n4\n");
  write("seg/9/9_0.seg", "7\n7\n");
  EXPECT_EQ(people(2), (std::vector<std::vector<int>>{{7, 7}, {0, 4}}));
  try {
    static_cast<void>(people(3));
    FAIL() << "two labels for three faces";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("9_0.seg"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace morsel::bench
