#include "io/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <morsel/error.hpp>
#include <set>
#include <type_traits>
#include <utility>

namespace morsel::io {
namespace {

template <class T>
PointProperty empty_property(const std::string& name, std::size_t rows) {
  std::vector<T> values;
  values.reserve(rows);
  return {name, std::move(values)};
}

PointProperty make_property(const Column& column, std::size_t rows) {
  switch (column.type) {
    case ScalarType::kInt8:
      return empty_property<std::int8_t>(column.name, rows);
    case ScalarType::kUint8:
      return empty_property<std::uint8_t>(column.name, rows);
    case ScalarType::kInt16:
      return empty_property<std::int16_t>(column.name, rows);
    case ScalarType::kUint16:
      return empty_property<std::uint16_t>(column.name, rows);
    case ScalarType::kInt32:
      return empty_property<std::int32_t>(column.name, rows);
    case ScalarType::kUint32:
      return empty_property<std::uint32_t>(column.name, rows);
    case ScalarType::kFloat32:
      return empty_property<float>(column.name, rows);
    default:
      return empty_property<double>(column.name, rows);
  }
}

// A double as a T; readers have checked the range of integers. A conversion to float that
// overflows is undefined, so it is spelled out.
template <class T>
T narrowed(double value) {
  if constexpr (std::is_same_v<T, float>) {
    constexpr double kMax = std::numeric_limits<float>::max();
    if (std::abs(value) > kMax && std::isfinite(value)) {
      constexpr float kInfinity = std::numeric_limits<float>::infinity();
      return value > 0 ? kInfinity : -kInfinity;
    }
  }
  return static_cast<T>(value);
}

}  // namespace

void append_fan(std::span<const std::uint32_t> polygon, std::vector<Triangle>& triangles) {
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }
}

void require_finite(const std::string& name, const std::vector<Vec3>& points) {
  const auto bad = std::ranges::find_if_not(points, is_finite);
  if (bad == points.end()) return;
  fail_at_point(name, static_cast<std::size_t>(bad - points.begin()),
                fmt::format("is ({}, {}, {}); expected finite coordinates, so remove invalid "
                            "points first",
                            bad->x, bad->y, bad->z));
}

PointTable::PointTable(const std::string& place, const std::vector<Column>& columns,
                       std::size_t rows) {
  std::array<bool, 3> found = {};
  std::set<std::string_view> names;
  for (const Column& column : columns) {
    if (!names.insert(column.name).second && column.name != "_") {
      throw Error(ErrorCode::kInput,
                  fmt::format("{}: two columns are named {}; rename or remove one", place,
                              in_quotes(column.name)));
    }
    if (column.name.size() == 1 && column.name >= "x" && column.name <= "z") {
      const auto axis = static_cast<std::size_t>(column.name[0] - 'x');
      found[axis] = true;
      target_.push_back(axis);
    } else if (column.name == "_" || (size_of(column.type) == 8 && !is_float(column.type))) {
      // Padding, and 64-bit integers, which no PLY property can hold.
      target_.push_back(kDropped);
    } else {
      target_.push_back(3 + cloud_.properties.size());
      cloud_.properties.push_back(make_property(column, rows));
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (found[axis]) continue;
    throw Error(ErrorCode::kInput,
                fmt::format("{}: the points have no {}; expected scalar columns x, y and z", place,
                            "xyz"[axis]));
  }
  cloud_.points.reserve(rows);
}

void PointTable::set(std::size_t column, double value) {
  const std::size_t target = target_[column];
  switch (target) {
    case 0:
      point_.x = value;
      return;
    case 1:
      point_.y = value;
      return;
    case 2:
      point_.z = value;
      return;
    case kDropped:
      return;
    default:
      std::visit(
          [value](auto& values) {
            using T = typename std::remove_reference_t<decltype(values)>::value_type;
            values.push_back(narrowed<T>(value));
          },
          cloud_.properties[target - 3].values);
  }
}

}  // namespace morsel::io
