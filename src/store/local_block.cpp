#include "store/local_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <morsel/error.hpp>
#include <optional>
#include <system_error>
#include <unordered_set>

#include "io/bytes.hpp"
#include "store/rows.hpp"

namespace morsel::store {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".block";
constexpr std::size_t kDigits = 16;
constexpr std::size_t kSuffixBytes = 1 + 2 * sizeof(std::int64_t);

// In a block a shape's name is followed by NUL, which no name holds and which sorts before all
// else, and by the two numbers.
std::string text_of(const BlockEntry& entry) {
  std::string text(entry.name);
  text += '\0';
  io::append_bytes(text, entry.id);
  io::append_bytes(text, entry.checksum);
  return text;
}

// The numbers in its name say which state of the database a block was made from.
fs::path block_path(const Connection& connection, const StateMark& mark) {
  fs::path path = connection.block_prefix();
  if (path.empty()) return path;
  path += fmt::format("-{:016x}{:016x}{}", static_cast<std::uint64_t>(mark.sequence),
                      static_cast<std::uint64_t>(mark.digest), kExtension);
  return path;
}

struct Block {
  fs::path path;
  std::int64_t sequence = 0;
};

// All blocks of the database, those of versions before this one with no sequence.
std::vector<Block> blocks_of(const Connection& connection) {
  const fs::path prefix_path = connection.block_prefix();
  const std::string prefix = prefix_path.filename().string() + "-";
  std::vector<Block> blocks;
  std::error_code ignored;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::absolute(prefix_path).parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(kExtension)) continue;
    const std::string digits =
        name.substr(prefix.size(), name.size() - prefix.size() - kExtension.size());
    if (digits.find_first_not_of("0123456789abcdef") != std::string::npos) continue;
    if (digits.size() != kDigits && digits.size() != 2 * kDigits) continue;
    std::uint64_t sequence = 0;
    if (digits.size() == 2 * kDigits) {
      std::from_chars(digits.data(), digits.data() + kDigits, sequence, 16);
    }
    blocks.push_back({entry.path(), static_cast<std::int64_t>(sequence)});
  }
  return blocks;
}

// Nothing when it is not there or damaged.
std::optional<SearchBlock> open_block(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  try {
    return SearchBlock::open(path);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInput) throw;
    return std::nullopt;
  }
}

// A block that is being written and what it will hold.
struct Copy {
  explicit Copy(const fs::path& path) : writer(path) {}

  void add(const BlockEntry& entry, const Signature& signature) {
    writer.add(text_of(entry), signature);
    digest ^= entry.checksum;
    ++shapes;
  }
  [[nodiscard]] bool is_of(const StateMark& mark) const {
    return digest == mark.digest && shapes == mark.shapes;
  }

  SearchBlockWriter writer;
  std::int64_t digest = 0;
  std::int64_t shapes = 0;
};

constexpr std::int64_t kBeforeAll = -1;

void add_changed(Connection& connection, std::int64_t since, Copy& copy) {
  each_signature(connection, "WHERE changed > ?1 ORDER BY name", {since},
                 [&](const ShapeRow& row, const Signature& signature) {
                   copy.add({row.info.name, row.id, row.checksum}, signature);
                 });
}

// The shapes of `old` but those that changed since or are no more.
void add_unchanged(Connection& connection, const SearchBlock& old, std::int64_t since, Copy& copy) {
  std::unordered_set<std::int64_t> gone;
  const auto rows = connection.query(
      "SELECT id FROM shapes WHERE changed > ?1 UNION ALL "
      "SELECT id FROM removed WHERE changed > ?1",
      {since});
  while (rows->next()) gone.insert(rows->integer(0));
  for (std::size_t i = 0; i < old.size(); ++i) {
    const BlockEntry entry = block_entry(old, i);
    if (!gone.contains(entry.id)) copy.add(entry, old.signature(i));
  }
}

// Writes the block from the latest of an earlier state. False when there is none of use.
bool write_from_earlier(Connection& connection, const StateMark& mark, const fs::path& path) {
  std::vector<Block> blocks = blocks_of(connection);
  std::erase_if(blocks, [&](const Block& block) {
    return block.sequence <= 0 || block.sequence > mark.sequence || block.path == path;
  });
  const auto latest =
      std::max_element(blocks.begin(), blocks.end(),
                       [](const Block& a, const Block& b) { return a.sequence < b.sequence; });
  if (latest == blocks.end()) return false;
  const std::optional<SearchBlock> old = open_block(latest->path);
  if (!old) return false;
  try {
    Copy copy(path);
    add_unchanged(connection, *old, latest->sequence, copy);
    add_changed(connection, latest->sequence, copy);
    if (!copy.is_of(mark)) return false;  // of another database, or one that a backup replaced
    copy.writer.commit();
    return true;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInput) throw;
    return false;  // damaged; if it is the database that is, reading everything will tell
  }
}

void write_from_all(Connection& connection, const StateMark& mark, const fs::path& path) {
  Copy copy(path);
  add_changed(connection, kBeforeAll, copy);
  if (!copy.is_of(mark)) {
    throw Error(ErrorCode::kInput, connection.name() +
                                       ": the database is damaged: it holds other shapes than it "
                                       "says; run check");
  }
  copy.writer.commit();
}

}  // namespace

BlockEntry block_entry(const SearchBlock& block, std::size_t index) {
  const std::string_view text = block.name(index);
  if (text.size() < kSuffixBytes) {
    throw Error(ErrorCode::kInput, "the block is of an earlier version of morsel");
  }
  const std::size_t end = text.size() - kSuffixBytes;
  const char* const numbers = text.data() + end + 1;
  return {text.substr(0, end), io::load_as<std::int64_t>(numbers),
          io::load_as<std::int64_t>(numbers + sizeof(std::int64_t))};
}

std::shared_ptr<const SearchBlock> local_block(Connection& connection, const StateMark& mark) {
  const fs::path path = block_path(connection, mark);
  if (path.empty()) return nullptr;
  if (auto block = open_block(path)) return std::make_shared<const SearchBlock>(*std::move(block));
  try {
    if (!write_from_earlier(connection, mark, path)) write_from_all(connection, mark, path);
  } catch (const LostConnection&) {
    throw;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kOutput) throw;
    return nullptr;
  }
  std::error_code ignored;
  for (const Block& block : blocks_of(connection)) {
    if (block.path.filename() != path.filename()) fs::remove(block.path, ignored);
  }
  // Gone already when another program removed it for that of a later state.
  auto block = open_block(path);
  return block ? std::make_shared<const SearchBlock>(*std::move(block)) : nullptr;
}

void remove_block(const Connection& connection, const StateMark& mark) {
  std::error_code ignored;
  fs::remove(block_path(connection, mark), ignored);
}

std::vector<std::string> block_findings(Connection& connection) {
  const fs::path path = block_path(connection, state_mark(connection));
  std::error_code ignored;
  if (path.empty() || !fs::exists(path, ignored)) return {};
  const auto finding = [&](const std::string& reason) {
    return std::vector<std::string>{path.string() + ": " + reason + "; delete it"};
  };
  try {
    const SearchBlock block = SearchBlock::open(path);
    std::vector<std::pair<std::string_view, std::size_t>> places;  // of the names
    for (std::size_t i = 0; i < block.size(); ++i)
      places.emplace_back(block_entry(block, i).name, i);
    std::sort(places.begin(), places.end());
    auto next = places.begin();
    bool same = true;
    each_signature(connection, "ORDER BY name", {},
                   [&](const ShapeRow& row, const Signature& signature) {
                     same = same && next != places.end() && next->first == row.info.name &&
                            block.signature(next->second) == signature;
                     if (same) ++next;
                   });
    if (!same || next != places.end()) return finding("differs from the database");
  } catch (const LostConnection&) {
    throw;
  } catch (const Error& error) {
    return {std::string(error.what()) + "; delete the block " + path.string()};
  }
  return {};
}

}  // namespace morsel::store
