#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string>
#include <thread>
#include <vector>

#include "store/test_database.hpp"

namespace morsel::store {
namespace {

using ::testing::Test;

MORSEL_FOR_EACH_DATABASE(EachDatabaseTest);

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_P(EachDatabaseTest, WhatIsPutComesBack) {
  const ShapeInfo info{"models/cat.off", "cat", {"scanned", "small"}, "/data/models/cat.off"};
  const ShapeData data = dumbbell_data();
  create().put(info, data);
  const StoredShape shape = open(Access::kRead).get("models/cat.off");
  EXPECT_EQ(shape.info, info);
  EXPECT_EQ(shape.data.content, data.content);
  EXPECT_EQ(shape.data.options, data.options);
  EXPECT_EQ(shape.data.points, 1500U);
  EXPECT_EQ(shape.data.signature, data.signature);
  EXPECT_EQ(encode_sketch(shape.data.sketch), encode_sketch(data.sketch));
}

TEST_F(DatabaseTest, IsOneFileWhenClosed) {
  create().put({"a", {}, {}, {}}, dumbbell_data());
  EXPECT_EQ(names_in_folder(), std::vector<std::string>{"shapes.db"});
  EXPECT_EQ(Database::open(file_, Access::kRead).size(), 1U);
  EXPECT_EQ(names_in_folder(), std::vector<std::string>{"shapes.db"});
}

TEST_P(EachDatabaseTest, PutSaysWhatItDid) {
  Database database = create();
  const ShapeData one = dumbbell_data(1);
  const ShapeData two = dumbbell_data(2);
  EXPECT_EQ(database.put({"a", {}, {}, {}}, one), Change::kAdded);
  EXPECT_EQ(database.put({"a", {}, {}, {}}, one), Change::kUnchanged);
  EXPECT_EQ(database.put({"a", "cat", {}, {}}, one), Change::kReplaced);
  EXPECT_EQ(database.put({"a", "cat", {}, {}}, two), Change::kReplaced);
  EXPECT_EQ(database.size(), 1U);
  EXPECT_EQ(database.get("a").data.content, two.content);
}

TEST_P(EachDatabaseTest, ContentIsStoredOnce) {
  {
    Database database = create();
    const ShapeData data = dumbbell_data();
    EXPECT_EQ(database.put_known({"a", {}, {}, {}}, data.content), std::nullopt);
    database.put({"a", {}, {}, {}}, data);
    EXPECT_EQ(database.put_known({"b", {}, {}, {}}, data.content), Change::kAdded);
    database.remove(std::vector<std::string>{"a"});
    EXPECT_EQ(database.get("b").data.signature, data.signature);
  }
  EXPECT_EQ(integer("SELECT count(*) FROM signatures"), 1);
}

TEST_P(EachDatabaseTest, UnusedContentIsDropped) {
  {
    Database database = create();
    database.put({"a", {}, {}, {}}, dumbbell_data(1));
    database.put({"a", {}, {}, {}}, dumbbell_data(2));
    database.put({"b", {}, {}, {}}, dumbbell_data(3));
    database.remove(std::vector<std::string>{"b"});
  }
  EXPECT_EQ(integer("SELECT count(*) FROM signatures"), 1);
}

TEST_P(EachDatabaseTest, ListFilters) {
  Database database = create();
  const ShapeData data = dumbbell_data();
  database.put({"b", "cat", {"x", "y"}, {}}, data);
  database.put({"a", "dog", {"x"}, {}}, data);
  const auto names = [&](const ShapeFilter& filter) {
    std::string joined;
    for (const ShapeInfo& info : database.list(filter)) joined += info.name;
    return joined;
  };
  EXPECT_EQ(names({}), "ab");
  EXPECT_EQ(names({"cat", {}}), "b");
  EXPECT_EQ(names({{}, "x"}), "ab");
  EXPECT_EQ(names({"dog", "y"}), "");
}

TEST_P(EachDatabaseTest, ShapesAreReadAgainOnlyAfterAChange) {
  Database database = create();
  Database other = create();
  const ShapeData data = dumbbell_data();
  database.put({"b", {}, {}, {}}, data);
  const auto first = database.shapes();
  EXPECT_EQ(database.shapes(), first);
  other.put({"a", "dog", {}, {}}, data);
  const auto second = database.shapes();
  ASSERT_EQ(second->size(), 2U);
  EXPECT_EQ(second->front().class_name, "dog");
  EXPECT_EQ(first->size(), 1U);
  database.rename("a", "c");
  EXPECT_EQ(database.shapes()->back().name, "c");
}

TEST_P(EachDatabaseTest, RemoveIsAllOrNothing) {
  Database database = create();
  database.put({"a", {}, {}, {}}, dumbbell_data());
  const std::string message = message_of(ErrorCode::kInput, [&] {
    database.remove(std::vector<std::string>{"a", "missing"});
  });
  EXPECT_TRUE(holds(message, "'missing' is not in the database")) << message;
  EXPECT_TRUE(database.find("a"));
}

TEST_P(EachDatabaseTest, Rename) {
  Database database = create();
  database.put({"a", "cat", {"x"}, {}}, dumbbell_data());
  database.put({"b", {}, {}, {}}, dumbbell_data());
  database.rename("a", "c");
  EXPECT_FALSE(database.find("a"));
  EXPECT_EQ(database.find("c"), (ShapeInfo{"c", "cat", {"x"}, {}}));
  message_of(ErrorCode::kInput, [&] { database.rename("a", "d"); });
  EXPECT_TRUE(holds(message_of(ErrorCode::kInput, [&] { database.rename("c", "b"); }), "another"));
  message_of(ErrorCode::kUsage, [&] { database.rename("c", ""); });
  EXPECT_TRUE(database.find("c"));
}

TEST_P(EachDatabaseTest, NamesThatCannotBe) {
  Database database = create();
  const ShapeData data = dumbbell_data();
  for (const std::string& name :
       {std::string(), std::string("a\nb"), std::string("\xff"), std::string(1025, 'a')}) {
    message_of(ErrorCode::kUsage, [&] { database.put({name, {}, {}, {}}, data); });
  }
  EXPECT_EQ(database.put({"Tom’s cat; DROP TABLE shapes --", {}, {}, {}}, data), Change::kAdded);
  EXPECT_EQ(database.size(), 1U);
}

TEST_P(EachDatabaseTest, TagsAreASet) {
  Database database = create();
  database.put({"a", {}, {"y", "x", "y"}, {}}, dumbbell_data());
  EXPECT_EQ(database.find("a")->tags, (std::vector<std::string>{"x", "y"}));
}

TEST_F(DatabaseTest, FilesThatAreNoDatabase) {
  const auto open = [&](Access access) {
    return message_of(ErrorCode::kInput, [&] { (void)Database::open(file_, access); });
  };
  EXPECT_TRUE(holds(open(Access::kRead), "there is no such database"));
  EXPECT_TRUE(holds(open(Access::kWrite), "there is no such database"));
  write(file_,
        "this is a text of more than a hundred bytes, which SQLite takes for a file that is "
        "encrypted or none of its own");
  for (const Access access : {Access::kRead, Access::kWrite, Access::kCreate}) {
    EXPECT_TRUE(holds(open(access), "is not a database of morsel"));
  }
  std::filesystem::remove(file_);
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE birds (name TEXT)");
  EXPECT_TRUE(holds(open(Access::kCreate), "but not a database of morsel"));
  file_ = folder_;
  EXPECT_TRUE(holds(open(Access::kCreate), "is a directory"));
}

TEST_F(DatabaseTest, AFolderThatIsMissing) {
  file_ = folder_ / "missing" / "shapes.db";
  message_of(ErrorCode::kOutput, [&] { (void)create(); });
}

TEST_P(EachDatabaseTest, NewerTablesAreRefused) {
  create().put({"a", {}, {}, {}}, dumbbell_data());
  connect(place_, Access::kWrite)->set_version(99);
  for (const Access access : {Access::kRead, Access::kWrite, Access::kCreate}) {
    const std::string message = message_of(ErrorCode::kInput, [&] { (void)open(access); });
    EXPECT_TRUE(holds(message, "newer morsel (version 99")) << message;
  }
}

// What made tables of version 3 of those of version 2, undone.
constexpr const char* kBackToVersion2 = R"(
DROP TRIGGER shape_added; DROP TRIGGER shape_changed; DROP TRIGGER shape_removed;
DROP TRIGGER signature_changed; DROP TABLE state; DROP TABLE removed; DROP TABLE failures;
DROP INDEX shapes_by_change; ALTER TABLE shapes DROP COLUMN changed;
CREATE TABLE state (id INTEGER PRIMARY KEY CHECK (id = 1), token INTEGER NOT NULL) STRICT;
INSERT INTO state VALUES (1, random());
CREATE TRIGGER shape_added AFTER INSERT ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER shape_changed AFTER UPDATE ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER shape_removed AFTER DELETE ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER signature_changed AFTER UPDATE ON signatures
  BEGIN UPDATE state SET token = random(); END;
PRAGMA user_version = 2;
)";

TEST_F(DatabaseTest, OlderTablesAreBroughtUpToDate) {
  const ShapeData one = dumbbell_data(1);
  const ShapeData two = dumbbell_data(2);
  {
    Database database = create();
    database.put({"a", "cat", {"x"}, "a.off"}, one);
    database.put({"b", {}, {}, {}}, two);
    database.put({"c", {}, {}, {}}, one);
  }
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec(kBackToVersion2);
  write(folder_ / "shapes.db-0123456789abcdef.block", "of version 2");
  const std::string message =
      message_of(ErrorCode::kInput, [&] { (void)Database::open(file_, Access::kRead); });
  EXPECT_TRUE(holds(message, "by an older morsel")) << message;
  Database database = Database::open(file_, Access::kWrite);
  EXPECT_EQ(database.size(), 3U);
  EXPECT_EQ(database.check(), std::vector<std::string>{});
  EXPECT_EQ(database.search(two.signature, 1).at(0).info.name, "b");
  EXPECT_EQ(database.find("a"), (ShapeInfo{"a", "cat", {"x"}, "a.off"}));
  database.remove(std::vector<std::string>{"b"});
  EXPECT_EQ(database.search(two.signature, 5).size(), 2U);
  EXPECT_EQ(database.check(), std::vector<std::string>{});
  EXPECT_EQ(names_in_folder().size(), 4U);  // the file, its log, one block
}

TEST_F(DatabaseTest, PasswordsAreNotNamed) {
  EXPECT_EQ(without_password("postgresql://me:secret@host:5/db?a=b"),
            "postgresql://me@host:5/db?a=b");
  EXPECT_EQ(without_password("postgresql://me:se@cret@host/db"), "postgresql://me@host/db");
  EXPECT_EQ(without_password("postgresql:///db?password=secret&host=/a:b@c"),
            "postgresql:///db?password=***&host=/a:b@c");
  EXPECT_EQ(without_password("postgresql:///db?host=/a&sslpassword=secret&password=other"),
            "postgresql:///db?host=/a&sslpassword=***&password=***");
  for (const char* plain : {"postgresql://", "postgresql://host:5/db", "postgres://me@host"}) {
    EXPECT_EQ(without_password(plain), plain);
  }
}

TEST_F(DatabaseTest, TablesOfBeforeTheFirstReleaseAreRefused) {
  create().put({"a", {}, {}, {}}, dumbbell_data());
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 1");
  for (const Access access : {Access::kRead, Access::kWrite, Access::kCreate}) {
    const std::string message =
        message_of(ErrorCode::kInput, [&] { (void)Database::open(file_, access); });
    EXPECT_TRUE(holds(message, "index its shapes into a new database")) << message;
  }
}

TEST_F(DatabaseTest, AnEmptyFileBecomesADatabase) {
  write(file_, "");
  message_of(ErrorCode::kInput, [&] { (void)Database::open(file_, Access::kRead); });
  EXPECT_EQ(create().size(), 0U);
  EXPECT_EQ(Database::open(file_, Access::kRead).size(), 0U);
}

// Each of several threads has a connection of its own, as several programs would.
TEST_P(EachDatabaseTest, ManyWritersAtOnce) {
  constexpr int kWriters = 4;
  constexpr int kShapes = 15;
  const ShapeData data = dumbbell_data();
  {
    std::vector<std::jthread> writers;
    for (int w = 0; w < kWriters; ++w) {
      writers.emplace_back([&, w] {
        Database database = create();
        for (int i = 0; i < kShapes; ++i) {
          const std::string own = std::to_string(w) + "-" + std::to_string(i);
          database.put({own, {}, {}, {}}, data);
          database.put({"shared-" + std::to_string(i), {}, {}, {}}, data);
        }
      });
    }
  }
  const Database database = open(Access::kRead);
  EXPECT_EQ(database.size(), static_cast<std::size_t>(kShapes * (kWriters + 1)));
  EXPECT_TRUE(database.check().empty());
}

TEST_F(DatabaseTest, ContentKeysTellContentsApart) {
  std::vector<Vec3> points = shapes::cube_cloud(100);
  const std::string key = content_key(points, {});
  EXPECT_EQ(key.size(), 32U);
  EXPECT_EQ(content_key(points, {}), key);
  SegmentOptions options;
  options.threads = 7;
  EXPECT_EQ(content_key(points, options), key);
  options.interior.method = Method::kPaper;
  EXPECT_NE(content_key(points, options), key);
  points[50].y = std::nextafter(points[50].y, 2.0);
  EXPECT_NE(content_key(points, {}), key);
}

}  // namespace
}  // namespace morsel::store
