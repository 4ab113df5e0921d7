#include "store/hash.hpp"

#include <fmt/format.h>

#include <bit>
#include <new>

#include "io/bytes.hpp"

namespace morsel::store {

Fingerprint::Fingerprint() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(state_);
}

Fingerprint::~Fingerprint() { XXH3_freeState(state_); }

Fingerprint& Fingerprint::add(std::string_view field) {
  add(static_cast<std::int64_t>(field.size()));
  XXH3_128bits_update(state_, field.data(), field.size());
  return *this;
}

Fingerprint& Fingerprint::add(std::int64_t number) {
  std::string bytes;
  io::append_bytes(bytes, number);
  XXH3_128bits_update(state_, bytes.data(), bytes.size());
  return *this;
}

std::string Fingerprint::hex_128() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::int64_t Fingerprint::checksum_64() const {
  return std::bit_cast<std::int64_t>(std::uint64_t{XXH3_128bits_digest(state_).low64});
}

}  // namespace morsel::store
