#include "signature/landmarks.hpp"

#include <Eigen/Eigenvalues>

namespace morsel {
namespace {

// The points owned by each landmark and the farthest of them.
class FarthestFirst {
 public:
  FarthestFirst(std::span<const Vec3> points, const Vec3& center) : points_(points) {
    members_.emplace_back(points.size());
    squared_.resize(points.size());
    std::size_t first = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      members_[0][i] = static_cast<std::uint32_t>(i);
      squared_[i] = squared_distance(points[i], center);
      if (squared_[i] > squared_[first]) first = i;
    }
    seeds_.push_back(points[first]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      squared_[i] = squared_distance(points[i], seeds_[0]);
    }
    farthest_.push_back(find_farthest(0));
  }

  // False when every point is a landmark already.
  bool add() {
    std::size_t widest = 0;
    for (std::size_t k = 1; k < seeds_.size(); ++k) {
      if (reach(k) > reach(widest)) widest = k;
    }
    if (!(reach(widest) > 0.0)) return false;
    const Vec3 seed = points_[farthest_[widest]];
    std::vector<std::uint32_t> taken;
    for (std::size_t k = 0; k < seeds_.size(); ++k) {
      // A point can only be nearer to the new landmark than to its own when the two landmarks are
      // less than twice its distance apart.
      if (squared_distance(seed, seeds_[k]) < 4.0 * reach(k)) take_over(k, seed, taken);
    }
    seeds_.push_back(seed);
    members_.push_back(std::move(taken));
    farthest_.push_back(find_farthest(seeds_.size() - 1));
    return true;
  }

  [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& members() const { return members_; }

 private:
  [[nodiscard]] double reach(std::size_t k) const { return squared_[farthest_[k]]; }

  [[nodiscard]] std::uint32_t find_farthest(std::size_t k) const {
    std::uint32_t best = members_[k].front();
    for (const std::uint32_t i : members_[k]) {
      if (squared_[i] > squared_[best] || (squared_[i] == squared_[best] && i < best)) best = i;
    }
    return best;
  }

  void take_over(std::size_t k, const Vec3& seed, std::vector<std::uint32_t>& taken) {
    std::size_t kept = 0;
    for (const std::uint32_t i : members_[k]) {
      const double squared = squared_distance(points_[i], seed);
      if (squared < squared_[i]) {
        squared_[i] = squared;
        taken.push_back(i);
      } else {
        members_[k][kept++] = i;
      }
    }
    members_[k].resize(kept);
    farthest_[k] = find_farthest(k);
  }

  std::span<const Vec3> points_;
  std::vector<Vec3> seeds_;
  std::vector<std::vector<std::uint32_t>> members_;
  std::vector<double> squared_;          // of each point to its landmark
  std::vector<std::uint32_t> farthest_;  // point of each landmark
};

// Mean and normal of the plane that fits the points best; no normal where they lie on a line.
void fit_plane(std::span<const Vec3> points, const std::vector<std::uint32_t>& members, Vec3& mean,
               Vec3& normal) {
  const double share = 1.0 / static_cast<double>(members.size());
  for (const std::uint32_t i : members) mean = mean + share * points[i];
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : members) {
    const Vec3 arm = points[i] - mean;
    const Eigen::Vector3d v(arm.x, arm.y, arm.z);
    spread += v * v.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  constexpr double kFlat = 1e-9;
  if (!(solver.eigenvalues()[1] > kFlat * solver.eigenvalues()[2])) return;
  const Eigen::Vector3d axis = solver.eigenvectors().col(0);
  normal = {axis.x(), axis.y(), axis.z()};
}

}  // namespace

Landmarks find_landmarks(std::span<const Vec3> points, const Vec3& center, std::size_t count) {
  Landmarks result;
  if (points.empty()) return result;
  FarthestFirst choice(points, center);
  for (std::size_t k = 1; k < count && choice.add(); ++k) {
  }
  const auto& members = choice.members();
  result.owner.resize(points.size());
  result.position.resize(members.size());
  result.normal.resize(members.size());
  result.weight.resize(members.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    for (const std::uint32_t i : members[k]) result.owner[i] = static_cast<std::uint32_t>(k);
    fit_plane(points, members[k], result.position[k], result.normal[k]);
    result.weight[k] = static_cast<double>(members[k].size()) / static_cast<double>(points.size());
  }
  return result;
}

}  // namespace morsel
