// Exhaustive search among vectors of floats by FAISS, the usual way to find nearest descriptors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace morsel::bench {

/// One query at a time on one thread.
class FlatIndex {
 public:
  static constexpr std::size_t kDimensions = 640;  ///< as of PCL's ESF

  /// Throws Error(kUsage) when FAISS was not there at build time.
  explicit FlatIndex(std::size_t count);
  ~FlatIndex();

  /// Values beyond `vector` are zero.
  void add(std::span<const std::uint8_t> vector);
  /// Index of the nearest by squared L2 or L1 distance.
  [[nodiscard]] std::int64_t search(std::span<const std::uint8_t> vector, std::size_t k,
                                    bool squared) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace morsel::bench
