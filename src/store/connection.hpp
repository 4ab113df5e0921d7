// What a database is kept in, SQLite or PostgreSQL: statements, transactions, and its failures as
// sentences. All else in this folder is the same for both.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace morsel::store {

/// Bytes that are no text.
struct Blob {
  explicit Blob(std::string_view value) : bytes(value) {}
  std::string_view bytes;
};

/// What a parameter of a statement may be.
using Value = std::variant<std::int64_t, std::string_view, Blob>;

/// The rows that a statement gives, one after another. While there is one, its connection takes no
/// other statement.
class Rows {
 public:
  virtual ~Rows() = default;
  /// Goes to the next row, first to the first; false behind the last.
  virtual bool next() = 0;
  [[nodiscard]] virtual std::int64_t integer(int column) const = 0;
  /// Of a text or of bytes.
  [[nodiscard]] virtual std::string bytes(int column) const = 0;
};

/// Thrown when the server cannot be reached (any longer): what was begun did not happen, or its
/// answer was lost, and may be tried again.
class LostConnection : public Error {
 public:
  explicit LostConnection(const std::string& message) : Error(ErrorCode::kOutput, message) {}
};

/// How tables are made and brought up to date; schema.cpp has them.
struct Schema {
  int oldest;  ///< version that can be brought up to date
  const char* const*
      steps;            ///< the first makes the tables of `oldest`, each other the next version
  const char* own_ids;  ///< what comes before VALUES where a row is given its id
};

/// A connection is not for several threads at once. All functions throw Error as Database does.
class Connection {
 public:
  enum class Mode {
    kRead,   ///< sees one state of the database, whatever others write meanwhile
    kWrite,  ///< waits for its turn: there is one at a time
  };

  explicit Connection(std::string name) : name_(std::move(name)) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  virtual ~Connection() = default;

  /// The file or address as messages give it, without a password.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Begins one statement; `?1` in it stands for the first parameter.
  [[nodiscard]] virtual std::unique_ptr<Rows> query(const std::string& statement,
                                                    std::initializer_list<Value> parameters) = 0;
  [[nodiscard]] std::unique_ptr<Rows> query(const std::string& statement) {
    return query(statement, {});
  }
  /// The first column of the first row, if there is one. Runs the statement to its end.
  std::optional<std::int64_t> integer(const std::string& statement,
                                      std::initializer_list<Value> parameters = {});
  /// Runs one statement to its end.
  void run(const std::string& statement, std::initializer_list<Value> parameters = {});
  /// Runs several statements without parameters.
  virtual void run_script(const std::string& statements) = 0;

  virtual void begin(Mode mode) = 0;
  virtual void commit() = 0;
  virtual void roll_back() noexcept = 0;
  /// Connects anew after LostConnection.
  virtual void reconnect() {}

  [[nodiscard]] virtual const Schema& schema() const = 0;
  /// Of the tables; 0 where there are none. Throws Error(kInput) when they are not morsel's.
  [[nodiscard]] virtual int version() = 0;
  virtual void set_version(int version) = 0;

  /// Where search blocks go: their paths begin with this. Empty: nowhere.
  [[nodiscard]] virtual std::filesystem::path block_prefix() const = 0;
  /// What the database's own check finds, at most `most` sentences.
  [[nodiscard]] virtual std::vector<std::string> storage_findings(int most) = 0;
  /// Makes the database's own indices anew. Within a transaction for writing.
  virtual void rebuild_indices() {}

 private:
  std::string name_;
};

/// Rolled back unless it is committed.
class Transaction {
 public:
  Transaction(Connection& connection, Connection::Mode mode) : connection_(connection) {
    connection_.begin(mode);
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction() {
    if (!committed_) connection_.roll_back();
  }
  void commit() {
    connection_.commit();
    committed_ = true;
  }

 private:
  Connection& connection_;
  bool committed_ = false;
};

/// Opens the file or, at a postgresql:// address, the server's database; checks that it is of
/// morsel's and of a known version, creates or migrates its tables as `access` allows.
[[nodiscard]] std::unique_ptr<Connection> connect(const std::filesystem::path& place,
                                                  Access access);

/// Which state of the shapes this is. Equal for equal shapes and signatures alone.
struct StateMark {
  std::int64_t sequence = 0;  ///< of the last change
  std::int64_t digest = 0;    ///< of all rows of shapes: their checksums, combined by exclusive or
  std::int64_t shapes = 0;    ///< how many there are

  friend bool operator==(const StateMark&, const StateMark&) = default;
};

[[nodiscard]] StateMark state_mark(Connection& connection);

}  // namespace morsel::store
