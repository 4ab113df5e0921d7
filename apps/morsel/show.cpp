// morsel show --database DB NAME: all that is stored of one shape.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/picture.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "shapes.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel show --database shapes.db models/cat.off
  morsel show --database shapes.db models/cat.off --picture cat.png
  morsel show --database shapes.db models/cat.off --json | jq .signature)";

struct Arguments {
  std::filesystem::path database;
  std::string name;
  bool json = false;
  Output picture{"--picture", {}, {".png", ".svg"}};
  Output thumbnail{"--thumbnail", {}, {".png"}};
};

std::string neighbor_list(const SignaturePart& part) {
  std::string list;
  for (const PartNeighbor& neighbor : part.neighbors) {
    list += fmt::format("{}{}", list.empty() ? "" : " ", neighbor.part);
  }
  return list.empty() ? "-" : list;
}

std::string table(const StoredShape& shape) {
  const ShapeInfo& info = shape.info;
  const Signature& signature = shape.data.signature;
  const auto or_none = [](const std::string& text) { return text.empty() ? "-" : text; };
  std::string text;
  text += fmt::format("name     {}\n", info.name);
  text += fmt::format("class    {}\n", or_none(info.class_name));
  text += fmt::format("tags     {}\n", or_none(join_tags(info.tags)));
  text += fmt::format("source   {}\n", or_none(info.source));
  text += fmt::format("points   {}\n", shape.data.points);
  text += fmt::format("parts    {}\n", shape.data.sketch.part_count);
  text += fmt::format("made by  {}\n", shape.data.options);
  text += fmt::format("content  {}\n", shape.data.content);
  if (signature.parts.empty()) return text;
  text += "\npart  volume %  thickness  neighbours\n";
  for (std::size_t i = 0; i < signature.parts.size(); ++i) {
    const SignaturePart& part = signature.parts[i];
    text += fmt::format("{:4}  {:8.1f}  {:9.4g}  {}\n", i, 100.0 * part.weight,
                        2.0 * part.ball_radius * signature.size, neighbor_list(part));
  }
  return text;
}

std::string json_text(const StoredShape& shape) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["name"] = shape.info.name;
  json["class"] = shape.info.class_name;
  json["tags"] = shape.info.tags;
  json["source"] = shape.info.source;
  json["points"] = shape.data.points;
  json["parts"] = shape.data.sketch.part_count;
  json["options"] = shape.data.options;
  json["content"] = shape.data.content;
  json["signature"] = Json::parse(to_json(shape.data.signature));
  json["merges"] = Json::array();
  for (const Merge& merge : shape.data.sketch.merges) {
    json["merges"].push_back({{"ratio", merge.ratio}, {"a", merge.a}, {"b", merge.b}});
  }
  return pretty(json);
}

int run_show(const Arguments& arguments) {
  check_outputs({arguments.picture, arguments.thumbnail}, arguments.database);
  const Database database = Database::open(arguments.database, Access::kRead);
  const StoredShape shape = database.get(arguments.name);
  if (!arguments.picture.path.empty()) {
    PictureOptions options;
    options.title = shape.info.name;
    write_picture(arguments.picture.path, shape.data.sketch.points, shape.data.sketch.parts,
                  options);
  }
  if (!arguments.thumbnail.path.empty()) {
    write_text(arguments.thumbnail.path, draw_thumbnail(shape.data.sketch));
  }
  say(arguments.json ? json_text(shape) : table(shape));
  return kDone;
}

}  // namespace

void add_show(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("show", "Show all that is stored of a shape");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("NAME", arguments->name, "Of the shape")->required()->option_text(" ");
  add_database(*command, arguments->database);
  add_json(*command, arguments->json);
  add_output(*command, "--picture", "FILE", arguments->picture,
             "Drawing of the stored points in their parts' colours: .png .svg");
  add_output(*command, "--thumbnail", "FILE.png", arguments->thumbnail, "A small picture of it");
  command->footer(kExamples);
  command->group("Database");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_show(*arguments); }; });
}

}  // namespace morsel::cli
