#include "collection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <morsel/error.hpp>
#include <sstream>

namespace morsel::bench {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

[[noreturn]] void fail(const fs::path& file, std::size_t line, const std::string& reason) {
  throw Error(ErrorCode::kInput, fmt::format("{}:{}: {}", file.string(), line, reason));
}

// Class of each model number.
std::map<std::string, std::string> read_classes(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Error(ErrorCode::kInput, fmt::format("{}: cannot be read", file.string()));
  std::map<std::string, std::string> classes;
  std::string line;
  std::string category;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::istringstream words(line);
    const std::vector<std::string> parts{std::istream_iterator<std::string>(words), {}};
    if (number == 1 && (parts.empty() || parts[0] != "PSB")) {
      fail(file, number, "a classification begins with \"PSB 1\"");
    }
    if (number <= 2 || parts.empty()) continue;
    if (parts.size() == 3) {
      category = parts[0];
    } else if (parts.size() == 1 && !category.empty()) {
      classes[parts[0]] = category;
    } else {
      fail(file, number, "expected a class (name, parent, count) or the number of a model");
    }
  }
  return classes;
}

}  // namespace

std::vector<ClassedShape> read_classification(const fs::path& file, const fs::path& folder) {
  const std::map<std::string, std::string> classes = read_classes(file);
  std::vector<ClassedShape> shapes;
  for (const fs::path& path : files_below(folder)) {
    const std::string stem = path.stem().string();
    if (stem.size() < 2 || stem[0] != 'm') continue;
    const auto found = classes.find(stem.substr(1));
    if (found != classes.end()) shapes.push_back({path, stem, found->second});
  }
  if (shapes.empty()) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: none of the {} models of {} is there; expected files mN.off",
                            folder.string(), classes.size(), file.string()));
  }
  return shapes;
}

std::vector<ClassedShape> list_shapes(const fs::path& folder, const IdFilter& filter) {
  std::vector<ClassedShape> shapes;
  if (fs::is_directory(folder / "off")) {
    for (const Model& model : list_models(folder, filter)) {
      shapes.push_back({model.mesh, std::to_string(model.id),
                        std::string(category_name(category_of(model.id)))});
    }
    return shapes;
  }
  for (const fs::path& path : files_below(folder)) {
    shapes.push_back({path, path.stem().string(), path.parent_path().filename().string()});
  }
  if (shapes.empty()) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: no files; expected off/N.off, or a folder for each class",
                            folder.string()));
  }
  return shapes;
}

std::vector<std::string> categories_of(const std::vector<ClassedShape>& shapes) {
  std::vector<std::string> categories;
  for (const ClassedShape& shape : shapes) categories.push_back(shape.category);
  return categories;
}

}  // namespace morsel::bench
