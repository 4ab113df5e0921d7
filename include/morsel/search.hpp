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

namespace block {
class Mapping;
}

/// One answer: the shape's index in the block.
struct Hit {
  std::size_t index = 0;
  double score = 0.0;
};

/// Writes signatures and their names for SearchBlock one by one: some megabytes of memory however
/// many there are. The file is there complete after commit(), and not at all before.
class SearchBlockWriter {
 public:
  /// Throws Error(kOutput) when the file cannot be made.
  explicit SearchBlockWriter(const std::filesystem::path& path);
  SearchBlockWriter(SearchBlockWriter&&) noexcept;
  SearchBlockWriter& operator=(SearchBlockWriter&&) noexcept;
  ~SearchBlockWriter();

  /// Indices are given in the order of the calls. Throws Error(kUsage) as encode() does.
  void add(std::string_view name, const Signature& signature);
  /// Throws Error(kOutput), e.g. when the disk is full.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes all at once. As many names as signatures. Throws Error(kUsage), Error(kOutput).
void write_search_block(const std::filesystem::path& path, std::span<const std::string> names,
                        std::span<const Signature> signatures);

/// A read-only file of signatures, mapped into memory. Safe to use from several threads.
class SearchBlock {
 public:
  /// Maps the file and reads 32 bytes for each 4096 shapes; everything else is checked when it is
  /// read. Throws Error(kInput) that says what is wrong.
  [[nodiscard]] static SearchBlock open(const std::filesystem::path& path);
  SearchBlock(SearchBlock&&) noexcept;
  SearchBlock& operator=(SearchBlock&&) noexcept;
  ~SearchBlock();

  /// Number of shapes.
  [[nodiscard]] std::size_t size() const;
  /// Valid as long as the block. Throws Error(kInput) when the file was damaged there.
  [[nodiscard]] std::string_view name(std::size_t index) const;
  /// As it was written. Throws Error(kInput) when the file was damaged there.
  [[nodiscard]] Signature signature(std::size_t index) const;

  /// The `k` shapes of the highest scores, best first, equal scores by name: exactly what scoring
  /// every shape would give, with most of them skipped by upper bounds of their score. Throws
  /// Error(kInput) rather than to answer from damaged bytes.
  /// Cost: 100 bytes read of every shape, one kilobyte of those that the bounds do not rule out.
  /// `looked_at`: how many these were.
  [[nodiscard]] std::vector<Hit> search(const Signature& query, std::size_t k,
                                        const MatchOptions& options = {},
                                        std::size_t* looked_at = nullptr) const;

 private:
  explicit SearchBlock(std::unique_ptr<const block::Mapping> mapping);
  std::unique_ptr<const block::Mapping> mapping_;
};

}  // namespace morsel
