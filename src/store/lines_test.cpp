#include <gtest/gtest.h>

#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <sstream>
#include <string>

#include "store/test_database.hpp"

namespace morsel::store {
namespace {

class LinesTest : public EachDatabaseTest {
 protected:
  static std::string lines_of(const Database& database) {
    std::ostringstream stream;
    database.export_lines(stream);
    return stream.str();
  }

  static std::string refuse(Database& database, const std::string& lines) {
    std::istringstream stream(lines);
    return message_of(ErrorCode::kInput, [&] { database.import_lines(stream, "lines"); });
  }

  Database filled() {
    Database database = create();
    database.put({"b", "cat", {"x", "y"}, "b.off"}, dumbbell_data(1));
    database.put({"a “quoted”", {}, {}, {}}, dumbbell_data(2));
    database.put({"c", {}, {}, {}}, dumbbell_data(1));
    return database;
  }
};

MORSEL_FOR_EACH_DATABASE(LinesTest);

TEST_P(LinesTest, ExportAndImportAreInverse) {
  const Database database = filled();
  const std::string lines = lines_of(database);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 4);
  Database copy = Database::open(folder_ / "copy.db", Access::kCreate);
  std::istringstream stream(lines);
  EXPECT_EQ(copy.import_lines(stream, "lines"), 3U);
  EXPECT_EQ(lines_of(copy), lines);
  EXPECT_TRUE(copy.check().empty());
  EXPECT_EQ(copy.get("b").data.signature, database.get("b").data.signature);
}

TEST_P(LinesTest, DoNotDependOnTheOrderOfStoring) {
  Database other = Database::open(folder_ / "other.db", Access::kCreate);
  other.put({"c", {}, {}, {}}, dumbbell_data(1));
  other.put({"a “quoted”", {}, {}, {}}, dumbbell_data(2));
  other.put({"b", "cat", {"y", "x"}, "b.off"}, dumbbell_data(1));
  EXPECT_EQ(lines_of(other), lines_of(filled()));
}

TEST_P(LinesTest, ImportReplacesNames) {
  const std::string lines = lines_of(filled());
  Database database = Database::open(folder_ / "copy.db", Access::kCreate);
  database.put({"b", "dog", {"z"}, {}}, dumbbell_data(3));
  std::istringstream stream(lines);
  database.import_lines(stream, "lines");
  EXPECT_EQ(database.size(), 3U);
  EXPECT_EQ(database.find("b")->class_name, "cat");
}

TEST_P(LinesTest, BadLinesAreNamedAndNothingIsStored) {
  const std::string lines = lines_of(filled());
  const std::size_t second = lines.find('\n') + 1;
  const std::size_t third = lines.find('\n', second) + 1;
  const std::string head = lines.substr(0, second);
  const std::string line = lines.substr(second, third - second);
  Database database = Database::open(folder_ / "copy.db", Access::kCreate);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = line;
    text.replace(text.find(from), from.size(), to);
    return head + line + text;
  };
  EXPECT_EQ(refuse(database, "").find("lines: is empty"), 0U);
  EXPECT_EQ(refuse(database, line).find("lines:1: lacks the field \"morsel_shapes\""), 0U);
  EXPECT_EQ(refuse(database, "{\"morsel_shapes\":7}\n").find("lines:1: version 7"), 0U);
  EXPECT_EQ(refuse(database, head + line + "{").find("lines:3: is not a JSON object"), 0U);
  EXPECT_EQ(refuse(database, changed("\"tags\"", "\"bags\"")).find("lines:3: lacks"), 0U);
  for (const char* points : {"\"many\"", "-1", "1.5", "9223372036854775808", "6.7e40"}) {
    EXPECT_EQ(refuse(database, changed("\"points\":1500", std::string("\"points\":") + points)),
              "lines:3: the field \"points\" is not a whole number from 0 to 9223372036854775807")
        << points;
  }
  EXPECT_EQ(refuse(database, "{\"morsel_shapes\":6.7e40}\n"),
            "lines:1: the field \"morsel_shapes\" is not a whole number from 0 to 2147483647");
  EXPECT_EQ(refuse(database, changed("\"sketch\":\"", "\"sketch\":\"*")).find("lines:3: "), 0U);
  EXPECT_EQ(refuse(database, changed("\"content\":\"", "\"content\":\"Z")).find("lines:3: "), 0U);
  EXPECT_EQ(database.size(), 0U);
}

}  // namespace
}  // namespace morsel::store
