// Laying the parts of one shape onto those of another.
#pragma once

#include <Eigen/Core>
#include <morsel/signature.hpp>
#include <vector>

namespace morsel {

/// A part as a cloud of mass: weight, mean and covariance, lengths in RMS radii.
struct Blob {
  double weight = 0.0;
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
};

[[nodiscard]] std::vector<Blob> blobs_of(const Signature& signature);

/// Overlap ∫ f g of two mixtures of blobs, each smoothed a little.
[[nodiscard]] double overlap(const std::vector<Blob>& a, const std::vector<Blob>& b);

struct Alignment {
  Eigen::Matrix3d target_from_source = Eigen::Matrix3d::Identity();  ///< orthogonal
  double overlap = 0.0;
};

/// The rotation about the centroids (or reflection when `mirror`) of the largest overlap.
[[nodiscard]] Alignment align(const std::vector<Blob>& target, const std::vector<Blob>& source,
                              bool mirror);

/// The blobs turned by an orthogonal matrix.
[[nodiscard]] std::vector<Blob> turned(const std::vector<Blob>& blobs, const Eigen::Matrix3d& by);

}  // namespace morsel
