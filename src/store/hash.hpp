// Fingerprints of content and checksums of rows.
#pragma once

#include <xxhash.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace morsel::store {

/// Fingerprint of a sequence of fields; where one ends and the next begins counts.
/// Source: Y. Collet, xxHash, XXH3; the same on every machine.
class Fingerprint {
 public:
  Fingerprint();
  ~Fingerprint();
  Fingerprint(const Fingerprint&) = delete;
  Fingerprint& operator=(const Fingerprint&) = delete;

  Fingerprint& add(std::string_view field);
  Fingerprint& add(std::int64_t number);

  [[nodiscard]] std::string hex_128() const;
  [[nodiscard]] std::int64_t checksum_64() const;

 private:
  XXH3_state_t* state_;
};

}  // namespace morsel::store
