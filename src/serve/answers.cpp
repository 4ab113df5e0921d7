#include "serve/answers.hpp"

#include <algorithm>
#include <map>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "base/lower_case.hpp"
#include "base/threads.hpp"
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

std::vector<ShapeInfo> chosen(const Database& database, const ShapeChoice& choice) {
  std::vector<ShapeInfo> shapes = database.list({.class_name = choice.class_name, .tag = {}});
  if (const std::string text = lower_case(choice.text); !text.empty()) {
    std::erase_if(shapes, [&](const ShapeInfo& info) { return !contains(info, text); });
  }
  return shapes;
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
  const std::vector<ShapeInfo> shapes = database.list();
  for (const ShapeInfo& info : shapes) ++classes[info.class_name];
  Json json;
  json["morsel"] = version();
  json["name"] = database.file().filename().string();
  json["shapes"] = shapes.size();
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
  const std::vector<ShapeInfo> shapes = chosen(database, choice);
  Json json;
  json["total"] = shapes.size();
  json["shapes"] = Json::array();
  const std::size_t begin = std::min(offset, shapes.size());
  const std::size_t end = begin + std::min(limit, shapes.size() - begin);
  for (std::size_t i = begin; i < end; ++i) json["shapes"].push_back(info_json(shapes[i]));
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

std::optional<std::string> matrix_json(const Database& database, const ShapeChoice& choice,
                                       int threads, std::size_t& count) {
  std::vector<ShapeInfo> shapes = chosen(database, choice);
  count = shapes.size();
  if (count > kMostMatrixShapes) return std::nullopt;
  std::sort(shapes.begin(), shapes.end(), [](const ShapeInfo& a, const ShapeInfo& b) {
    return std::tie(a.class_name, a.name) < std::tie(b.class_name, b.name);
  });
  std::vector<Signature> signatures;
  for (const ShapeInfo& info : shapes) signatures.push_back(database.get(info.name).data.signature);
  std::vector<std::vector<double>> rows(count);
  parallel_rows(count, threads, [&](std::size_t row) {
    for (std::size_t column = 0; column <= row; ++column) {
      rows[row].push_back(match_score(signatures[row], signatures[column]));
    }
  });
  Json json;
  json["shapes"] = Json::array();
  for (const ShapeInfo& info : shapes) json["shapes"].push_back(info_json(info));
  json["scores"] = rows;
  return text_of(json);
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
