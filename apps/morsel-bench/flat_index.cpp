#include "flat_index.hpp"

#include <faiss/IndexFlat.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <vector>

namespace morsel::bench {
namespace {

using Vector = std::array<float, FlatIndex::kDimensions>;

Vector floats_of(std::span<const std::uint8_t> vector) {
  Vector floats{};
  std::copy_n(vector.begin(), std::min(vector.size(), floats.size()), floats.begin());
  return floats;
}

}  // namespace

struct FlatIndex::State {
  faiss::IndexFlat index{kDimensions, faiss::METRIC_L2};
};

FlatIndex::FlatIndex(std::size_t count) : state_(std::make_unique<State>()) {
  state_->index.codes.reserve(count * sizeof(Vector));
}
FlatIndex::~FlatIndex() = default;

void FlatIndex::add(std::span<const std::uint8_t> vector) {
  state_->index.add(1, floats_of(vector).data());
}

std::int64_t FlatIndex::search(std::span<const std::uint8_t> vector, std::size_t k,
                               bool squared) const {
  omp_set_num_threads(1);
  state_->index.metric_type = squared ? faiss::METRIC_L2 : faiss::METRIC_L1;
  std::vector<float> distances(k);
  std::vector<faiss::Index::idx_t> labels(k);
  state_->index.search(1, floats_of(vector).data(), static_cast<faiss::Index::idx_t>(k),
                       distances.data(), labels.data());
  return labels.front();
}

}  // namespace morsel::bench
