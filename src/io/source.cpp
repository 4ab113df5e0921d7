#include "io/source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <morsel/error.hpp>
#include <utility>

#include "base/lower_case.hpp"

namespace morsel::io {
namespace {

// A pipe or device has no size to trust; one that never ends must not take all memory.
constexpr std::size_t kMaxStreamBytes = std::size_t{4} << 30;
constexpr std::size_t kFirstChunk = std::size_t{1} << 16;

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

// Fills a buffer from `read_some(pointer, room)` until that returns 0. One byte more than the
// expected size is asked for, so that a file of that size is read without growing the buffer.
template <class ReadSome>
std::string read_to_end(std::size_t expected_size, std::size_t limit, const std::string& name,
                        ReadSome read_some) {
  std::string bytes(std::max(expected_size + 1, kFirstChunk), '\0');
  std::size_t used = 0;
  while (true) {
    const std::size_t got = read_some(bytes.data() + used, bytes.size() - used);
    if (got == 0) break;
    used += got;
    if (used > limit) fail(name, "more than 4 GiB without an end; save it as a file first");
    if (used == bytes.size()) bytes.resize(2 * bytes.size());
  }
  bytes.resize(used);
  return bytes;
}

std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (is_control(c) || (c >= '\t' && c <= '\r')) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result;
}

std::string display_name(const std::filesystem::path& path) { return escaped(path.string()); }

Source load(const std::filesystem::path& path) {
  Source source{display_name(path), lower_extension(path), path.parent_path(), {}};
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status = {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) {
    fail(source.name, std::string("cannot read: ") + std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode)) fail(source.name, "is a directory; name a file");
  if (S_ISBLK(status.st_mode)) fail(source.name, "is a block device; name a file");
  const bool regular = S_ISREG(status.st_mode);
  source.bytes = read_to_end(
      regular ? static_cast<std::size_t>(status.st_size) : 0, regular ? SIZE_MAX : kMaxStreamBytes,
      source.name, [&](char* to, std::size_t room) {
        ssize_t got = -1;
        do {
          got = ::read(file.get(), to, room);
        } while (got < 0 && errno == EINTR);
        if (got < 0) {
          fail(source.name, std::string("cannot read: ") + std::strerror(errno));
        }
        return static_cast<std::size_t>(got);
      });
  return source;
}

Source load(std::istream& stream, const std::string& name) {
  Source source{escaped(name), {}, std::filesystem::path(), {}};
  source.bytes = read_to_end(0, kMaxStreamBytes, source.name, [&](char* to, std::size_t room) {
    stream.read(to, static_cast<std::streamsize>(room));
    return static_cast<std::size_t>(stream.gcount());
  });
  if (stream.bad()) fail(source.name, "cannot read: the stream broke off");
  return source;
}

Source from_memory(std::string bytes, const std::string& name) {
  return {escaped(name), lower_extension(name), std::nullopt, std::move(bytes)};
}

void fail(const std::string& name, const std::string& message) {
  throw Error(ErrorCode::kInput, name + ": " + message);
}

void fail_at_line(const std::string& name, std::size_t line, const std::string& message) {
  throw Error(ErrorCode::kInput, fmt::format("{}:{}: {}", name, line, message));
}

void fail_at_byte(const std::string& name, std::size_t byte, const std::string& message) {
  throw Error(ErrorCode::kInput, fmt::format("{}: byte {}: {}", name, byte, message));
}

void fail_at_point(const std::string& name, std::size_t point, const std::string& message) {
  throw Error(ErrorCode::kInput, fmt::format("{}: point {}: {}", name, point, message));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kShown = 40;
  const bool cut = text.size() > kShown;
  return "'" + escaped(text.substr(0, kShown)) + (cut ? "…'" : "'");
}

void check_count(const std::string& place, std::size_t count, std::size_t min_bytes,
                 std::size_t available, const std::string& what) {
  // The last item of a text may lack its line end, hence the one byte more.
  const std::size_t most = (available + 1) / min_bytes;
  if (count <= most) return;
  throw Error(ErrorCode::kInput,
              fmt::format("{}: the header promises {} {}, but the {} bytes that follow hold at "
                          "most {}; the file is truncated or its header is wrong",
                          place, count, what, available, most));
}

}  // namespace morsel::io
