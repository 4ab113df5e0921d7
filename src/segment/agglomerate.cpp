#include "segment/agglomerate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/cancel.hpp"

namespace morsel {
namespace {

// cost = ((1 - sight) · (max(surface / contact, kLeastIsolation) / kUsualIsolation)^kIsolationPower
//         + ln(ratio / kNoNeck)⁺ + kThicknessWeight · |Δ ln thickness|
//         + kNarrowWeight · ln(π thickness² / contact)⁺ + kCreaseWeight · concavity²)
//        · creased share of the contact
//        · min(surface / contact / kSliceIsolation, 1)^kSlicePower
//        · (20 · share of the smaller side)^kSizePower
//        · min(3 · thickness of the thicker side / radius of the object, 1)^kBulkPower
// tuned on the development shapes with ids ≡ 1 mod 4, confirmed on ≡ 3 mod 4 (docs/method.md).
constexpr double kNoNeck = 1.017;
constexpr double kMostRatio = 5.0;
constexpr double kThicknessWeight = 0.3;
constexpr double kIsolationPower = 0.22;
constexpr double kLeastIsolation = 0.5;
constexpr double kUsualIsolation = 4.0;
constexpr double kNarrowWeight = 0.15;
constexpr double kLeastContact = 1e-6;
constexpr double kCreaseWeight = 0.3;
constexpr double kSliceIsolation = 1.5;
constexpr double kSlicePower = 0.15;
constexpr double kSizePower = 0.17;
constexpr double kBulkPower = 0.14;
constexpr double kNaturalCost = 0.37;

double ratio_of_cost(double cost) { return std::exp(std::max(cost, 0.0)); }

class Agglomeration {
 public:
  Agglomeration(const PieceGraph& graph, const SightTable& sight)
      : count_(graph.point_count.size()),
        alive_(count_, true),
        points_(graph.point_count),
        object_points_(graph.object_count),
        object_radius_(graph.object_radius),
        surface_(graph.surface),
        log_thickness_(count_),
        seen_(count_ * count_),
        weight_(count_ * count_),
        contacts_(count_) {
    for (std::size_t i = 0; i < count_; ++i) {
      points_[i] = std::max(points_[i], 1.0);
      log_thickness_[i] = std::log(graph.thickness[i]);
    }
    // Each pair of sights counts by the points that it stands for.
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < count_; ++j) {
        const std::size_t at = i * count_ + j;
        weight_[at] = static_cast<double>(sight.weight[at]) * points_[i] * points_[j];
        seen_[at] = weight_[at] * static_cast<double>(sight.seen[at]);
      }
    }
    for (const PieceContact& contact : graph.contacts) {
      contacts_[contact.a][contact.b] =
          contacts_[contact.b][contact.a] = {std::min(contact.ratio, kMostRatio),
                                             contact.area,
                                             contact.facets,
                                             contact.concavity,
                                             contact.creased,
                                             0.0};
    }
    for (std::uint32_t a = 0; a < count_; ++a) price_contacts(a);
  }

  std::vector<Merge> run() {
    std::vector<Merge> merges;
    double level = 1.0;
    while (true) {
      check_cancelled();
      const Candidate best = cheapest();
      if (best.cost == std::numeric_limits<double>::infinity()) return merges;
      // Strictly rising, so that a ratio can tell any two merges apart.
      level = std::max(level * (1.0 + 1e-9), ratio_of_cost(best.cost));
      merges.push_back({level, best.a, best.b, false});
      absorb(best.a, best.b);
    }
  }

 private:
  struct Contact {
    double ratio = 1.0;
    double area = 0.0;
    double facets = 0.0;
    double concavity = 0.0;
    double creased = 0.0;
    double cost = 0.0;
  };
  struct Candidate {
    double cost = std::numeric_limits<double>::infinity();
    std::uint32_t a = 0;
    std::uint32_t b = 0;
  };

  [[nodiscard]] double cost(std::uint32_t a, std::uint32_t b, const Contact& contact) const {
    const std::size_t at = a * count_ + b;
    const double sight = weight_[at] > 0.0 ? seen_[at] / weight_[at] : 0.0;
    const double neck = std::max(std::log(contact.ratio / kNoNeck), 0.0);
    const double thickness = std::abs(log_thickness_[a] - log_thickness_[b]);
    const double thinner = std::exp(std::min(log_thickness_[a], log_thickness_[b]));
    const double thicker = std::exp(std::max(log_thickness_[a], log_thickness_[b]));
    const double section = std::numbers::pi * thinner * thinner;
    const double area = std::max(contact.area, kLeastContact * section);  // may be no area at all
    const double isolation = std::min(surface_[a], surface_[b]) / area;
    const double narrow = std::max(std::log(section / area), 0.0);
    const double facets = std::max(contact.facets, 1.0);
    const double concavity = contact.concavity / facets;
    const double creased = contact.creased / facets;
    const double slice = std::min(isolation / kSliceIsolation, 1.0);
    const double share = std::min(points_[a], points_[b]) / object_points_[a];
    return ((1.0 - sight) *
                std::pow(std::max(isolation, kLeastIsolation) / kUsualIsolation, kIsolationPower) +
            neck + kThicknessWeight * thickness + kNarrowWeight * narrow +
            kCreaseWeight * concavity * concavity) *
           creased * std::pow(slice, kSlicePower) * std::pow(20.0 * share, kSizePower) *
           std::pow(std::min(3.0 * thicker / object_radius_[a], 1.0), kBulkPower);
  }

  // What joining a with each group beside it costs; only the other one of a pair's two entries,
  // that of the larger number, is read.
  void price_contacts(std::uint32_t a) {
    for (const auto& [b, contact] : contacts_[a]) {
      contacts_[std::max(a, b)].at(std::min(a, b)).cost = cost(a, b, contact);
    }
  }

  [[nodiscard]] Candidate cheapest() const {
    Candidate best;
    for (std::uint32_t a = 0; a < count_; ++a) {
      for (const auto& [b, contact] : contacts_[a]) {
        if (b >= a) break;
        if (contact.cost < best.cost) best = {contact.cost, a, b};
      }
    }
    return best;
  }

  // Group b becomes part of group a.
  void absorb(std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t k = 0; k < count_; ++k) {
      if (!alive_[k] || k == a || k == b) continue;
      weight_[k * count_ + a] = weight_[a * count_ + k] += weight_[b * count_ + k];
      seen_[k * count_ + a] = seen_[a * count_ + k] += seen_[b * count_ + k];
    }
    const double sum = points_[a] + points_[b];
    log_thickness_[a] = (points_[a] * log_thickness_[a] + points_[b] * log_thickness_[b]) / sum;
    points_[a] = sum;
    surface_[a] += surface_[b];
    alive_[b] = false;
    for (const auto& [k, contact] : contacts_[b]) {
      contacts_[k].erase(b);
      if (k == a) continue;
      const auto [held, fresh] = contacts_[a].try_emplace(k, contact);
      if (!fresh) {
        held->second.ratio = std::min(held->second.ratio, contact.ratio);
        held->second.area += contact.area;
        held->second.facets += contact.facets;
        held->second.concavity += contact.concavity;
        held->second.creased += contact.creased;
      }
      contacts_[k][a] = held->second;
    }
    contacts_[b].clear();
    price_contacts(a);
  }

  std::size_t count_;
  std::vector<bool> alive_;
  std::vector<double> points_;
  std::vector<double> object_points_;
  std::vector<double> object_radius_;
  std::vector<double> surface_;
  std::vector<double> log_thickness_;
  std::vector<double> seen_;                                // sums over pairs of pieces, (p, p)
  std::vector<double> weight_;                              // (p, p)
  std::vector<std::map<std::uint32_t, Contact>> contacts_;  // of each group, to those it touches
};

}  // namespace

std::vector<Merge> agglomerate(const PieceGraph& graph, const SightTable& sight) {
  return Agglomeration(graph, sight).run();
}

double natural_merge_ratio() { return ratio_of_cost(kNaturalCost); }

}  // namespace morsel
