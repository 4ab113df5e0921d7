// morsel: the shapes most like a given one among very many, from a memory-mapped file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <morsel/match.hpp>
#include <morsel/signature.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace morsel {

/// One answer: the shape's index in the block.
struct Hit {
  std::size_t index = 0;
  double score = 0.0;
};

/// Writes signatures and their names for SearchBlock, atomically. As many names as signatures.
/// Throws Error(kUsage), Error(kOutput).
void write_search_block(const std::filesystem::path& path, std::span<const std::string> names,
                        std::span<const Signature> signatures);

/// A read-only file of signatures, mapped into memory. Safe to use from several threads.
class SearchBlock {
 public:
  /// Maps the file; looks at its head alone. Throws Error(kInput) that says what is wrong.
  [[nodiscard]] static SearchBlock open(const std::filesystem::path& path);
  SearchBlock(SearchBlock&&) noexcept;
  SearchBlock& operator=(SearchBlock&&) noexcept;
  ~SearchBlock();

  [[nodiscard]] std::size_t size() const;
  /// Valid as long as the block.
  [[nodiscard]] std::string_view name(std::size_t index) const;
  /// Throws Error(kInput) when the file was damaged there.
  [[nodiscard]] Signature signature(std::size_t index) const;

  /// The `k` shapes of the highest scores, best first, equal scores by name: exactly what scoring
  /// every shape would give, with most of them skipped by upper bounds of their score.
  [[nodiscard]] std::vector<Hit> search(const Signature& query, std::size_t k,
                                        const MatchOptions& options = {}) const;

 private:
  class Mapping;
  explicit SearchBlock(std::unique_ptr<Mapping> mapping);
  std::unique_ptr<Mapping> mapping_;
};

}  // namespace morsel
