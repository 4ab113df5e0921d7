#include <gtest/gtest.h>

#include <algorithm>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "store/test_database.hpp"

namespace morsel::store {
namespace {

class SearchTest : public EachDatabaseTest {
 protected:
  // Names so that ties, the same content under two names, are not in the order of their storing.
  void fill(Database& database, std::uint64_t count) {
    const ShapeData first = dumbbell_data();
    for (std::uint64_t i = 0; i < count; ++i) {
      const ShapeData data = varied(first, i);
      database.put({"z" + std::to_string(i), {}, {}, {}}, data);
      if (i % 3 == 0) database.put({"a" + std::to_string(i), {}, {}, {}}, data);
    }
  }

  // The answer by scoring every shape.
  static std::vector<std::string> best(const Database& database, const Signature& query,
                                       std::size_t top) {
    std::vector<std::pair<double, std::string>> all;
    for (const ShapeInfo& info : database.list()) {
      all.emplace_back(-match_score(query, database.get(info.name).data.signature), info.name);
    }
    std::sort(all.begin(), all.end());
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(top, all.size()); ++i) names.push_back(all[i].second);
    return names;
  }

  static std::vector<std::string> names_of(const std::vector<LookAlike>& hits) {
    std::vector<std::string> names;
    for (const LookAlike& hit : hits) names.push_back(hit.info.name);
    return names;
  }

  [[nodiscard]] std::vector<std::filesystem::path> blocks() const {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      if (entry.path().extension() == ".block") paths.push_back(entry.path());
    }
    return paths;
  }

  void remove_all_but_blocks() const {
    if (on_server()) {
      run("DROP SCHEMA morsel CASCADE");
    } else {
      std::filesystem::remove(place_);
    }
  }
};

MORSEL_FOR_EACH_DATABASE(SearchTest);

TEST_P(SearchTest, EqualsTheExhaustiveAnswer) {
  Database database = create();
  fill(database, 30);
  for (const std::uint64_t seed : {3U, 100U, 101U}) {
    const Signature query = varied(dumbbell_data(), seed).signature;
    for (const std::size_t top : {1U, 5U, 1000U}) {
      EXPECT_EQ(names_of(database.search(query, top)), best(database, query, top));
    }
  }
}

TEST_P(SearchTest, FindsWhatAPieceIsOf) {
  Database database = create();
  database.put({"dumbbell", {}, {}, {}}, dumbbell_data());
  const SegmentOptions options;
  const std::vector<Vec3> torus = shapes::torus(1500, 1.0, 0.4);
  database.put({"torus", {}, {}, {}},
               make_shape_data(segment(torus, options), options, content_key(torus, options)));
  Sketch piece;
  for (const Vec3& p : shapes::torus(2500, 1.0, 0.4, 2)) {
    if (p.x + p.y < 0.3) piece.points.push_back(3.0 * Vec3{p.y, p.z, p.x});
  }
  piece.parts.assign(piece.points.size(), -1);
  const MatchOptions partial{.mode = MatchMode::kPartial};
  const auto hits = database.search_partial(piece, 2, partial);
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_EQ(hits[0].info.name, "torus");
  EXPECT_GT(hits[0].score, 0.8);
  EXPECT_LT(hits[1].score, hits[0].score - 0.1);
  EXPECT_THROW((void)database.search(dumbbell_data().signature, 1, partial), Error);
}

TEST_P(SearchTest, FindsItselfFirst) {
  Database database = create();
  fill(database, 10);
  const auto hits = database.search(database.get("z4").data.signature, 3);
  ASSERT_EQ(hits.size(), 3U);
  EXPECT_EQ(hits[0].info.name, "z4");
  EXPECT_EQ(hits[0].score, 1.0);
}

TEST_P(SearchTest, AnEmptyDatabaseHasNoAnswer) {
  EXPECT_TRUE(create().search(dumbbell_data().signature, 5).empty());
}

TEST_P(SearchTest, BlockFollowsTheDatabase) {
  Database database = create();
  fill(database, 5);
  const Signature query = dumbbell_data().signature;
  (void)database.search(query, 1);
  const auto before = blocks();
  ASSERT_EQ(before.size(), 1U);
  (void)database.search(query, 1);
  EXPECT_EQ(blocks(), before);
  database.put({"itself", {}, {}, {}}, dumbbell_data());
  EXPECT_EQ(database.search(query, 1).at(0).info.name, "itself");
  ASSERT_EQ(blocks().size(), 1U);
  EXPECT_NE(blocks(), before);
  database.remove(std::vector<std::string>{"itself"});
  EXPECT_NE(database.search(query, 1).at(0).info.name, "itself");
}

// What did not change is not read again: it could not be.
TEST_P(SearchTest, BlockIsMadeFromWhatChanged) {
  Database database = create();
  fill(database, 9);
  const ShapeData first = dumbbell_data();
  (void)database.search(first.signature, 1);
  run(std::string(on_server() ? "ALTER TABLE signatures DISABLE TRIGGER USER;"
                              : "DROP TRIGGER signature_changed;") +
      "UPDATE signatures SET signature = sketch");
  database.put({"itself", {}, {}, {}}, first);
  EXPECT_EQ(database.search(first.signature, 1).at(0).info.name, "itself");
  database.rename("itself", "renamed");
  EXPECT_EQ(database.search(first.signature, 1).at(0).info.name, "renamed");
  EXPECT_EQ(create().search(first.signature, 1).at(0).info.name, "renamed");
}

TEST_P(SearchTest, BlocksAfterManyChangesEqualTheDatabase) {
  Database database = create();
  fill(database, 12);
  const Signature query = dumbbell_data().signature;
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    const auto all = database.list();
    const std::string name = all[random.below(all.size())].name;
    const std::uint64_t what = random.below(4);
    if (what == 0) {
      database.put({name, {}, {}, {}}, varied(dumbbell_data(), random.below(1000)));
    } else if (what == 1) {
      database.remove(std::vector<std::string>{name});
    } else if (what == 2) {
      database.rename(name, "renamed " + std::to_string(round));
    } else {
      database.put({"new " + std::to_string(round), {}, {}, {}},
                   varied(dumbbell_data(), 1000 + random.below(1000)));
    }
    EXPECT_EQ(names_of(database.search(query, 5)), best(database, query, 5));
    EXPECT_EQ(database.check(), std::vector<std::string>{});
  }
}

// A backup has fewer changes, and other ones after it.
TEST_P(SearchTest, BlocksOfAnotherHistoryAreNotTrusted) {
  const ShapeData first = dumbbell_data();
  {
    Database database = create();
    fill(database, 4);
    (void)database.search(first.signature, 1);
  }
  ASSERT_EQ(blocks().size(), 1U);
  remove_all_but_blocks();
  Database database = create();
  for (int i = 0; i < 20; ++i)
    database.put({"b" + std::to_string(i), {}, {}, {}}, varied(first, 50 + i));
  EXPECT_EQ(names_of(database.search(first.signature, 5)), best(database, first.signature, 5));
  EXPECT_EQ(database.check(), std::vector<std::string>{});
}

// As when a database is deleted and made anew after a file has changed: one shape alone is another,
// and not one that the old block finds.
TEST_P(SearchTest, BlocksOfTheSameNamesAreNotTrusted) {
  const ShapeData first = dumbbell_data();
  const auto fill_with = [&](Database database, const std::string& changed) {
    for (std::uint64_t i = 0; i < 4; ++i) {
      const std::string name = "z" + std::to_string(i);
      database.put({name, {}, {}, {}}, name == changed ? first : varied(first, i));
    }
    return names_of(database.search(first.signature, 1)).at(0);
  };
  const std::string nearest = fill_with(create(), "none");
  ASSERT_EQ(blocks().size(), 1U);
  remove_all_but_blocks();
  const std::string changed = nearest == "z0" ? "z1" : "z0";
  EXPECT_EQ(fill_with(create(), changed), changed);
  EXPECT_EQ(create().check(), std::vector<std::string>{});
}

TEST_P(SearchTest, OtherWritersAreSeen) {
  Database database = create();
  fill(database, 3);
  const Signature query = dumbbell_data().signature;
  (void)database.search(query, 1);
  create().put({"itself", {}, {}, {}}, dumbbell_data());
  EXPECT_EQ(database.search(query, 1).at(0).info.name, "itself");
}

TEST_P(SearchTest, ADamagedBlockIsNeverTrusted) {
  {
    Database database = create();
    fill(database, 6);
  }
  const Signature query = varied(dumbbell_data(), 2).signature;
  const auto expected = names_of(create().search(query, 4));
  const std::filesystem::path block = blocks().at(0);
  const std::string good = content(block);
  std::vector<std::string> bad{"", good.substr(0, good.size() / 2), good + "more"};
  for (std::size_t at = 0; at < good.size(); at += good.size() / 60 + 1) {
    bad.push_back(good);
    bad.back()[at] = static_cast<char>(bad.back()[at] ^ 0x10);
  }
  for (const std::string& bytes : bad) {
    write(block, bytes);
    EXPECT_EQ(names_of(create().search(query, 4)), expected);
  }
}

TEST_P(SearchTest, MatrixIsSymmetricWithOnesAndOrderedByClass) {
  Database database = create();
  const ShapeData first = dumbbell_data();
  database.put({"c", "x", {}, {}}, varied(first, 1));
  database.put({"a", "y", {}, {}}, varied(first, 2));
  database.put({"b", "x", {}, {}}, varied(first, 3));
  const SimilarityMatrix matrix = database.matrix({}, 2);
  ASSERT_EQ(matrix.shapes.size(), 3U);
  EXPECT_EQ(matrix.shapes[0].name + matrix.shapes[1].name + matrix.shapes[2].name, "bca");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(matrix.scores[4 * i], 1.0);
    for (std::size_t j = 0; j < i; ++j) {
      const double score = match_score(database.get(matrix.shapes[i].name).data.signature,
                                       database.get(matrix.shapes[j].name).data.signature);
      EXPECT_EQ(matrix.scores[3 * i + j], score);
      EXPECT_EQ(matrix.scores[3 * j + i], score);
    }
  }
}

TEST_P(SearchTest, MatrixOfSomeIsThatOfAllWithoutTheRest) {
  Database database = create();
  fill(database, 5);
  const SimilarityMatrix all = database.matrix();
  const std::vector<std::string> names{all.shapes[3].name, all.shapes[1].name};
  const SimilarityMatrix two = database.matrix_of(names);
  ASSERT_EQ(two.shapes.size(), 2U);
  EXPECT_EQ(two.shapes[0], all.shapes[1]);
  EXPECT_EQ(two.shapes[1], all.shapes[3]);
  const double score = all.scores[all.shapes.size() + 3];
  EXPECT_EQ(two.scores, (std::vector<double>{1.0, score, score, 1.0}));
  const std::vector<std::string> missing{names[0], "missing"};
  const std::string message =
      message_of(ErrorCode::kInput, [&] { (void)database.matrix_of(missing); });
  EXPECT_NE(message.find("'missing' is not in the database"), std::string::npos) << message;
}

TEST_P(SearchTest, MatrixCanBeCancelled) {
  Database database = create();
  fill(database, 5);
  Progress progress;
  progress.cancel();
  EXPECT_EQ(message_of(ErrorCode::kCancelled, [&] { (void)database.matrix({}, 2, &progress); }),
            "cancelled");
}

}  // namespace
}  // namespace morsel::store
