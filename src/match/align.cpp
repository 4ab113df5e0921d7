#include "match/align.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <cmath>

namespace morsel {
namespace {

// Standard deviation, in RMS radii, by which blobs are smoothed: shapes of one kind need not agree
// closer.
constexpr double kSmoothing = 0.2;

Eigen::Matrix3d principal_axes(const std::vector<Blob>& blobs) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Blob& blob : blobs) {
    moments += blob.weight * (blob.covariance + blob.mean * blob.mean.transpose());
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors();
}

// All ways to lay three axes onto three axes: 6 orders with 8 choices of signs.
std::vector<Eigen::Matrix3d> axis_permutations() {
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  std::vector<Eigen::Matrix3d> all;
  for (const auto& order : kOrders) {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) m(i, order[i]) = (signs >> i & 1) != 0 ? -1.0 : 1.0;
      all.push_back(m);
    }
  }
  return all;
}

}  // namespace

std::vector<Blob> blobs_of(const Signature& signature) {
  std::vector<Blob> blobs;
  for (const SignaturePart& part : signature.parts) {
    const auto& c = part.covariance;
    Blob blob;
    blob.weight = part.weight;
    blob.mean = {part.center.x, part.center.y, part.center.z};
    blob.covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
    blobs.push_back(blob);
  }
  return blobs;
}

double overlap(const std::vector<Blob>& a, const std::vector<Blob>& b) {
  double sum = 0.0;
  for (const Blob& p : a) {
    for (const Blob& q : b) {
      const Eigen::Matrix3d spread = p.covariance + q.covariance +
                                     2.0 * kSmoothing * kSmoothing * Eigen::Matrix3d::Identity();
      const Eigen::Vector3d apart = p.mean - q.mean;
      const double exponent = apart.dot(spread.inverse() * apart);
      sum += p.weight * q.weight * std::exp(-0.5 * exponent) / std::sqrt(spread.determinant());
    }
  }
  return sum;
}

std::vector<Blob> turned(const std::vector<Blob>& blobs, const Eigen::Matrix3d& by) {
  std::vector<Blob> result = blobs;
  for (Blob& blob : result) {
    blob.mean = by * blob.mean;
    blob.covariance = by * blob.covariance * by.transpose();
  }
  return result;
}

Alignment align(const std::vector<Blob>& target, const std::vector<Blob>& source, bool mirror) {
  Alignment best;
  if (target.empty() || source.empty()) return best;
  const Eigen::Matrix3d to = principal_axes(target);
  const Eigen::Matrix3d from = principal_axes(source).transpose();
  for (const Eigen::Matrix3d& permutation : axis_permutations()) {
    const Eigen::Matrix3d turn = to * permutation * from;
    if (!mirror && turn.determinant() < 0.0) continue;
    const double value = overlap(target, turned(source, turn));
    if (value > best.overlap) best = {turn, value};
  }
  return best;
}

}  // namespace morsel
