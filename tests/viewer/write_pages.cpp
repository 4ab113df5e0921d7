// Writes pages and the C++ cuts of their merge trees, for the viewer's tests to compare.
//   write_pages FOLDER
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "base/test_shapes.hpp"
#include "html/test_tree.hpp"

namespace {

using morsel::MergeTree;
using morsel::Part;
using Json = nlohmann::ordered_json;

Json part_json(const Part& part) {
  Json json{
      {"volume", part.volume},          {"center", {part.center.x, part.center.y, part.center.z}},
      {"covariance", part.covariance},  {"ballRadius", part.ball_radius},
      {"pointCount", part.point_count}, {"neighbors", Json::array()}};
  for (const morsel::PartNeighbor& neighbor : part.neighbors) {
    json["neighbors"].push_back({{"part", neighbor.part}, {"neckRadius", neighbor.neck_radius}});
  }
  return json;
}

Json level_json(const MergeTree& tree, const MergeTree::Level& level) {
  const morsel::Parts cut = morsel::cut(tree, {.parts = {}, .merge_ratio = level.from_ratio});
  Json json{{"parts", level.parts},
            {"fromRatio", level.from_ratio},
            {"toRatio", std::isfinite(level.to_ratio) ? Json(level.to_ratio) : Json(nullptr)},
            {"partOfPiece", cut.part_of_piece},
            {"measures", Json::array()}};
  for (const Part& part : cut.parts) json["measures"].push_back(part_json(part));
  return json;
}

void write(const std::filesystem::path& folder, const std::string& name,
           const morsel::shapes::Points& points, const MergeTree& tree) {
  morsel::write_html(folder / (name + ".html"), points, tree, {.name = name});
  Json levels = Json::array();
  for (const MergeTree::Level& level : tree.levels()) levels.push_back(level_json(tree, level));
  std::ofstream(folder / (name + ".json")) << levels.dump();
}

void write_all(const std::filesystem::path& folder) {
  using namespace morsel::shapes;
  std::filesystem::create_directories(folder);
  const Points ball = sphere(2000);
  write(folder, "random_tree", ball, random_tree(450, ball.size()));
  write(folder, "single_piece", ball, random_tree(3, ball.size()));
  const Points bells = joined(noisy(dumbbell(8000), 0.01), moved(sphere(1500), {0, 4, 0}));
  write(folder, "dumbbell", bells, morsel::segment(bells).tree);
  morsel::SegmentOptions paper;
  paper.interior.method = morsel::Method::kPaper;
  paper.interior.deep_angle = 10.0;
  const Points smooth = dumbbell(1500);
  write(folder, "paper", smooth, morsel::segment(smooth, paper).tree);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_pages FOLDER\n";
    return 2;
  }
  try {
    write_all(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
