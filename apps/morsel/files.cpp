#include "files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <morsel/error.hpp>
#include <set>
#include <string_view>
#include <system_error>

#include "base/lower_case.hpp"

namespace morsel::cli {
namespace {

namespace fs = std::filesystem;

// Tables and notes come as .txt and .csv too: those are taken only when they are named.
constexpr std::array<std::string_view, 12> kExtensions{".ply", ".pcd", ".xyz",  ".pts",
                                                       ".asc", ".off", ".obj",  ".npy",
                                                       ".las", ".stl", ".gltf", ".glb"};

bool is_shape(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::follow_directory_symlink,
                                      error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (is_hidden(at->path())) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file(error) && is_shape(at->path())) {
      files.push_back(at->path());
    }
  }
  if (error) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  }
  if (files.empty()) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: no file below it is a shape; their names end in "
                            "{}",
                            folder.string(), fmt::join(kExtensions, " ")));
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string without_line_end(std::string line) {
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

std::vector<fs::path> manifest() {
  std::vector<fs::path> files;
  for (std::string line; std::getline(std::cin, line);) {
    line = without_line_end(line);
    if (!line.empty() && line.front() != '#') files.emplace_back(line);
  }
  if (std::cin.bad()) throw Error(ErrorCode::kInput, "standard input: cannot be read");
  return files;
}

std::vector<fs::path> expand(const std::string& path) {
  if (path == "-") return manifest();
  std::error_code error;
  if (fs::is_directory(path, error)) return files_below(path);
  return {path};
}

std::string unquoted(std::string field) {
  const auto outer = [](char c) { return c == ' ' || c == '\t' || c == '"'; };
  while (!field.empty() && outer(field.back())) field.pop_back();
  const auto first = std::find_if_not(field.begin(), field.end(), outer);
  return {first, field.end()};
}

}  // namespace

std::vector<ShapeFile> collect_files(const std::vector<std::string>& paths) {
  std::vector<ShapeFile> files;
  std::set<std::string> names;
  for (const std::string& path : paths) {
    for (const fs::path& file : expand(path)) {
      std::string name = file.lexically_normal().generic_string();
      if (names.insert(name).second) files.push_back({file, std::move(name), {}, {}});
    }
  }
  return files;
}

std::map<std::string, std::string> read_classes(const fs::path& file) {
  std::ifstream stream(file);
  const auto fail = [&](const std::string& reason) {
    throw Error(ErrorCode::kInput, fmt::format("{}{}", file.string(), reason));
  };
  if (!stream || fs::is_directory(file))
    fail(": cannot be read; --class takes 'folder' or a CSV file");
  std::map<std::string, std::string> classes;
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    line = without_line_end(line);
    ++number;
    if (line.empty() || (number == 1 && line == "name,class")) continue;
    const std::size_t comma = line.rfind(',');
    if (comma == std::string::npos)
      fail(fmt::format(":{}: has no comma; expected name,class", number));
    classes[unquoted(line.substr(0, comma))] = unquoted(line.substr(comma + 1));
  }
  return classes;
}

std::size_t assign_classes(std::vector<ShapeFile>& files,
                           const std::map<std::string, std::string>& classes) {
  std::size_t without = 0;
  for (ShapeFile& file : files) {
    for (const std::string& key :
         {file.name, file.path.filename().string(), file.path.stem().string()}) {
      const auto at = classes.find(key);
      if (at == classes.end()) continue;
      file.class_name = at->second;
      break;
    }
    if (!file.class_name) ++without;
  }
  return without;
}

void assign_folders(std::vector<ShapeFile>& files) {
  for (ShapeFile& file : files) {
    file.class_name = fs::absolute(file.path).lexically_normal().parent_path().filename().string();
  }
}

}  // namespace morsel::cli
