// Source: PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", version 6.3.10, §4.3.
#include "io/zip.hpp"

#include <zlib.h>

#include "io/bytes.hpp"

namespace morsel::io {
namespace {

constexpr std::uint16_t kVersion = 20;
// 1 January 1980, the earliest date: the same points give the same bytes on any day.
constexpr std::uint16_t kDate = (1 << 5) | 1;

std::uint32_t crc_of(const std::string& bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

// The part that a member's local header and its directory entry have in common.
std::string common_header(const ZipMember& member) {
  std::string header;
  append_bytes<std::uint16_t>(header, kVersion);
  append_bytes<std::uint16_t>(header, 0);  // flags
  append_bytes<std::uint16_t>(header, 0);  // stored
  append_bytes<std::uint16_t>(header, 0);  // time
  append_bytes<std::uint16_t>(header, kDate);
  append_bytes(header, member.crc);
  append_bytes(header, member.size);  // compressed
  append_bytes(header, member.size);
  append_bytes(header, static_cast<std::uint16_t>(member.name.size()));
  append_bytes<std::uint16_t>(header, 0);  // extra field
  return header;
}

}  // namespace

void ZipWriter::write(const std::string& bytes) {
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  offset_ += static_cast<std::uint32_t>(bytes.size());
}

void ZipWriter::add(const std::string& name, const std::string& bytes) {
  const ZipMember member{name, crc_of(bytes), static_cast<std::uint32_t>(bytes.size()), offset_};
  write("PK\x03\x04" + common_header(member) + name);
  write(bytes);
  members_.push_back(member);
}

void ZipWriter::finish() {
  const std::uint32_t directory_at = offset_;
  for (const ZipMember& member : members_) {
    std::string entry = "PK\x01\x02";
    append_bytes(entry, kVersion);
    entry += common_header(member);
    append_bytes<std::uint16_t>(entry, 0);  // comment
    append_bytes<std::uint16_t>(entry, 0);  // disk
    append_bytes<std::uint16_t>(entry, 0);  // internal attributes
    append_bytes<std::uint32_t>(entry, 0);  // external attributes
    append_bytes(entry, member.offset);
    write(entry + member.name);
  }
  const auto count = static_cast<std::uint16_t>(members_.size());
  const std::uint32_t directory_size = offset_ - directory_at;
  std::string end = "PK\x05\x06";
  append_bytes<std::uint32_t>(end, 0);  // disks
  append_bytes(end, count);
  append_bytes(end, count);
  append_bytes(end, directory_size);
  append_bytes(end, directory_at);
  append_bytes<std::uint16_t>(end, 0);  // comment
  write(end);
}

}  // namespace morsel::io
