// morsel list --database DB: the names, classes and tags of the stored shapes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.hpp"
#include "options.hpp"
#include "shapes.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel list --database shapes.db
  morsel list --database shapes.db --class chair --json)";

struct Arguments {
  std::filesystem::path database;
  ShapeFilter filter;
  bool json = false;
};

std::string table(const std::vector<ShapeInfo>& shapes) {
  std::size_t name = 4;
  std::size_t class_name = 5;
  for (const ShapeInfo& shape : shapes) {
    name = std::max(name, shape.name.size());
    class_name = std::max(class_name, shape.class_name.size());
  }
  std::string text = fmt::format("{:{}}  {:{}}  tags\n", "name", name, "class", class_name);
  for (const ShapeInfo& shape : shapes) {
    text += fmt::format("{:{}}  {:{}}  {}\n", shape.name, name,
                        shape.class_name.empty() ? "-" : shape.class_name, class_name,
                        shape.tags.empty() ? "-" : join_tags(shape.tags));
  }
  return text;
}

std::string json_text(const std::vector<ShapeInfo>& shapes) {
  using Json = nlohmann::ordered_json;
  Json json = Json::array();
  for (const ShapeInfo& shape : shapes) {
    json.push_back({{"name", shape.name},
                    {"class", shape.class_name},
                    {"tags", shape.tags},
                    {"source", shape.source}});
  }
  return pretty(json);
}

int run_list(const Arguments& arguments) {
  const Database database = Database::open(arguments.database, Access::kRead);
  const std::vector<ShapeInfo> shapes = database.list(arguments.filter);
  say(arguments.json ? json_text(shapes) : table(shapes));
  return kDone;
}

}  // namespace

void add_list(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("list", "List the stored shapes");
  const auto arguments = std::make_shared<Arguments>();
  add_database(*command, arguments->database);
  add(*command, "--class", "CLASS", "Only shapes of this class",
      [arguments](const std::string&, const std::string& text) {
        arguments->filter.class_name = text;
      });
  add(*command, "--tag", "TAG", "Only shapes with this tag",
      [arguments](const std::string&, const std::string& text) { arguments->filter.tag = text; });
  add_json(*command, arguments->json);
  command->footer(kExamples);
  command->group("Database");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_list(*arguments); }; });
}

}  // namespace morsel::cli
