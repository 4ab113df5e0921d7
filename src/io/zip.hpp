// A zip archive of files stored without compression, enough for .npz.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace morsel::io {

struct ZipMember {
  std::string name;
  std::uint32_t crc = 0;
  std::uint32_t size = 0;
  std::uint32_t offset = 0;
};

/// Writes members one after another; `finish` writes the directory. The archive stays below 4 GiB.
class ZipWriter {
 public:
  explicit ZipWriter(std::ostream& stream) : stream_(stream) {}

  void add(const std::string& name, const std::string& bytes);
  void finish();

 private:
  void write(const std::string& bytes);

  std::ostream& stream_;
  std::uint32_t offset_ = 0;
  std::vector<ZipMember> members_;
};

}  // namespace morsel::io
