// morsel: a database of shapes: signatures under names, and the search for look-alikes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <map>
#include <memory>
#include <morsel/io.hpp>
#include <morsel/match.hpp>
#include <morsel/morsel.hpp>
#include <morsel/progress.hpp>
#include <morsel/signature.hpp>
#include <morsel/sketch.hpp>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace morsel {

/// What a person says about a shape.
struct ShapeInfo {
  std::string name;               ///< unique in the database, 1 … 1024 bytes of UTF-8
  std::string class_name;         ///< what it is, e.g. "chair"; empty: not said
  std::vector<std::string> tags;  ///< sorted, each once
  std::string source;             ///< where the points came from, e.g. the path of a file

  friend bool operator==(const ShapeInfo&, const ShapeInfo&) = default;
};

/// What the program knows of a shape. It is stored once for all names of the same content.
struct ShapeData {
  std::string content;       ///< content_key() of the points and options
  std::string options;       ///< under which it was segmented, for people
  std::uint64_t points = 0;  ///< of the input
  Signature signature;
  Sketch sketch;  ///< what pictures are drawn from: draw_thumbnail(), render_parts()
};

/// A shape as it is in the database.
struct StoredShape {
  ShapeInfo info;
  ShapeData data;
};

/// Names the content: equal for equal coordinates in equal order, options and format of signatures,
/// different for all practical purposes otherwise. 32 hexadecimal digits. Cost: O(n).
[[nodiscard]] std::string content_key(std::span<const Vec3> points, const SegmentOptions& options);

/// All that is stored of a segmentation. Throws Error(kInput) when there is nothing to compare: too
/// few points, or all on one plane. Cost: O(n).
[[nodiscard]] ShapeData make_shape_data(const Segmentation& segmentation,
                                        const SegmentOptions& options, std::string content);

/// Which shapes to list; what is not given does not narrow.
struct ShapeFilter {
  std::optional<std::string> class_name;
  std::optional<std::string> tag;
};

/// A shape that looks like the query.
struct LookAlike {
  ShapeInfo info;
  double score = 0.0;  ///< 0 … 1
};

/// Scores of all pairs. Rows are ordered by class, then name.
struct SimilarityMatrix {
  std::vector<ShapeInfo> shapes;  ///< (n)
  std::vector<double> scores;     ///< (n, n), row by row; symmetric, ones on the diagonal
};

/// What a write did to a name.
enum class Change { kAdded, kReplaced, kUnchanged };

/// How a database is opened.
enum class Access {
  kRead,    ///< an existing one, nothing in it is changed
  kWrite,   ///< an existing one
  kCreate,  ///< one that is made if it is not there
};

/// Shapes in one file (SQLite, write-ahead log) or, for many machines, on a PostgreSQL server.
///
/// Searches read a copy of all signatures that is laid out for them: `FILE-….block` beside the
/// file, or in the folder `morsel` of the user's cache. It is made when a search finds none of the
/// current state, from that of an earlier state and what changed since, and may be deleted at any
/// time.
///
/// Every change is one transaction: it is there as a whole, on disk, when the function returns, and
/// not at all otherwise. Several processes and threads may read and write at once.
///
/// All functions throw Error(kInput) naming the database when it is not one of morsel, was written
/// by a newer version or is damaged; Error(kOutput) when it cannot be written, stays locked for a
/// minute or a server that went away does not come back within half a minute. An older version's
/// database is brought up to date when opened for writing.
class Database {
 public:
  /// Throws as said above; Access::kRead and kWrite also when there is no such database.
  /// `place`: a file, or an address that begins with postgresql://, as libpq takes it.
  [[nodiscard]] static Database open(const std::filesystem::path& place, Access access);
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;
  ~Database();

  /// The file, or the address without a password.
  [[nodiscard]] const std::filesystem::path& file() const;
  /// Number of shapes, that is, of names.
  [[nodiscard]] std::size_t size() const;

  /// All shapes by name, as of one state of the database: the same object until it changes.
  /// Cost: O(shapes) after a change, else O(1).
  [[nodiscard]] std::shared_ptr<const std::vector<ShapeInfo>> shapes() const;
  /// A copy of those that pass, by name. Cost: O(shapes).
  [[nodiscard]] std::vector<ShapeInfo> list(const ShapeFilter& filter = {}) const;
  /// Nothing when there is no shape of that name.
  [[nodiscard]] std::optional<ShapeInfo> find(const std::string& name) const;
  /// Throws Error(kInput) when there is no shape of that name.
  [[nodiscard]] StoredShape get(const std::string& name) const;

  /// Stores a shape, in place of the one of that name if there is one.
  /// Throws Error(kUsage) for a name that cannot be one.
  Change put(const ShapeInfo& info, const ShapeData& data);
  /// As put() when data of that content is stored already; nothing otherwise.
  std::optional<Change> put_known(const ShapeInfo& info, const std::string& content);
  /// All or none. Throws Error(kInput) when one is missing.
  void remove(std::span<const std::string> names);
  /// Throws Error(kInput) when `from` is missing or `to` is taken.
  void rename(const std::string& from, const std::string& to);

  /// Remembers that a file could not be stored, and why, until a shape of that name is stored.
  void put_failure(const std::string& name, const std::string& reason);
  /// By name: the reasons.
  [[nodiscard]] std::map<std::string, std::string> failures() const;

  /// The `top` shapes of the highest scores, best first, equal ones by name: exactly what scoring
  /// every shape would give. The first search after a change brings the copy of the signatures up
  /// to date: O(shapes) on the disk, O(changes) from a server.
  [[nodiscard]] std::vector<LookAlike> search(const Signature& query, std::size_t top,
                                              const MatchOptions& options = {}) const;
  /// The `top` shapes that a piece fits best, best first, as search_partial() finds them among the
  /// sketches; `options.mode` is kPartial. Cost: O(shapes), some milliseconds each.
  [[nodiscard]] std::vector<LookAlike> search_partial(const Sketch& piece, std::size_t top,
                                                      const MatchOptions& options, int threads = 0,
                                                      const Progress* progress = nullptr) const;
  /// Cost: O(shapes²) scores on `threads` threads (0: all cores).
  [[nodiscard]] SimilarityMatrix matrix(const MatchOptions& options = {}, int threads = 0,
                                        const Progress* progress = nullptr) const;
  /// As matrix(), of the shapes of these names alone. Throws Error(kInput) when one is missing.
  [[nodiscard]] SimilarityMatrix matrix_of(std::span<const std::string> names,
                                           const MatchOptions& options = {}, int threads = 0,
                                           const Progress* progress = nullptr) const;

  /// Everything as JSON lines, by name; docs/database.md has the schema. Equal databases give equal
  /// bytes. Throws Error(kOutput) when the stream fails.
  void export_lines(std::ostream& stream) const;
  /// Stores what export_lines wrote, all or nothing; shapes of the same names are replaced. `name`
  /// stands for the stream in messages. Returns how many lines there were.
  /// Throws Error(kInput) that names the line and what is wrong with it.
  std::size_t import_lines(std::istream& stream, const std::string& name);

  /// Reads every byte: the database's own check, links between tables, and that each row has its
  /// checksum and can be decoded. One sentence for each thing found wrong, at most 100.
  [[nodiscard]] std::vector<std::string> check(const Progress* progress = nullptr) const;
  /// Drops the rows that are damaged, and shapes whose signature is, so that all others can be used
  /// again. One sentence for each shape or signature dropped: index these again. All or nothing;
  /// throws Error(kInput) when the file is damaged between the rows: import an export then.
  std::vector<std::string> repair();

 private:
  struct State;
  explicit Database(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A file to be stored.
struct ShapeFile {
  std::filesystem::path path;
  std::string name;                       ///< under which it is stored
  std::optional<std::string> class_name;  ///< not given: as it was
  std::vector<std::string> tags;          ///< added to those it has
};

/// How files become shapes of the database.
struct IndexOptions {
  SegmentOptions segment;  ///< `threads`: files that are worked on at once, 0: one a core
  SampleOptions sample;    ///< of meshes
};

/// A file that could not be stored.
struct IndexFailure {
  std::filesystem::path path;
  std::string reason;
};

/// What index_files() did.
struct IndexReport {
  std::size_t added = 0;
  std::size_t replaced = 0;
  std::size_t unchanged = 0;           ///< neither content, class, tags nor path differ
  std::size_t without_inside = 0;      ///< stored, but compared by their points alone
  std::vector<IndexFailure> failures;  ///< in the order of `files`
};

/// Segments files and stores them, several at once, each in a transaction of its own. A file whose
/// content is stored already is not segmented again. A file that fails does not stop the others;
/// the database remembers it (failures()) until it succeeds. Progress: the share of the files that
/// are done. When cancelled, what is stored stays. Throws Error(kUsage), Error(kCancelled), and
/// what Database::put throws.
[[nodiscard]] IndexReport index_files(Database& database, std::span<const ShapeFile> files,
                                      const IndexOptions& options = {},
                                      const Progress* progress = nullptr);

}  // namespace morsel
