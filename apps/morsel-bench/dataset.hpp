// morsel-bench: the folder of a benchmark of segmentations, as the Princeton Segmentation Benchmark
// lays it out: off/N.off, and people's segmentations of it in seg/N/N_k.seg.
//
// Source: X. Chen, A. Golovinskiy, T. Funkhouser, "A Benchmark for 3D Mesh Segmentation",
// SIGGRAPH 2009.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace morsel::bench {

/// One mesh and people's segmentations of it.
struct Model {
  int id = 0;
  std::filesystem::path mesh;
  std::vector<std::filesystem::path> people;  ///< in the order of their numbers
};

/// Which models take part: those with id mod `modulus` = `remainder`.
struct IdFilter {
  int remainder = 0;
  int modulus = 1;

  /// Reads "all" or "RmodM", such as "1mod4". Throws Error(kUsage).
  static IdFilter parse(const std::string& text);
  [[nodiscard]] bool accepts(int id) const { return id % modulus == remainder; }
};

/// Twenty consecutive ids make a category, numbered from 0.
[[nodiscard]] int category_of(int id);
[[nodiscard]] std::string_view category_name(int category);

/// The models of `folder` in ascending order of ids; whatever ids are there.
/// Throws Error(kInput) when there is none.
[[nodiscard]] std::vector<Model> list_models(const std::filesystem::path& folder,
                                             const IdFilter& filter);

/// Reads one label a line, one line a face. Throws Error(kInput) naming file and line.
[[nodiscard]] std::vector<int> read_face_labels(const std::filesystem::path& path,
                                                std::size_t face_count);

/// The face labels of all people who segmented the model. Throws Error(kInput), also if there are
/// none.
[[nodiscard]] std::vector<std::vector<int>> read_people(const Model& model, std::size_t face_count);

}  // namespace morsel::bench
