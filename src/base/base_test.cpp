#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <morsel/error.hpp>
#include <morsel/progress.hpp>
#include <string>

#include "base/atomic_file.hpp"
#include "base/random.hpp"
#include "base/test_folder.hpp"

namespace morsel {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
 protected:
  static std::string content(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  TestFolder temporary_;
  fs::path folder_ = temporary_.path();
};

TEST_F(AtomicFileTest, CommitReplacesTheOldContent) {
  const fs::path path = folder_ / "result.txt";
  std::ofstream(path) << "old";
  AtomicFile file(path);
  file.stream() << "new";
  EXPECT_EQ(content(path), "old");
  file.commit();
  EXPECT_EQ(content(path), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(AtomicFileTest, WithoutCommitNothingIsLeft) {
  { AtomicFile(folder_ / "result.txt").stream() << "half"; }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(AtomicFileTest, NamesTheFileThatCannotBeWritten) {
  try {
    AtomicFile file(folder_ / "missing" / "result.txt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kOutput);
    EXPECT_NE(std::string(error.what()).find("missing/result.txt"), std::string::npos);
  }
  EXPECT_THROW(AtomicFile{folder_}, Error);
}

TEST(ProgressTest, CancelStopsAtTheNextReport) {
  int reports = 0;
  Progress progress([&](std::string_view, double) { ++reports; });
  progress.report("read", 0.1);
  EXPECT_EQ(reports, 1);
  progress.cancel();
  EXPECT_THROW(progress.check(), Error);
  EXPECT_THROW(progress.report("read", 0.2), Error);
}

TEST(ProgressTest, APieceIsCancelledWithTheWhole) {
  Progress whole;
  const Progress piece(&whole);
  piece.report("read", 0.5);
  whole.cancel();
  EXPECT_TRUE(piece.cancelled());
  EXPECT_THROW(piece.check(), Error);
}

// The first outputs for a fixed seed, so that samples are the same on every machine for ever.
TEST(RandomTest, IsPortable) {
  Random random(1);
  EXPECT_EQ(random.next(), 14971601782005023387ULL);
  Random again(1);
  again.next();
  EXPECT_EQ(again.next(), random.next());
}

TEST(RandomTest, UniformAndNormalHaveTheirMoments) {
  Random random(7);
  double sum = 0.0;
  double normal_sum = 0.0;
  double normal_squares = 0.0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    sum += random.uniform();
    const double z = random.normal();
    normal_sum += z;
    normal_squares += z * z;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.005);
  EXPECT_NEAR(normal_sum / kDraws, 0.0, 0.02);
  EXPECT_NEAR(normal_squares / kDraws, 1.0, 0.02);
}

}  // namespace
}  // namespace morsel
