#include <gtest/gtest.h>

#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "store/test_database.hpp"

namespace morsel::store {
namespace {

class CheckTest : public EachDatabaseTest {
 protected:
  void SetUp() override {
    EachDatabaseTest::SetUp();
    if (IsSkipped()) return;
    Database database = create();
    const ShapeData first = dumbbell_data();
    for (std::uint64_t i = 0; i < 8; ++i) {
      database.put({"shape " + std::to_string(i), "c", {"t"}, "here"}, varied(first, i));
    }
  }

  [[nodiscard]] std::vector<std::string> findings() const { return open(Access::kRead).check(); }

  [[nodiscard]] std::string id_of(const std::string& name) const {
    return std::to_string(integer("SELECT signature FROM shapes WHERE name = '" + name + "'"));
  }
};

MORSEL_FOR_EACH_DATABASE(CheckTest);

// Of the bytes of a file.
using CheckFileTest = CheckTest;
INSTANTIATE_TEST_SUITE_P(File, CheckFileTest, ::testing::Values("file"));

TEST_P(CheckTest, NothingIsWrongWithAGoodOne) { EXPECT_EQ(findings(), std::vector<std::string>{}); }

TEST_P(CheckTest, ChangedRowsAreNamed) {
  run("UPDATE shapes SET class = 'd' WHERE name = 'shape 3'");
  ASSERT_EQ(findings().size(), 1U);
  EXPECT_NE(findings()[0].find("'shape 3'"), std::string::npos) << findings()[0];
  message_of(ErrorCode::kInput, [&] { (void)open(Access::kRead).get("shape 3"); });
}

TEST_P(CheckTest, EachColumnOfASignatureCounts) {
  for (const std::string change :
       {"options = 'x'", "points = 3", "signature = sketch", "sketch = signature"}) {
    SetUp();
    const std::string id = id_of("shape 1");
    run("UPDATE signatures SET " + change + " WHERE id = " + id);
    ASSERT_EQ(findings().size(), 1U) << change;
    EXPECT_NE(findings()[0].find("signature " + id), std::string::npos) << findings()[0];
  }
}

TEST_P(CheckTest, LinksAreFollowed) {
  run(std::string(on_server() ? "ALTER TABLE shapes DROP CONSTRAINT shapes_signature_fkey;"
                              : "PRAGMA foreign_keys = OFF;") +
      "DELETE FROM signatures WHERE id = " + id_of("shape 0"));
  ASSERT_EQ(findings().size(), 1U);
  EXPECT_NE(findings()[0].find("its signature is missing"), std::string::npos);
  SetUp();
  run("DELETE FROM shapes WHERE name = 'shape 0'");
  ASSERT_EQ(findings().size(), 1U);
  EXPECT_NE(findings()[0].find("belongs to no shape"), std::string::npos);
}

TEST_P(CheckTest, AnotherStateThanItSays) {
  run("UPDATE state SET digest = 7");
  ASSERT_EQ(findings().size(), 1U);
  EXPECT_NE(findings()[0].find("holds other shapes than it says"), std::string::npos);
  (void)create().repair();
  EXPECT_EQ(findings(), std::vector<std::string>{});
}

TEST_P(CheckTest, RepairKeepsWhatIsGood) {
  const std::string id = id_of("shape 1");
  run("UPDATE shapes SET class = 'd' WHERE name = 'shape 3'");
  run("UPDATE signatures SET points = 3 WHERE id = " + id);
  const std::vector<std::string> dropped = create().repair();
  ASSERT_EQ(dropped.size(), 3U);
  EXPECT_NE(dropped[0].find("'shape 3'"), std::string::npos) << dropped[0];
  EXPECT_NE(dropped[1].find("'shape 1': its signature is damaged"), std::string::npos);
  EXPECT_NE(dropped[2].find("signature " + id), std::string::npos) << dropped[2];
  EXPECT_EQ(findings(), std::vector<std::string>{});
  EXPECT_EQ(create().size(), 6U);
  EXPECT_EQ(create().repair(), std::vector<std::string>{});
}

// A bit that flips anywhere is found, or is in bytes that SQLite does not use: then every shape is
// still what it was. Nothing crashes.
TEST_P(CheckFileTest, FlippedBits) {
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

TEST_P(CheckFileTest, Truncations) {
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
