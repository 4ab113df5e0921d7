// Stands in for flat_index.cpp where there is no FAISS.
#include <morsel/error.hpp>

#include "flat_index.hpp"

namespace morsel::bench {

struct FlatIndex::State {};

FlatIndex::FlatIndex(std::size_t) {
  throw Error(ErrorCode::kUsage, "built without FAISS; install libfaiss-dev and build anew");
}
FlatIndex::~FlatIndex() = default;
void FlatIndex::add(std::span<const std::uint8_t>) {}
std::int64_t FlatIndex::search(std::span<const std::uint8_t>, std::size_t, bool) const {
  return -1;
}

}  // namespace morsel::bench
