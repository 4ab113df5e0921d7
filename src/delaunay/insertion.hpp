// Inserts points that lie along a space-filling curve into a CGAL triangulation, in rounds.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <vector>

#include "base/threads.hpp"

namespace morsel {

/// The rounds in which n points are inserted, indices ascending in each. Every round is a sample of
/// all points, three times as large as those before it together; so each new point meets few cells,
/// and the next one is close by.
/// Source: N. Amenta, S. Choi, G. Rote, "Incremental constructions con BRIO", SoCG 2003.
[[nodiscard]] inline std::vector<std::vector<std::uint32_t>> insertion_rounds(std::uint32_t n) {
  constexpr std::uint32_t kFirstRound = 1024;
  int rounds = 1;
  while ((n >> (2 * (rounds - 1))) > kFirstRound) ++rounds;
  std::vector<std::vector<std::uint32_t>> order(rounds);
  for (std::uint32_t i = 0; i < n; ++i) {
    std::uint32_t hash = i * 0x9e3779b1U;  // any fixed mixing of bits will do
    hash = (hash ^ (hash >> 15)) * 0x85ebca6bU;
    hash ^= hash >> 13;
    order[std::max(rounds - 1 - std::countr_zero(hash) / 2, 0)].push_back(i);
  }
  return order;
}

/// Inserts `points`, distinct and along a space-filling curve, each with its index as info. With
/// `locks`, by all threads of the caller's arena.
template <typename Delaunay>
class Insertion {
 public:
  using Point = typename Delaunay::Point;
  using Vertex = typename Delaunay::Vertex_handle;
  using Locks = typename Delaunay::Lock_data_structure;

  Insertion(Delaunay& delaunay, const std::vector<Vec3>& points, Locks* locks)
      : delaunay_(delaunay), points_(points), locks_(locks), vertices_(points.size()) {}

  void run() {
    const auto rounds = insertion_rounds(static_cast<std::uint32_t>(points_.size()));
    for (const auto& round : rounds) {
      // The first round makes the triangulation large enough for threads to keep out of each
      // other's way. What is flat has no locks at all.
      if (locks_ == nullptr || &round == &rounds.front() || delaunay_.dimension() < 3) {
        insert_in_turn(round);
      } else {
        insert_beside_each_other(round);
      }
    }
  }

 private:
  static constexpr std::size_t kChunk = 1024;

  [[nodiscard]] Point point(std::uint32_t i) const {
    return {points_[i].x, points_[i].y, points_[i].z};
  }

  // The last vertex before i along the curve that is in; after its start comes its end.
  [[nodiscard]] Vertex vertex_before(std::size_t i) const {
    while (vertices_[i] == Vertex()) i = i > 0 ? i - 1 : vertices_.size() - 1;
    return vertices_[i];
  }

  void insert_in_turn(const std::vector<std::uint32_t>& round) {
    delaunay_.set_lock_data_structure(nullptr);
    Vertex hint;
    for (std::size_t r = 0; r < round.size(); ++r) {
      if (r % kChunk == 0) check_cancelled();
      const std::uint32_t i = round[r];
      hint = delaunay_.insert(point(i), hint);
      hint->info() = i;
      vertices_[i] = hint;
    }
  }

  void insert_beside_each_other(const std::vector<std::uint32_t>& round) {
    delaunay_.set_lock_data_structure(locks_);
    std::vector<Vertex> hints;
    for (std::size_t begin = 0; begin < round.size(); begin += kChunk) {
      hints.push_back(vertex_before(round[begin]));
    }
    const auto insert_chunk = handed([&](std::size_t chunk) {
      check_cancelled();
      Vertex hint = hints[chunk];
      const std::size_t end = std::min((chunk + 1) * kChunk, round.size());
      for (std::size_t r = chunk * kChunk; r < end; ++r) hint = insert_locked(round[r], hint);
    });
    const GiverScope giver;
    tbb::parallel_for(std::size_t{0}, hints.size(), insert_chunk);
  }

  // Tries until no other thread holds what the insertion touches.
  Vertex insert_locked(std::uint32_t i, Vertex hint) {
    const Point p = point(i);
    Vertex vertex;
    while (vertex == Vertex()) {
      if (delaunay_.try_lock_vertex(hint) && delaunay_.try_lock_point(p)) {
        bool held = true;
        typename Delaunay::Locate_type type{};
        int li = 0;
        int lj = 0;
        const auto cell = delaunay_.locate(p, type, li, lj, hint, &held);
        if (held) vertex = delaunay_.insert(p, type, cell, li, lj, &held);
        if (held) {
          vertex->info() = i;
        } else {
          vertex = Vertex();
        }
      }
      delaunay_.unlock_all_elements();
    }
    vertices_[i] = vertex;
    return vertex;
  }

  Delaunay& delaunay_;
  const std::vector<Vec3>& points_;
  Locks* locks_;
  std::vector<Vertex> vertices_;  // of the points that are in
};

}  // namespace morsel
