#include "match/paper.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

namespace morsel {
namespace {

// Parts that take part: the paper speaks of fewer than ten significant ones.
constexpr std::size_t kMostPoints = 8;

std::vector<Blob> heaviest(const Signature& signature) {
  std::vector<Blob> blobs = blobs_of(signature);
  if (blobs.size() > kMostPoints) blobs.resize(kMostPoints);
  return blobs;
}

// Turns the source by the smallest angle so that direction `from` points along `to`.
Eigen::Matrix3d turn_onto(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

// The roll about `axis` that brings the points of both shapes closest around it: the mean angle
// between their arms, by weight, length and how well their places along the axis agree.
double best_roll(const std::vector<Blob>& target, const std::vector<Blob>& source,
                 const Eigen::Vector3d& axis) {
  constexpr double kTolerance = 0.5;  // RMS radii
  const Eigen::Vector3d side = axis.unitOrthogonal();
  const Eigen::Vector3d up = axis.cross(side);
  std::complex<double> sum = 0.0;
  for (const Blob& p : target) {
    const std::complex<double> arm_p(p.mean.dot(side), p.mean.dot(up));
    for (const Blob& q : source) {
      const std::complex<double> arm_q(q.mean.dot(side), q.mean.dot(up));
      const double along = (p.mean - q.mean).dot(axis);
      const double out = std::abs(arm_p) - std::abs(arm_q);
      const double agree = std::exp(-0.5 * (along * along + out * out) / (kTolerance * kTolerance));
      sum += p.weight * q.weight * agree * arm_p * std::conj(arm_q);
    }
  }
  return std::arg(sum);
}

std::vector<Blob> about_heaviest(std::vector<Blob> blobs) {
  const Eigen::Vector3d anchor = blobs.front().mean;
  for (Blob& blob : blobs) blob.mean -= anchor;
  return blobs;
}

// The orthogonal maps that lay one line from the heaviest point onto another, roll solved.
std::vector<Eigen::Matrix3d> line_alignments(const std::vector<Blob>& target,
                                             const std::vector<Blob>& source, bool mirror) {
  std::vector<Eigen::Matrix3d> turns;
  for (const bool reflected : {false, true}) {
    if (reflected && !mirror) continue;
    const Eigen::Matrix3d image =
        Eigen::Vector3d(1.0, 1.0, reflected ? -1.0 : 1.0).asDiagonal().toDenseMatrix();
    for (std::size_t i = 1; i < target.size(); ++i) {
      for (std::size_t k = 1; k < source.size(); ++k) {
        const Eigen::Vector3d axis = target[i].mean.normalized();
        Alignment onto;
        onto.target_from_source = turn_onto(image * source[k].mean, axis) * image;
        const double roll = best_roll(target, moved(source, onto), axis);
        turns.push_back(Eigen::AngleAxisd(roll, axis) * onto.target_from_source);
      }
    }
  }
  return turns;
}

// In one order for both, so that exchanging them changes nothing but the direction.
PaperMatch ordered_score(const Signature& target, const Signature& source, bool mirror) {
  const std::vector<Blob> to = heaviest(target);
  const std::vector<Blob> from = heaviest(source);
  PaperMatch best;
  if (to.empty() || from.empty()) return best;
  const double own = overlap(to, to) + overlap(from, from);
  const std::vector<Blob> to_anchored = about_heaviest(to);
  const std::vector<Blob> from_anchored = about_heaviest(from);
  std::vector<Eigen::Matrix3d> turns = line_alignments(to_anchored, from_anchored, mirror);
  turns.push_back(Eigen::Matrix3d::Identity());
  for (const Eigen::Matrix3d& turn : turns) {
    Alignment alignment;
    alignment.target_from_source = turn;
    alignment.shift = to.front().mean - turn * from.front().mean;
    alignment.overlap = overlap(to, moved(from, alignment));
    if (alignment.overlap > best.alignment.overlap) best.alignment = alignment;
  }
  best.score = std::min(1.0, 2.0 * best.alignment.overlap / own);
  return best;
}

Alignment inverse(const Alignment& alignment) {
  Alignment result = alignment;
  result.target_from_source = alignment.target_from_source.transpose();
  result.shift = -(result.target_from_source * alignment.shift);
  return result;
}

// Similarity of matched points minus the weight of unmatched ones.
double greedy_score(const std::vector<Blob>& target, const std::vector<Blob>& source) {
  constexpr double kNear = 0.15;  // of the bounding box's diagonal
  std::vector<bool> taken(source.size(), false);
  double score = 0.0;
  double rest = 1.0;
  for (const Blob& p : target) {
    std::size_t best = source.size();
    double closest = kNear;
    for (std::size_t k = 0; k < source.size(); ++k) {
      const double apart = (p.mean - source[k].mean).norm();
      if (!taken[k] && apart <= closest) {
        closest = apart;
        best = k;
      }
    }
    if (best == source.size()) continue;
    taken[best] = true;
    const double shared = std::min(p.weight, source[best].weight);
    score += shared * (1.0 - closest / kNear);
    rest -= shared;
  }
  return std::max(0.0, score - std::max(0.0, rest));
}

}  // namespace

PaperMatch paper_score(const Signature& target, const Signature& source, bool mirror) {
  if (target.parts == source.parts) {
    PaperMatch same;
    same.score = 1.0;
    return same;
  }
  if (!(encode(source) < encode(target))) return ordered_score(target, source, mirror);
  PaperMatch match = ordered_score(source, target, mirror);
  match.alignment = inverse(match.alignment);
  return match;
}

double literal_paper_score(const Signature& target, const Signature& source, double unit_target,
                           double unit_source) {
  std::vector<Blob> to = heaviest(target);
  std::vector<Blob> from = heaviest(source);
  if (to.empty() || from.empty()) return 0.0;
  for (Blob& blob : to) blob.mean *= unit_target;
  for (Blob& blob : from) blob.mean *= unit_source;
  to = about_heaviest(to);
  from = about_heaviest(from);
  double best = greedy_score(to, from);
  for (std::size_t i = 1; i < to.size(); ++i) {
    for (std::size_t k = 1; k < from.size(); ++k) {
      Alignment onto;
      onto.target_from_source = turn_onto(from[k].mean, to[i].mean);
      best = std::max(best, greedy_score(to, moved(from, onto)));
    }
  }
  return best;
}

}  // namespace morsel
