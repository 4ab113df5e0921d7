// morsel-reproduce: one run, its options, its pictures and its figures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <morsel/picture.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace morsel::reproduce {

struct Options {
  std::filesystem::path out = "out/reproduction";
  std::filesystem::path data;                ///< of Debian's libcgal-demo; empty: generated shapes
  std::vector<std::filesystem::path> scans;  ///< raw scans to be cut as well
  std::filesystem::path psb;                 ///< folder of the Princeton Shape Benchmark, or empty
  std::filesystem::path segmentation;        ///< of the Segmentation Benchmark, or empty
  bool quick = false;                        ///< little of everything: to test the program
};

/// What the sections of the page write into.
struct Study {
  Options options;
  nlohmann::ordered_json figures;

  /// How much of something: less when quick.
  [[nodiscard]] std::size_t amount(std::size_t full, std::size_t quick) const {
    return options.quick ? quick : full;
  }
  /// Points of a generated shape or one of a collection.
  [[nodiscard]] std::size_t shape_points() const { return amount(6000, 800); }
  /// Writes figures.json: what there is so far.
  void save() const;
  /// Writes a picture and returns its path below the folder of results, for the page.
  [[nodiscard]] std::string keep(const std::string& name, const Image& image) const;
  [[nodiscard]] std::string keep(const std::string& name, const std::string& svg) const;
};

/// Says how far the run is.
void say(const std::string& what);

}  // namespace morsel::reproduce
