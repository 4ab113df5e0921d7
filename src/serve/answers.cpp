#include "serve/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/lower_case.hpp"
#include "html/shape_json.hpp"
#include "serve/stored_tree.hpp"

namespace morsel::serve {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Paths of the host (ShapeInfo::source) stay here.
Json info_json(const ShapeInfo& info) {
  return {{"name", info.name}, {"class", info.class_name}, {"tags", info.tags}};
}

bool contains(const ShapeInfo& info, const std::string& text) {
  const auto has = [&](const std::string& field) {
    return lower_case(field).find(text) != std::string::npos;
  };
  return has(info.name) || has(info.class_name) ||
         std::any_of(info.tags.begin(), info.tags.end(), has);
}

std::vector<const ShapeInfo*> chosen(const std::vector<ShapeInfo>& shapes,
                                     const ShapeChoice& choice) {
  const std::string text = lower_case(choice.text);
  std::vector<const ShapeInfo*> found;
  for (const ShapeInfo& info : shapes) {
    if (choice.class_name && info.class_name != *choice.class_name) continue;
    if (text.empty() || contains(info, text)) found.push_back(&info);
  }
  return found;
}

Json shares_of(const Signature& signature) {
  Json shares = Json::array();
  for (const SignaturePart& part : signature.parts) shares.push_back(part.weight);
  return shares;
}

}  // namespace

std::string error_json(const std::string& message) { return text_of({{"error", message}}); }

std::string database_json(const Database& database, const ServeOptions& options) {
  std::map<std::string, std::size_t> classes;
  const auto shapes = database.shapes();
  for (const ShapeInfo& info : *shapes) ++classes[info.class_name];
  Json json;
  json["morsel"] = version();
  json["name"] = database.file().filename().string();
  json["shapes"] = shapes->size();
  json["classes"] = Json::array();
  for (const auto& [name, count] : classes) {
    json["classes"].push_back({{"name", name}, {"shapes", count}});
  }
  json["limits"] = {{"upload_bytes", options.most_upload_bytes},
                    {"upload_points", options.most_upload_points},
                    {"upload_seconds", options.upload_seconds},
                    {"matrix_shapes", kMostMatrixShapes}};
  return text_of(json);
}

std::string shapes_json(const Database& database, const ShapeChoice& choice, std::size_t offset,
                        std::size_t limit) {
  const auto all = database.shapes();
  const std::vector<const ShapeInfo*> shapes = chosen(*all, choice);
  Json json;
  json["total"] = shapes.size();
  json["shapes"] = Json::array();
  const std::size_t begin = std::min(offset, shapes.size());
  const std::size_t end = begin + std::min(limit, shapes.size() - begin);
  for (std::size_t i = begin; i < end; ++i) json["shapes"].push_back(info_json(*shapes[i]));
  return text_of(json);
}

std::string stored_shape_json(const StoredShape& shape) {
  Json json = info_json(shape.info);
  json["points"] = shape.data.points;
  json["parts"] = shape.data.sketch.part_count;
  json["options"] = shape.data.options;
  json["content"] = shape.data.content;
  return text_of(json);
}

std::string sketch_json(const ShapeData& data) {
  return picture_json(data.sketch.points, data.sketch.parts,
                      static_cast<std::size_t>(data.sketch.part_count)) +
         "\n";
}

std::string parts_json(const StoredShape& shape) {
  Json json = Json::parse(shape_json(shape.data.sketch.points, tree_of(shape.data),
                                     {.name = shape.info.name, .merge_ratio = 1.0}));
  json["points_of_input"] = shape.data.points;
  return text_of(json);
}

std::string search_json(const Database& database, const QueryShape& query, std::size_t top) {
  Json json;
  json["query"] = query.name;
  json["hits"] = Json::array();
  std::size_t rank = 0;
  for (const LookAlike& hit : database.search(query.data.signature, top)) {
    Json entry{{"rank", ++rank}};
    entry.update(info_json(hit.info));
    entry["score"] = hit.score;
    json["hits"].push_back(std::move(entry));
  }
  return text_of(json);
}

std::string match_json(const QueryShape& query, const StoredShape& other) {
  const Signature& target = query.data.signature;
  const Signature& source = other.data.signature;
  const Match found = match(target, source);
  const Sketch& sketch = other.data.sketch;
  Json json = info_json(other.info);
  json["query"] = query.name;
  json.update(Json::parse(to_json(found)));
  json["terms"] = Json::array();
  for (const ScoreTerm& term : explain_score(target, source)) {
    json["terms"].push_back(
        {{"name", term.name}, {"distance", term.distance}, {"weight", term.weight}});
  }
  json["target_shares"] = shares_of(target);
  json["source_shares"] = shares_of(source);
  json["picture"] = Json::parse(
      picture_json(on_target(found, sketch.points), parts_on_target(found, sketch.parts),
                   static_cast<std::size_t>(query.data.sketch.part_count)));
  return text_of(json);
}

std::vector<std::string> chosen_names(const Database& database, const ShapeChoice& choice) {
  const auto all = database.shapes();
  std::vector<std::string> names;
  for (const ShapeInfo* info : chosen(*all, choice)) names.push_back(info->name);
  return names;
}

// Written by hand: as JSON values, two million numbers take more memory than as text.
std::string matrix_json(const SimilarityMatrix& matrix) {
  Json shapes = Json::array();
  for (const ShapeInfo& info : matrix.shapes) shapes.push_back(info_json(info));
  std::string text = text_of({{"shapes", shapes}, {"scores", Json::array()}});
  text.resize(text.rfind(']'));
  const std::size_t count = matrix.shapes.size();
  for (std::size_t row = 0; row < count; ++row) {
    const auto begin = matrix.scores.begin() + static_cast<std::ptrdiff_t>(row * count);
    const auto end = begin + static_cast<std::ptrdiff_t>(row) + 1;
    fmt::format_to(std::back_inserter(text), "{}[{:.6f}]", row > 0 ? "," : "",
                   fmt::join(begin, end, ","));
  }
  return text + "]}\n";
}

std::string upload_json(const std::string& id, const UploadState& state) {
  constexpr const char* kStages[] = {"waiting", "working", "done", "failed", "cancelled"};
  Json json;
  json["id"] = id;
  json["name"] = state.name;
  json["stage"] = kStages[static_cast<int>(state.stage)];
  json["step"] = state.step;
  json["fraction"] = state.fraction;
  json["message"] = state.message;
  return text_of(json);
}

}  // namespace morsel::serve
