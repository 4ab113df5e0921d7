#include <gtest/gtest.h>

#include <fstream>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "store/test_database.hpp"

namespace morsel::store {
namespace {

class IndexTest : public EachDatabaseTest {
 protected:
  ShapeFile shape(const std::string& name, const std::vector<Vec3>& points) const {
    std::ofstream stream(folder_ / name);
    stream.precision(17);
    for (const Vec3& p : points) stream << p.x << ' ' << p.y << ' ' << p.z << '\n';
    return {folder_ / name, name, {}, {}};
  }

  std::vector<ShapeFile> shapes_of(int count) const {
    std::vector<ShapeFile> files;
    for (int i = 0; i < count; ++i) {
      files.push_back(shape("s" + std::to_string(i) + ".xyz",
                            shapes::dumbbell(800, 0.3 + 0.05 * i, static_cast<std::uint64_t>(i))));
    }
    return files;
  }

  static std::string lines_of(const Database& database) {
    std::ostringstream stream;
    database.export_lines(stream);
    return stream.str();
  }
};

MORSEL_FOR_EACH_DATABASE(IndexTest);

TEST_P(IndexTest, StoresThenSkips) {
  Database database = create();
  const std::vector<ShapeFile> files = shapes_of(4);
  IndexReport report = index_files(database, files);
  EXPECT_EQ(report.added, 4U);
  EXPECT_TRUE(report.failures.empty());
  report = index_files(database, files);
  EXPECT_EQ(report.unchanged, 4U);
  shape("s2.xyz", shapes::dumbbell(800, 0.6, 9));
  report = index_files(database, files);
  EXPECT_EQ(report.unchanged, 3U);
  EXPECT_EQ(report.replaced, 1U);
  EXPECT_EQ(database.size(), 4U);
  EXPECT_TRUE(database.check().empty());
}

TEST_P(IndexTest, IsTheSameForAnyNumberOfThreads) {
  const std::vector<ShapeFile> files = shapes_of(5);
  std::vector<std::string> lines;
  for (const int threads : {1, 2, 7}) {
    Database database =
        Database::open(folder_ / (std::to_string(threads) + ".db"), Access::kCreate);
    IndexOptions options;
    options.segment.threads = threads;
    (void)index_files(database, files, options);
    lines.push_back(lines_of(database));
  }
  EXPECT_EQ(lines[1], lines[0]);
  EXPECT_EQ(lines[2], lines[0]);
}

TEST_P(IndexTest, BadFilesDoNotStopTheOthers) {
  Database database = create();
  std::vector<ShapeFile> files = shapes_of(2);
  write(folder_ / "bad.ply", "ply\nnonsense");
  files.insert(files.begin(), {folder_ / "bad.ply", "bad.ply", {}, {}});
  files.push_back({folder_ / "missing.off", "missing.off", {}, {}});
  files.push_back(shape("flat.xyz", std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  files.push_back({folder_ / "s0.xyz", "s1.xyz", {}, {}});
  files.push_back({folder_ / "s0.xyz", "", {}, {}});
  const IndexReport report = index_files(database, files);
  EXPECT_EQ(report.added, 2U);
  ASSERT_EQ(report.failures.size(), 5U);
  EXPECT_EQ(report.failures[0].path, folder_ / "bad.ply");
  EXPECT_NE(report.failures[1].reason.find("No such file"), std::string::npos);
  EXPECT_NE(report.failures[2].reason.find("plane"), std::string::npos);
  EXPECT_NE(report.failures[3].reason.find("its name 's1.xyz' is that of"), std::string::npos);
  EXPECT_NE(report.failures[4].reason.find("the name ''"), std::string::npos);
  std::vector<std::string> failed;
  for (const auto& [name, reason] : database.failures()) failed.push_back(name);
  EXPECT_EQ(failed, (std::vector<std::string>{"bad.ply", "flat.xyz", "missing.off"}));
  EXPECT_NE(database.failures().at("flat.xyz").find("plane"), std::string::npos);
  shape("flat.xyz", shapes::dumbbell(800));
  (void)index_files(database, files);
  EXPECT_EQ(database.failures().size(), 2U);
}

TEST_P(IndexTest, KeepsTheClassAndAddsTags) {
  Database database = create();
  std::vector<ShapeFile> files = shapes_of(1);
  files[0].class_name = "dumbbell";
  files[0].tags = {"b"};
  (void)index_files(database, files);
  files[0].class_name.reset();
  files[0].tags = {"a"};
  EXPECT_EQ(index_files(database, files).replaced, 1U);
  EXPECT_EQ(database.find("s0.xyz")->class_name, "dumbbell");
  EXPECT_EQ(database.find("s0.xyz")->tags, (std::vector<std::string>{"a", "b"}));
}

TEST_P(IndexTest, WhatWasDoneBeforeACancelStays) {
  Database database = create();
  const std::vector<ShapeFile> files = shapes_of(6);
  Progress progress([&](std::string_view, double share) {
    if (share > 0.4) progress.cancel();
  });
  IndexOptions options;
  options.segment.threads = 1;
  const std::string message = message_of(
      ErrorCode::kCancelled, [&] { (void)index_files(database, files, options, &progress); });
  EXPECT_NE(message.find("3 of 6"), std::string::npos) << message;
  EXPECT_EQ(database.size(), 3U);
  const IndexReport report = index_files(database, files);
  EXPECT_EQ(report.unchanged, 3U);
  EXPECT_EQ(report.added, 3U);
}

TEST_P(IndexTest, ReportsTheShareThatIsDone) {
  Database database = create();
  std::vector<double> shares;
  const Progress progress([&](std::string_view, double share) { shares.push_back(share); });
  IndexOptions options;
  options.segment.threads = 1;
  (void)index_files(database, shapes_of(4), options, &progress);
  EXPECT_EQ(shares, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
}

}  // namespace
}  // namespace morsel::store
