// A signature as JSON, and back.

#include <cstdint>
#include <limits>
#include <morsel/error.hpp>
#include <morsel/signature.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "base/whole_number.hpp"

namespace morsel {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kJsonVersion = 1;

Json vector_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

template <typename Integer>
Integer integer_from_json(const Json& json, const std::string& prefix) {
  if (const auto number = whole_number<Integer>(json)) return *number;
  throw Error(ErrorCode::kInput,
              prefix + "not a signature: " + (json.is_number() ? json.dump() : json.type_name()) +
                  " where a whole number from 0 to " +
                  std::to_string(std::numeric_limits<Integer>::max()) + " is expected");
}

Vec3 vector_from_json(const Json& json) {
  const auto values = json.get<std::array<double, 3>>();
  return {values[0], values[1], values[2]};
}

Json part_json(const SignaturePart& part) {
  Json json = {{"weight", part.weight},
               {"representative_point", vector_json(part.center)},
               {"covariance", part.covariance},
               {"ball_radius", part.ball_radius},
               {"neighbors", Json::array()}};
  for (const PartNeighbor& neighbor : part.neighbors) {
    json["neighbors"].push_back({{"part", neighbor.part}, {"neck_radius", neighbor.neck_radius}});
  }
  return json;
}

SignaturePart part_from_json(const Json& json, const std::string& prefix) {
  SignaturePart part;
  part.weight = json.at("weight").get<double>();
  part.center = vector_from_json(json.at("representative_point"));
  part.covariance = json.at("covariance").get<std::array<double, 6>>();
  part.ball_radius = json.at("ball_radius").get<double>();
  for (const Json& neighbor : json.at("neighbors")) {
    part.neighbors.push_back({integer_from_json<int>(neighbor.at("part"), prefix),
                              neighbor.at("neck_radius").get<double>()});
  }
  return part;
}

void check_neighbors(const Signature& signature, const std::string& name) {
  for (const SignaturePart& part : signature.parts) {
    for (const PartNeighbor& neighbor : part.neighbors) {
      if (static_cast<std::size_t>(neighbor.part) < signature.parts.size()) continue;
      throw Error(ErrorCode::kInput, name + "neighbors names part " +
                                         std::to_string(neighbor.part) + " of " +
                                         std::to_string(signature.parts.size()));
    }
  }
}

}  // namespace

std::string to_json(const Signature& signature) {
  Json json = {{"signature_version", kJsonVersion},
               {"centroid", vector_json(signature.centroid)},
               {"size", signature.size},
               {"parts", Json::array()},
               {"tables", signature.tables}};
  for (const SignaturePart& part : signature.parts) json["parts"].push_back(part_json(part));
  return json.dump(2) + "\n";
}

Signature signature_from_json(const std::string& text, const std::string& name) {
  const std::string prefix = name.empty() ? std::string() : name + ": ";
  try {
    const Json json = Json::parse(text);
    const int version = integer_from_json<int>(json.at("signature_version"), prefix);
    if (version != kJsonVersion) {
      throw Error(ErrorCode::kInput, prefix + "signature_version is " + std::to_string(version) +
                                         "; this program reads " + std::to_string(kJsonVersion));
    }
    Signature signature;
    signature.centroid = vector_from_json(json.at("centroid"));
    signature.size = json.at("size").get<double>();
    for (const Json& part : json.at("parts")) {
      signature.parts.push_back(part_from_json(part, prefix));
    }
    for (const Json& value : json.at("tables")) {
      signature.tables.push_back(integer_from_json<std::uint8_t>(value, prefix));
    }
    check_neighbors(signature, prefix);
    return decode(encode(signature), name);
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::kInput, prefix + "not a signature: " + error.what());
  }
}

}  // namespace morsel
