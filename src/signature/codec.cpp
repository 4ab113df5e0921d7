// The bytes of a signature. The layout is documented in docs/signature.md.

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <morsel/signature.hpp>
#include <string_view>

#include "io/bytes.hpp"
#include "signature/layout.hpp"
#include "signature/tables.hpp"

namespace morsel {
namespace {

constexpr std::size_t kHeadBytes = kTablesAt;
constexpr std::string_view kMagic = "MRSL";
constexpr std::uint16_t kVersion = 1;
constexpr std::size_t kPartBytes = 22;
constexpr std::size_t kNeckBytes = 4;
constexpr std::size_t kChecksumBytes = 4;
// Pairs of parts that a signature can hold within its bytes.
constexpr std::size_t kMostNecks = 22;
// Steps of a length per RMS radius, and of the square root of a covariance.
constexpr double kLengthSteps = 2048.0;
constexpr double kRootSteps = 8192.0;
constexpr double kWeightSteps = 65535.0;

std::int16_t to_int16(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -32767.0, 32767.0)));
}
std::uint16_t to_uint16(double value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 65535.0)));
}
// Square roots keep thin parts: their covariances are far below one step of the thick ones'.
double signed_root(double value) { return std::copysign(std::sqrt(std::abs(value)), value); }
double signed_square(double root) { return root * std::abs(root); }

struct Neck16 {
  std::uint8_t a = 0;
  std::uint8_t b = 0;
  std::uint16_t radius = 0;
};

// The widest necks between kept parts, ascending by parts.
std::vector<Neck16> widest_necks(const Signature& signature) {
  std::vector<Neck16> necks;
  for (std::size_t a = 0; a < signature.parts.size(); ++a) {
    for (const PartNeighbor& neighbor : signature.parts[a].neighbors) {
      if (static_cast<std::size_t>(neighbor.part) <= a) continue;
      necks.push_back({static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(neighbor.part),
                       to_uint16(neighbor.neck_radius * kLengthSteps)});
    }
  }
  std::ranges::stable_sort(necks, std::ranges::greater{}, &Neck16::radius);
  if (necks.size() > kMostNecks) necks.resize(kMostNecks);
  std::ranges::sort(necks, {}, [](const Neck16& n) { return std::pair(n.a, n.b); });
  return necks;
}

void append_part(std::string& to, const SignaturePart& part) {
  io::append_bytes(to, to_uint16(part.weight * kWeightSteps));
  for (const double x : {part.center.x, part.center.y, part.center.z}) {
    io::append_bytes(to, to_int16(x * kLengthSteps));
  }
  for (const double c : part.covariance) {
    io::append_bytes(to, to_int16(signed_root(c) * kRootSteps));
  }
  io::append_bytes(to, to_uint16(part.ball_radius * kLengthSteps));
}

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  template <class T>
  T read() {
    const T value = io::load_as<T>(bytes_.data() + at_);
    at_ += sizeof(T);
    return value;
  }
  double read_finite(const char* what) {
    const auto value = read<double>();
    if (!std::isfinite(value)) fail(std::string(what) + " is not a finite number");
    return value;
  }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(ErrorCode::kInput,
                (name_.empty() ? std::string("signature") : name_ + ": signature") + " " + reason);
  }

 private:
  std::string_view bytes_;
  std::string name_;
  std::size_t at_ = 0;
};

// Magic, length, checksum and version, in the order that tells most.
void check_frame(std::string_view bytes, const Reader& reader) {
  if (bytes.size() < kHeadBytes + kChecksumBytes) {
    reader.fail("has " + std::to_string(bytes.size()) + " bytes; at least " +
                std::to_string(kHeadBytes + kChecksumBytes) + " are needed");
  }
  if (!bytes.starts_with(kMagic)) reader.fail("does not begin with \"MRSL\"");
  const auto version = io::load_as<std::uint16_t>(bytes.data() + 4);
  if (version != kVersion) {
    reader.fail("is of version " + std::to_string(version) + "; this program reads version " +
                std::to_string(kVersion));
  }
  const auto length = io::load_as<std::uint16_t>(bytes.data() + kLengthAt);
  if (length != bytes.size()) {
    reader.fail("has " + std::to_string(bytes.size()) + " bytes where it says " +
                std::to_string(length));
  }
  const std::string_view content = bytes.substr(0, bytes.size() - kChecksumBytes);
  if (io::load_as<std::uint32_t>(content.data() + content.size()) != checksum(content)) {
    reader.fail("is damaged: its checksum does not fit");
  }
}

SignaturePart read_part(Reader& reader) {
  SignaturePart part;
  part.weight = reader.read<std::uint16_t>() / kWeightSteps;
  part.center.x = reader.read<std::int16_t>() / kLengthSteps;
  part.center.y = reader.read<std::int16_t>() / kLengthSteps;
  part.center.z = reader.read<std::int16_t>() / kLengthSteps;
  for (double& c : part.covariance) c = signed_square(reader.read<std::int16_t>() / kRootSteps);
  part.ball_radius = reader.read<std::uint16_t>() / kLengthSteps;
  return part;
}

void read_neck(Reader& reader, Signature& signature) {
  const auto a = reader.read<std::uint8_t>();
  const auto b = reader.read<std::uint8_t>();
  const double radius = reader.read<std::uint16_t>() / kLengthSteps;
  if (a >= b || b >= signature.parts.size()) {
    reader.fail("joins parts " + std::to_string(a) + " and " + std::to_string(b) + " of " +
                std::to_string(signature.parts.size()));
  }
  signature.parts[a].neighbors.push_back({b, radius});
  signature.parts[b].neighbors.push_back({a, radius});
}

}  // namespace

std::vector<std::byte> encode(const Signature& signature) {
  const std::vector<Neck16> necks = widest_necks(signature);
  const std::size_t length = kHeadBytes + signature.parts.size() * kPartBytes +
                             necks.size() * kNeckBytes + kTableSize + kChecksumBytes;
  if (signature.parts.size() > kMostSignatureParts || length > kMostSignatureBytes ||
      (!signature.tables.empty() && signature.tables.size() != kTableSize)) {
    throw Error(ErrorCode::kUsage, "Signature has " + std::to_string(signature.parts.size()) +
                                       " parts and " + std::to_string(signature.tables.size()) +
                                       " table values; expected at most " +
                                       std::to_string(kMostSignatureParts) + ", and 0 or " +
                                       std::to_string(kTableSize));
  }
  std::string bytes(kMagic);
  io::append_bytes(bytes, kVersion);
  io::append_bytes(bytes, static_cast<std::uint16_t>(length));
  io::append_bytes(bytes, static_cast<std::uint8_t>(signature.parts.size()));
  io::append_bytes(bytes, static_cast<std::uint8_t>(necks.size()));
  io::append_bytes(bytes, static_cast<std::uint16_t>(kTableSize));
  io::append_bytes(bytes, signature.centroid.x);
  io::append_bytes(bytes, signature.centroid.y);
  io::append_bytes(bytes, signature.centroid.z);
  io::append_bytes(bytes, signature.size);
  for (std::size_t i = 0; i < kTableSize; ++i) {
    io::append_bytes(bytes, i < signature.tables.size() ? signature.tables[i] : std::uint8_t{0});
  }
  for (const SignaturePart& part : signature.parts) append_part(bytes, part);
  for (const Neck16& neck : necks) {
    io::append_bytes(bytes, neck.a);
    io::append_bytes(bytes, neck.b);
    io::append_bytes(bytes, neck.radius);
  }
  io::append_bytes(bytes, checksum(bytes));
  std::vector<std::byte> result(bytes.size());
  std::ranges::transform(bytes, result.begin(), [](char c) { return static_cast<std::byte>(c); });
  return result;
}

Signature decode(std::span<const std::byte> encoded, const std::string& name) {
  const std::string_view bytes(reinterpret_cast<const char*>(encoded.data()), encoded.size());
  Reader reader(bytes, name);
  check_frame(bytes, reader);
  reader.read<std::uint64_t>();  // magic, version and length, which check_frame looked at
  const auto part_count = reader.read<std::uint8_t>();
  const auto neck_count = reader.read<std::uint8_t>();
  const auto table_size = reader.read<std::uint16_t>();
  const std::size_t expected =
      kHeadBytes + part_count * kPartBytes + neck_count * kNeckBytes + table_size + kChecksumBytes;
  if (expected != bytes.size() || part_count > kMostSignatureParts || table_size != kTableSize) {
    reader.fail("counts " + std::to_string(part_count) + " parts, " + std::to_string(neck_count) +
                " necks and " + std::to_string(table_size) + " table values in " +
                std::to_string(bytes.size()) + " bytes, which do not fit together");
  }
  Signature signature;
  signature.centroid.x = reader.read_finite("centroid");
  signature.centroid.y = reader.read_finite("centroid");
  signature.centroid.z = reader.read_finite("centroid");
  signature.size = reader.read_finite("size");
  if (signature.size < 0.0) reader.fail("has a negative size");
  for (int i = 0; i < table_size; ++i) signature.tables.push_back(reader.read<std::uint8_t>());
  for (int i = 0; i < part_count; ++i) signature.parts.push_back(read_part(reader));
  for (int i = 0; i < neck_count; ++i) read_neck(reader, signature);
  for (SignaturePart& part : signature.parts) {
    std::ranges::sort(part.neighbors, {}, &PartNeighbor::part);
  }
  return signature;
}

}  // namespace morsel
