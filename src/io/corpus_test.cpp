// Every file of tests/corpus/bad is refused with one line that says why.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <morsel/error.hpp>
#include <morsel/io.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace morsel {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(MORSEL_CORPUS_DIR) / "bad";

struct Case {
  std::string file;
  std::string message;

  friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.file; }
};

std::vector<Case> load_cases() {
  std::vector<Case> cases;
  std::ifstream table(kFolder / "expected.txt");
  for (std::string line; std::getline(table, line);) {
    const std::size_t bar = line.find(" | ");
    if (line.starts_with('#') || bar == std::string::npos) continue;
    cases.push_back({line.substr(0, bar), line.substr(bar + 3)});
  }
  return cases;
}

class BadFileTest : public ::testing::TestWithParam<Case> {};

TEST_P(BadFileTest, IsRefusedWithOneLine) {
  const std::filesystem::path path = kFolder / GetParam().file;
  try {
    const PointCloud cloud = read_points(path);
    FAIL() << "read " << cloud.points.size() << " points";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), ErrorCode::kInput);
    EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
    EXPECT_TRUE(message.find(kFolder.string()) == 0) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadFileTest, ::testing::ValuesIn(load_cases()),
                         [](const auto& test) {
                           std::string name = test.param.file;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

TEST(BadFilesTest, TheTableNamesEveryFile) {
  const auto files = std::distance(std::filesystem::directory_iterator(kFolder),
                                   std::filesystem::directory_iterator());
  EXPECT_EQ(static_cast<std::size_t>(files), load_cases().size() + 1);
  EXPECT_GE(files, 40);
}

}  // namespace
}  // namespace morsel
