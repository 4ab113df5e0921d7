// What is stored of a shape: signatures, sketches, search blocks, JSON lines, database files.

#include <sys/mman.h>
#include <unistd.h>
#include <xxhash.h>
#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <morsel/database.hpp>
#include <morsel/search.hpp>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include "base/test_folder.hpp"
#include "base/test_shapes.hpp"
#include "match/block.hpp"
#include "serve/answers.hpp"
#include "targets.hpp"

namespace morsel::fuzz {
namespace {

const ShapeData& known_shape() {
  static const ShapeData data = [] {
    const auto points = shapes::dumbbell(600);
    SegmentOptions options;
    options.threads = 1;
    return make_shape_data(segment(points, options), options, content_key(points, options));
  }();
  return data;
}

// Whatever can be done with a signature from outside.
void use(const Signature& signature) {
  const std::vector<std::byte> bytes = encode(signature);
  require(bytes.size() <= kMostSignatureBytes, "a signature has at most a kilobyte");
  const Signature again = decode(bytes);
  require(encode(again) == bytes, "a signature is the same when written and read");
  require(signature_from_json(to_json(again)) == again, "JSON keeps a signature");
  for (const Method method : {Method::kDefault, Method::kPaper}) {
    const MatchOptions options{.method = method};
    const double score = match_score(again, known_shape().signature, options);
    require(score >= 0.0 && score <= 1.0, "a score is 0 … 1");
    require(match_score(known_shape().signature, again, options) == score, "scores are symmetric");
  }
  std::ignore = to_json(match(again, known_shape().signature));
}

void use(const Sketch& sketch) {
  require(sketch.parts.size() == sketch.points.size(), "a point has a part");
  const Sketch again = decode_sketch(encode_sketch(sketch), "again");
  require(encode_sketch(again) == encode_sketch(sketch), "a sketch is the same written and read");
  std::ignore = draw_thumbnail(sketch, 32);
}

// With a checksum that fits: it is there against accidents, not against design.
void seal(std::string& bytes) {
  if (bytes.size() < 4) return;
  const std::size_t content = bytes.size() - 4;
  const auto sum = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(content)));
  std::memcpy(bytes.data() + content, &sum, sizeof sum);
}

// As far as there are groups where the table says.
void seal_groups(std::string& bytes, std::span<block::Group> groups) {
  for (block::Group& group : groups) {
    if (group.rows > block::kGroupRows || group.offset > bytes.size()) return;
    const block::Layout layout(group.rows);
    if (group.offset + layout.names > bytes.size()) return;
    char* const begin = bytes.data() + group.offset;
    for (std::size_t i = 0; i < group.rows; ++i) {
      const auto end_of = [&](std::size_t row) {
        std::uint32_t end = 0;
        std::memcpy(&end, begin + layout.name_ends + 4 * row, sizeof end);
        return end;
      };
      const std::size_t from = i > 0 ? end_of(i - 1) : 0;
      const std::size_t to = end_of(i);
      if (from > to || group.offset + layout.names + to > bytes.size()) continue;
      const auto sum = block::row_checksum(begin + layout.records + block::kRecordBytes * i,
                                           {begin + layout.names + from, to - from});
      std::memcpy(begin + 8 * i, &sum, sizeof sum);
    }
    group.checksum = block::columns_checksum(begin, layout.columns_end);
  }
}

void seal_block(std::string& bytes) {
  block::Tail tail;
  if (bytes.size() < sizeof tail) return;
  const std::size_t tail_at = bytes.size() - sizeof tail;
  std::memcpy(&tail, bytes.data() + tail_at, sizeof tail);
  if (tail.groups > tail_at / sizeof(block::Group)) return;
  std::vector<block::Group> groups(tail.groups);
  char* const table = bytes.data() + tail_at - groups.size() * sizeof(block::Group);
  if (!groups.empty()) std::memcpy(groups.data(), table, groups.size() * sizeof(block::Group));
  seal_groups(bytes, groups);
  if (!groups.empty()) std::memcpy(table, groups.data(), groups.size() * sizeof(block::Group));
  tail.checksum = block::table_checksum(groups, tail.shapes);
  std::memcpy(bytes.data() + tail_at, &tail, sizeof tail);
}

// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : file_(::memfd_create("fuzz", 0)) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    require(written == static_cast<ssize_t>(bytes.size()), "there is memory for a file");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(file_); }
  [[nodiscard]] std::filesystem::path path() const {
    return "/proc/self/fd/" + std::to_string(file_);
  }

 private:
  int file_;
};

void open_block(std::string_view bytes) {
  const MemoryFile file(bytes);
  std::optional<SearchBlock> found;
  if (!accepts([&] { found.emplace(SearchBlock::open(file.path())); })) return;
  for (std::size_t i = 0; i < found->size(); ++i) {
    accepts([&] {
      std::ignore = found->name(i);
      use(found->signature(i));
    });
  }
  accepts([&] {
    for (const Hit& hit : found->search(known_shape().signature, 5)) {
      require(hit.index < found->size(), "a hit is a shape");
      require(hit.score >= 0.0 && hit.score <= 1.0, "a score is 0 … 1");
    }
  });
}

std::string exported(const Database& database) {
  std::ostringstream lines;
  database.export_lines(lines);
  return lines.str();
}

void use(const StoredShape& shape) {
  use(shape.data.signature);
  use(shape.data.sketch);
  std::ignore = serve::stored_shape_json(shape);
  std::ignore = serve::sketch_json(shape.data);
  std::ignore = serve::parts_json(shape);
}

// All that can be asked of a database.
void use(const Database& database) {
  std::ignore = database.check();
  for (const ShapeInfo& info : *database.shapes()) {
    accepts([&] { use(database.get(info.name)); });
  }
  std::ignore = database.search(known_shape().signature, 5);
  exported(database);
}

}  // namespace

void run_signature(std::string_view /*name*/, std::string bytes) {
  const auto read = [&] { accepts([&] { use(decode(std::as_bytes(std::span(bytes)), "fuzz")); }); };
  read();
  seal(bytes);
  read();
}

void run_signature_json(std::string_view /*name*/, std::string bytes) {
  accepts([&] { use(signature_from_json(bytes, "fuzz")); });
}

void run_sketch(std::string_view /*name*/, std::string bytes) {
  accepts([&] { use(decode_sketch(bytes, "fuzz")); });
  // What is deflated in one.
  uLongf length = compressBound(static_cast<uLong>(bytes.size()));
  std::string deflated(length, '\0');
  compress(reinterpret_cast<Bytef*>(deflated.data()), &length,
           reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
  std::string sketch = encode_sketch({}).substr(0, 1);  // its version
  for (std::size_t left = bytes.size();; left >>= 7) {
    sketch += static_cast<char>(left < 0x80 ? left : (left | 0x80));
    if (left < 0x80) break;
  }
  accepts([&] { use(decode_sketch(sketch + deflated.substr(0, length), "fuzz")); });
}

void run_block(std::string_view /*name*/, std::string bytes) {
  open_block(bytes);
  seal_block(bytes);
  open_block(bytes);
}

void run_lines(std::string_view /*name*/, std::string bytes) {
  static const TestFolder folder;
  static Database database = Database::open(folder.path() / "lines.db", Access::kCreate);
  std::istringstream lines(bytes);
  if (!accepts([&] { database.import_lines(lines, "fuzz"); })) return;
  use(database);
  require(database.check().empty(), "what is imported is whole");
  const std::string first = exported(database);
  std::istringstream again(first);
  database.import_lines(again, "again");
  require(exported(database) == first, "an export can be imported");
  std::vector<std::string> names;
  for (const ShapeInfo& info : *database.shapes()) names.push_back(info.name);
  database.remove(names);
}

void run_database(std::string_view /*name*/, std::string bytes) {
  static const TestFolder folder;
  const std::filesystem::path file = folder.path() / "fuzz.db";
  for (const auto& left : std::filesystem::directory_iterator(folder.path())) {
    std::filesystem::remove(left.path());
  }
  std::ofstream(file, std::ios::binary) << bytes;
  for (const Access access : {Access::kRead, Access::kWrite}) {
    accepts([&] { use(Database::open(file, access)); });
  }
}

}  // namespace morsel::fuzz
