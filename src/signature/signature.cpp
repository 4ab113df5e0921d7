// From the stages' results to the few numbers that are kept of a shape.

#include <algorithm>
#include <cmath>
#include <morsel/signature.hpp>

#include "signature/solid.hpp"
#include "signature/tables.hpp"

namespace morsel {
namespace {

// From the exact second moments of the parts, which add up.
Frame frame_of_parts(const Parts& parts) {
  double volume = 0.0;
  for (const Part& part : parts.parts) volume += part.volume;
  Frame frame;
  for (const Part& part : parts.parts) {
    frame.centroid = frame.centroid + (part.volume / volume) * part.center;
  }
  double spread = 0.0;
  for (const Part& part : parts.parts) {
    spread += part.volume / volume *
              (squared_distance(part.center, frame.centroid) + part.covariance[0] +
               part.covariance[3] + part.covariance[5]);
  }
  frame.size = std::sqrt(spread);
  return frame;
}

std::vector<SignaturePart> heaviest_parts(const Parts& parts, const Frame& frame) {
  double volume = 0.0;
  for (const Part& part : parts.parts) volume += part.volume;
  const std::size_t count = std::min(parts.parts.size(), kMostSignatureParts);
  std::vector<SignaturePart> kept(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Part& part = parts.parts[i];
    kept[i].weight = part.volume / volume;
    kept[i].center = (1.0 / frame.size) * (part.center - frame.centroid);
    for (std::size_t k = 0; k < 6; ++k) {
      kept[i].covariance[k] = part.covariance[k] / (frame.size * frame.size);
    }
    kept[i].ball_radius = part.ball_radius / frame.size;
    for (const PartNeighbor& neighbor : part.neighbors) {
      if (static_cast<std::size_t>(neighbor.part) >= count) continue;
      kept[i].neighbors.push_back({neighbor.part, neighbor.neck_radius / frame.size});
    }
  }
  return kept;
}

}  // namespace

Signature make_signature(const DelaunayComplex& complex, const Basins& basins, const Parts& parts,
                         int threads) {
  Signature signature;
  if (complex.dimension < 3) return decode(encode(signature));
  const Frame frame =
      parts.parts.empty() ? frame_of_points(complex.vertices) : frame_of_parts(parts);
  signature.centroid = frame.centroid;
  signature.size = frame.size;
  signature.parts = heaviest_parts(parts, frame);
  signature.tables = make_tables(complex, basins, threads);
  return decode(encode(signature));
}

}  // namespace morsel
