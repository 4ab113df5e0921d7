// Laying the parts of one shape onto those of another.
#pragma once

#include <Eigen/Core>
#include <array>
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

/// x ↦ target_from_source · x + shift, lengths in RMS radii, origins at the centroids.
struct Alignment {
  Eigen::Matrix3d target_from_source = Eigen::Matrix3d::Identity();  ///< orthogonal
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double overlap = 0.0;
};

/// The rotation about the centroids (or reflection when `mirror`) of the largest overlap: principal
/// axes onto principal axes in all ways and rotations spread over all, the best of them refined.
/// Cost: some tens of milliseconds for twelve parts.
[[nodiscard]] Alignment align(const std::vector<Blob>& target, const std::vector<Blob>& source,
                              bool mirror);

/// x ↦ linear · x + shift as a row-major 4×4.
[[nodiscard]] std::array<double, 16> as_matrix(const Eigen::Matrix3d& linear,
                                               const Eigen::Vector3d& shift);

[[nodiscard]] std::vector<Blob> moved(const std::vector<Blob>& blobs, const Alignment& by);

}  // namespace morsel
