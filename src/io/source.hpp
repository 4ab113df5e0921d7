// The whole content of one input, and the errors that name a place in it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

namespace morsel::io {

/// An input read to its end. Readers get it by reference and only look at it.
struct Source {
  std::string name;                             ///< as shown in messages, one line
  std::string extension;                        ///< in lower case with its dot; empty for a stream
  std::optional<std::filesystem::path> folder;  ///< of files that it refers to; none: it may not
  std::string bytes;
};

/// The path as shown in messages: on one line whatever characters it holds.
[[nodiscard]] std::string display_name(const std::filesystem::path& path);

/// Reads a file, a pipe or a device to its end. The allocation follows the file's size.
/// Throws Error(kInput) for a directory, a missing or unreadable file.
[[nodiscard]] Source load(const std::filesystem::path& path);
[[nodiscard]] Source load(std::istream& stream, const std::string& name);
/// Of bytes that are in memory already, under the name of the file that they came from.
[[nodiscard]] Source from_memory(std::string bytes, const std::string& name);

[[noreturn]] void fail(const std::string& name, const std::string& message);
[[noreturn]] void fail_at_line(const std::string& name, std::size_t line,
                               const std::string& message);
[[noreturn]] void fail_at_byte(const std::string& name, std::size_t byte,
                               const std::string& message);
/// Points count from 0, like rows of an array.
[[noreturn]] void fail_at_point(const std::string& name, std::size_t point,
                                const std::string& message);

/// `text` for a message of one line: control characters as \xNN.
[[nodiscard]] std::string escaped(std::string_view text);

/// `text` in quotes for a message: cut after some 40 characters, control characters as \xNN.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Throws when `count` items of at least `min_bytes` each cannot be in the `available` bytes: asked
/// before anything is allocated for them. `what` as in "vertices".
void check_count(const std::string& place, std::size_t count, std::size_t min_bytes,
                 std::size_t available, const std::string& what);

/// True for bytes that no text file holds.
[[nodiscard]] constexpr bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 ? !(byte >= '\t' && byte <= '\r') : byte == 0x7f;
}

}  // namespace morsel::io
