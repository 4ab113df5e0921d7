#include "dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <morsel/error.hpp>
#include <optional>
#include <system_error>
#include <utility>

namespace morsel::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kCategorySize = 20;
constexpr std::array<std::string_view, 20> kCategoryNames = {
    "Human",     "Cup",   "Glasses", "Airplane", "Ant",  "Chair",  "Octopus",
    "Table",     "Teddy", "Hand",    "Plier",    "Fish", "Bird",   "(none)",
    "Armadillo", "Bust",  "Mech",    "Bearing",  "Vase", "FourLeg"};

std::optional<int> parse_int(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// The files NUMBER.off or N_NUMBER.seg of a folder with their numbers, ascending; others are passed
// over. A folder that is not there has none.
std::vector<std::pair<int, fs::path>> numbered_files(const fs::path& folder,
                                                     const std::string& prefix,
                                                     const std::string& extension) {
  std::vector<std::pair<int, fs::path>> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != extension || !stem.starts_with(prefix)) continue;
    const auto number = parse_int(std::string_view(stem).substr(prefix.size()));
    if (number && *number >= 0) files.emplace_back(*number, entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string_view trimmed(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = line.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlank) - first + 1);
}

}  // namespace

IdFilter IdFilter::parse(const std::string& text) {
  if (text == "all") return {};
  const auto split = text.find("mod");
  if (split != std::string::npos) {
    const auto remainder = parse_int(std::string_view(text).substr(0, split));
    const auto modulus = parse_int(std::string_view(text).substr(split + 3));
    if (remainder && modulus && 0 <= *remainder && *remainder < *modulus) {
      return {.remainder = *remainder, .modulus = *modulus};
    }
  }
  throw Error(ErrorCode::kUsage,
              fmt::format("--ids is '{}'; expected all or RmodM with R < M, such as 1mod4", text));
}

int category_of(int id) { return (id - 1) / kCategorySize; }

std::string_view category_name(int category) {
  if (category < 0 || category >= static_cast<int>(kCategoryNames.size())) return "(other)";
  return kCategoryNames[static_cast<std::size_t>(category)];
}

std::vector<Model> list_models(const fs::path& folder, const IdFilter& filter) {
  std::vector<Model> models;
  for (const auto& [id, mesh] : numbered_files(folder / "off", "", ".off")) {
    if (!filter.accepts(id)) continue;
    Model model{.id = id, .mesh = mesh, .people = {}};
    const std::string name = std::to_string(id);
    for (auto& [number, path] : numbered_files(folder / "seg" / name, name + "_", ".seg")) {
      model.people.push_back(std::move(path));
    }
    models.push_back(std::move(model));
  }
  if (models.empty()) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: no models of these ids; expected meshes off/N.off and people's "
                            "segmentations seg/N/N_k.seg",
                            folder.string()));
  }
  return models;
}

std::vector<int> read_face_labels(const fs::path& path, std::size_t face_count) {
  std::ifstream file(path);
  if (!file) throw Error(ErrorCode::kInput, fmt::format("{}: cannot be read", path.string()));
  std::vector<int> labels;
  labels.reserve(face_count);
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (trimmed(line).empty()) continue;
    const auto label = parse_int(trimmed(line));
    if (!label) {
      throw Error(ErrorCode::kInput,
                  fmt::format("{}:{}: expected one integer label", path.string(), number));
    }
    labels.push_back(*label);
  }
  if (labels.size() != face_count) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: {} labels; the mesh has {} faces, one label each is expected",
                            path.string(), labels.size(), face_count));
  }
  return labels;
}

std::vector<std::vector<int>> read_people(const Model& model, std::size_t face_count) {
  std::vector<std::vector<int>> people;
  for (const auto& path : model.people) people.push_back(read_face_labels(path, face_count));
  if (people.empty()) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: nobody's segmentation is there", model.mesh.string()));
  }
  return people;
}

}  // namespace morsel::bench
