// morsel-bench: shapes with classes, in whatever layout a benchmark of retrieval has.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset.hpp"

namespace morsel::bench {

struct ClassedShape {
  std::filesystem::path path;
  std::string name;  ///< the file's without extension
  std::string category;
};

/// The shapes of a classification file of the Princeton Shape Benchmark (.cla): models N are the
/// files mN.* below `folder`; models without a file are passed over. By name.
/// Source: P. Shilane, P. Min, M. Kazhdan, T. Funkhouser, "The Princeton Shape Benchmark", SMI
/// 2004. Throws Error(kInput) naming file and line.
[[nodiscard]] std::vector<ClassedShape> read_classification(const std::filesystem::path& file,
                                                            const std::filesystem::path& folder);

/// off/N.off: twenty consecutive ids make a category, those that `filter` accepts take part. Any
/// other layout: all files below `folder`, the class of each is the folder that holds it.
/// Throws Error(kInput) when there is none.
[[nodiscard]] std::vector<ClassedShape> list_shapes(const std::filesystem::path& folder,
                                                    const IdFilter& filter);

/// (n) the category of each.
[[nodiscard]] std::vector<std::string> categories_of(const std::vector<ClassedShape>& shapes);

}  // namespace morsel::bench
