#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "store/test_database.hpp"

namespace morsel::store {
namespace {

class CheckTest : public DatabaseTest {
 protected:
  void SetUp() override {
    DatabaseTest::SetUp();
    Database database = create();
    const ShapeData first = dumbbell_data();
    for (std::uint64_t i = 0; i < 8; ++i) {
      database.put({"shape " + std::to_string(i), "c", {"t"}, "here"}, varied(first, i));
    }
  }

  [[nodiscard]] std::vector<std::string> findings() const {
    return Database::open(file_, Access::kRead).check();
  }

  void damage(const std::string& statement) const {
    SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec(statement);
  }
};

TEST_F(CheckTest, NothingIsWrongWithAGoodOne) { EXPECT_EQ(findings(), std::vector<std::string>{}); }

TEST_F(CheckTest, ChangedRowsAreNamed) {
  damage("UPDATE shapes SET class = 'd' WHERE name = 'shape 3'");
  ASSERT_EQ(findings().size(), 1U);
  EXPECT_NE(findings()[0].find("'shape 3'"), std::string::npos) << findings()[0];
  message_of(ErrorCode::kInput, [&] { (void)Database::open(file_, Access::kRead).get("shape 3"); });
}

TEST_F(CheckTest, EachColumnOfASignatureCounts) {
  for (const char* change :
       {"options = 'x'", "points = 3", "signature = x'00'", "sketch = x'01'"}) {
    SetUp();
    damage(std::string("UPDATE signatures SET ") + change + " WHERE id = 2");
    ASSERT_EQ(findings().size(), 1U) << change;
    EXPECT_NE(findings()[0].find("signature 2"), std::string::npos) << findings()[0];
  }
}

TEST_F(CheckTest, LinksAreFollowed) {
  damage("PRAGMA foreign_keys = OFF; DELETE FROM signatures WHERE id = 1");
  ASSERT_EQ(findings().size(), 1U);
  EXPECT_NE(findings()[0].find("its signature is missing"), std::string::npos);
  SetUp();
  damage("DELETE FROM shapes WHERE id = 1");
  ASSERT_EQ(findings().size(), 1U);
  EXPECT_NE(findings()[0].find("belongs to no shape"), std::string::npos);
}

// A bit that flips anywhere is found, or is in bytes that SQLite does not use: then every shape is
// still what it was. Nothing crashes.
TEST_F(CheckTest, FlippedBits) {
  const std::string good = content(file_);
  const Signature query = dumbbell_data().signature;
  std::vector<std::string> expected;
  for (const LookAlike& hit : create().search(query, 8)) {
    expected.push_back(hit.info.name + std::to_string(hit.score));
  }
  Random random(4);
  int found = 0;
  constexpr int kFlips = 150;
  for (int i = 0; i < kFlips; ++i) {
    std::string bad = good;
    char& byte = bad[random.below(bad.size())];
    byte = static_cast<char>(byte ^ (1 << random.below(8)));
    for (const auto& name : names_in_folder()) std::filesystem::remove(folder_ / name);
    write(file_, bad);
    try {
      const Database database = Database::open(file_, Access::kRead);
      if (!database.check().empty()) {
        ++found;
        continue;
      }
      std::vector<std::string> hits;
      for (const LookAlike& hit : database.search(query, 8)) {
        hits.push_back(hit.info.name + std::to_string(hit.score));
      }
      EXPECT_EQ(hits, expected);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInput) << error.what();
      EXPECT_NE(std::string(error.what()).find("shapes.db"), std::string::npos) << error.what();
      ++found;
    }
  }
  EXPECT_GT(found, kFlips / 2);
}

TEST_F(CheckTest, Truncations) {
  const std::string good = content(file_);
  for (const double share : {0.01, 0.3, 0.7, 0.99}) {
    write(file_,
          good.substr(0, static_cast<std::size_t>(share * static_cast<double>(good.size()))));
    try {
      EXPECT_FALSE(findings().empty());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInput) << error.what();
    }
  }
}

}  // namespace
}  // namespace morsel::store
