// Reads a whole database and says what is wrong with it.

#include <fmt/format.h>

#include <functional>
#include <iterator>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string>

#include "store/local_block.hpp"
#include "store/rows.hpp"
#include "store/state.hpp"

namespace morsel {
namespace {

constexpr std::size_t kMostFindings = 100;

using store::Connection;
using store::Rows;

// Gathers what is wrong with a database.
class Findings {
 public:
  Findings(Connection& connection, const Progress* progress)
      : connection_(connection), progress_(progress) {}

  void report(const char* stage, double fraction) const {
    if (progress_ != nullptr) progress_->report(stage, fraction);
  }

  /// Runs one part of the check, which returns findings; what stops it is a finding like any other.
  void collect(const std::function<std::vector<std::string>()>& part) {
    if (all_.size() >= kMostFindings) return;
    try {
      std::vector<std::string> found = part();
      std::move(found.begin(), found.end(), std::back_inserter(all_));
    } catch (const store::LostConnection&) {
      throw;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kCancelled) throw;
      all_.emplace_back(error.what());
    }
  }

  /// Goes through the rows of a query; a bad row does not keep the next from being read.
  void each_row(const std::string& query, const std::function<void(const Rows&)>& look_at) {
    collect([&] {
      const auto rows = connection_.query(query);
      while (rows->next()) {
        collect([&] {
          look_at(*rows);
          return std::vector<std::string>();
        });
        if (progress_ != nullptr) progress_->check();
      }
      return std::vector<std::string>();
    });
  }

  [[nodiscard]] std::vector<std::string>& all() { return all_; }

 private:
  Connection& connection_;
  const Progress* progress_;
  std::vector<std::string> all_;
};

[[noreturn]] void fail(const Connection& connection, const std::string& reason) {
  throw Error(ErrorCode::kInput, fmt::format("{}: {}", connection.name(), reason));
}

void check_links(Connection& connection, Findings& findings) {
  findings.each_row(
      fmt::format("SELECT name {}", store::kShapesWithoutSignature), [&](const Rows& row) {
        fail(connection, fmt::format("shape '{}': its signature is missing", row.bytes(0)));
      });
  findings.each_row(
      fmt::format("SELECT id {}", store::kSignaturesWithoutShape), [&](const Rows& row) {
        fail(connection, fmt::format("signature {} belongs to no shape", row.integer(0)));
      });
}

void check_rows(Connection& connection, Findings& findings) {
  findings.report("shapes", 0.4);
  store::StateMark read = {};
  findings.each_row(fmt::format("SELECT {} FROM shapes", store::kShapeColumns),
                    [&](const Rows& row) {
                      ++read.shapes;
                      read.digest ^= row.integer(6);
                      (void)store::read_shape(row, connection.name());
                    });
  findings.report("signatures", 0.5);
  findings.each_row(fmt::format("SELECT {} FROM signatures", store::kDataColumns),
                    [&](const Rows& row) { (void)store::read_data(row, connection.name()); });
  findings.collect([&]() -> std::vector<std::string> {
    const store::StateMark mark = store::state_mark(connection);
    if (mark.shapes == read.shapes && mark.digest == read.digest) return {};
    return {connection.name() + ": it holds other shapes than it says"};
  });
}

}  // namespace

std::vector<std::string> Database::check(const Progress* progress) const {
  return state_->once(State::Mode::kRead, [&](Connection& connection) {
    Findings findings(connection, progress);
    findings.report("file", 0.0);
    findings.collect([&] { return connection.storage_findings(kMostFindings); });
    findings.report("links", 0.3);
    check_links(connection, findings);
    check_rows(connection, findings);
    findings.report("block", 0.8);
    // With anything wrong there is nothing to compare the block with.
    if (findings.all().empty()) {
      findings.collect([&] { return store::block_findings(connection); });
    }
    return std::move(findings.all());
  });
}

}  // namespace morsel
