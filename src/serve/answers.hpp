// What the API says, as JSON text: values in, text out; docs/openapi.json has the schemas.
#pragma once

#include <cstddef>
#include <morsel/database.hpp>
#include <morsel/serve.hpp>
#include <optional>
#include <string>
#include <vector>

#include "serve/uploads.hpp"

namespace morsel::serve {

inline constexpr std::size_t kMostMatrixShapes = 2000;
inline constexpr std::size_t kMostListed = 200;
inline constexpr std::size_t kMostHits = 100;

/// Which of the stored shapes are meant.
struct ShapeChoice {
  std::string text;  ///< that name, class or a tag contains, whatever the case of ASCII letters
  std::optional<std::string> class_name;
};

/// A query, stored or uploaded.
struct QueryShape {
  std::string name;
  bool stored = false;
  ShapeData data;
};

[[nodiscard]] std::string error_json(const std::string& message);

[[nodiscard]] std::string database_json(const Database& database, const ServeOptions& options);
[[nodiscard]] std::string shapes_json(const Database& database, const ShapeChoice& choice,
                                      std::size_t offset, std::size_t limit);
[[nodiscard]] std::string stored_shape_json(const StoredShape& shape);
[[nodiscard]] std::string sketch_json(const ShapeData& data);
/// For the viewer of parts.
[[nodiscard]] std::string parts_json(const StoredShape& shape);
[[nodiscard]] std::string search_json(const Database& database, const QueryShape& query,
                                      std::size_t top);
/// Score, alignment, why, and the other shape's points laid onto the query.
[[nodiscard]] std::string match_json(const QueryShape& query, const StoredShape& other);
[[nodiscard]] std::vector<std::string> chosen_names(const Database& database,
                                                    const ShapeChoice& choice);
/// Scores rounded to six digits, as morsel matrix writes them.
[[nodiscard]] std::string matrix_json(const SimilarityMatrix& matrix);
[[nodiscard]] std::string upload_json(const std::string& id, const UploadState& state);

}  // namespace morsel::serve
