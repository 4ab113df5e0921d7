// morsel-reproduce: shapes of a collection, what the methods make of them, and how they are
// compared.
#pragma once

#include <functional>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ranking.hpp"
#include "solids/families.hpp"

namespace morsel::reproduce {

/// A sampled shape of some class.
struct Shape {
  std::string name;
  std::string category;
  std::vector<Vec3> points;
  std::vector<int>
      truth;  ///< part of each of the first points; empty: not known. Others are outliers
};

/// The published rules with the published numbers. The angle below which balls meet deeply is not
/// published; 10° is that of a later program of one of the authors.
[[nodiscard]] SegmentOptions paper_options();
/// The default method. Both on one thread: shapes are worked on side by side.
[[nodiscard]] SegmentOptions default_options();

/// 1 - Rand index of the labels of the points whose part is known; points without a part are one
/// part. Nothing when none is known.
[[nodiscard]] std::optional<double> rand_error_of(std::span<const int> labels, const Shape& shape);

/// What both methods make of a shape.
struct Described {
  Signature signature;                ///< default method
  Signature paper_signature;          ///< the paper's rules
  std::vector<int> labels;            ///< default method
  Parts parts;                        ///< default method
  Parts paper_parts;                  ///< empty where the rules found no solid
  bool solid = false;                 ///< default method
  std::optional<double> error;        ///< Rand error, default method
  std::optional<double> paper_error;  ///< the paper's rules
  std::vector<double> d2;
  double diagonal = 1.0;  ///< of the axis-parallel box
};

/// Several shapes at a time. A shape that cannot be read or cut at all has empty signatures.
[[nodiscard]] std::vector<Described> describe_all(std::span<const Shape> shapes);

/// Which member of a family is sampled how.
struct Sampling {
  std::size_t points = 8000;
  double noise = 0.002;    ///< of the diagonal
  double outliers = 0.0;   ///< as a share of the points
  std::uint64_t seed = 1;  ///< another one is another sample in another position
};
[[nodiscard]] Shape make_shape(const solids::Member& member, const Sampling& sampling);

/// The first members of each family.
[[nodiscard]] std::vector<Shape> make_members(std::size_t members, const Sampling& sampling);

/// A way to say how alike two shapes are; higher is more alike.
struct Scoring {
  std::string name;
  std::function<double(const Described&, const Described&)> score;
};
/// Default; the paper's score of our parts; of its own parts; to the letter; D2.
[[nodiscard]] const std::vector<Scoring>& scorings();
enum ScoringIndex : std::size_t { kDefaultScore, kPaperOurParts, kPaperScore, kLiteral, kD2 };

/// (queries, stored) row-major, on all cores.
[[nodiscard]] std::vector<double> score_all(const Scoring& scoring,
                                            std::span<const Described> queries,
                                            std::span<const Described> stored);

/// Name and measures of a scoring: `scores` is (queries, stored) row-major, `queries` says which of
/// the stored shapes each query is.
[[nodiscard]] nlohmann::ordered_json measures_json(const Scoring& scoring,
                                                   std::span<const double> scores,
                                                   std::span<const std::string> categories,
                                                   std::span<const std::size_t> queries);
/// 0 … count - 1: all shapes ask.
[[nodiscard]] std::vector<std::size_t> all_of(std::size_t count);

/// Shapes, what is known of them, and the scores of all pairs.
struct Collection {
  std::vector<Shape> shapes;
  std::vector<Described> described;
  std::vector<std::string> categories;
  std::vector<std::vector<double>> scores;  ///< as scorings(), each (n, n)

  [[nodiscard]] std::size_t size() const { return shapes.size(); }
  [[nodiscard]] double score(std::size_t scoring, std::size_t a, std::size_t b) const {
    return scores[scoring][a * size() + b];
  }
  /// All but the query itself, best first, equal ones in their order.
  [[nodiscard]] std::vector<std::size_t> ranked(std::size_t scoring, std::size_t query) const;
};
[[nodiscard]] Collection make_collection(std::vector<Shape> shapes);

}  // namespace morsel::reproduce
