// Reads a whole database and says what is wrong with it.

#include <fmt/format.h>

#include <functional>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string>

#include "store/rows.hpp"
#include "store/state.hpp"

namespace morsel {
namespace {

constexpr std::size_t kMostFindings = 100;

// Runs one part of the check; what stops it is a finding like any other.
void collect(std::vector<std::string>& findings, const std::filesystem::path& file,
             const std::function<void()>& part) {
  if (findings.size() >= kMostFindings) return;
  try {
    store::guarded(file, part);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    findings.emplace_back(error.what());
  }
}

}  // namespace

std::vector<std::string> Database::check(const Progress* progress) const {
  SQLite::Database& connection = state_->connection;
  const std::filesystem::path& file = state_->file;
  std::vector<std::string> findings;
  const auto report = [&](const char* stage, double fraction) {
    if (progress != nullptr) progress->report(stage, fraction);
  };
  // Goes through the rows that `query` gives; a bad row does not keep the next from being read.
  const auto each_row = [&](const std::string& query, const auto& look_at) {
    collect(findings, file, [&] {
      SQLite::Statement statement(connection, query);
      while (statement.executeStep()) {
        collect(findings, file, [&] { look_at(statement); });
        if (progress != nullptr) progress->check();
      }
    });
  };
  return state_->look([&] {
    report("file", 0.0);
    each_row(fmt::format("PRAGMA integrity_check({})", kMostFindings), [&](SQLite::Statement& row) {
      const std::string text = row.getColumn(0).getString();
      if (text != "ok") findings.push_back(file.string() + ": " + text);
    });
    report("links", 0.3);
    each_row(
        "SELECT name FROM shapes WHERE NOT EXISTS (SELECT 1 FROM signatures WHERE "
        "signatures.id = shapes.signature)",
        [&](SQLite::Statement& row) {
          findings.push_back(fmt::format("{}: shape '{}': its signature is missing", file.string(),
                                         row.getColumn(0).getString()));
        });
    each_row(
        "SELECT id FROM signatures WHERE NOT EXISTS (SELECT 1 FROM shapes WHERE "
        "shapes.signature = signatures.id)",
        [&](SQLite::Statement& row) {
          findings.push_back(fmt::format("{}: signature {} belongs to no shape", file.string(),
                                         row.getColumn(0).getInt64()));
        });
    report("shapes", 0.4);
    each_row(fmt::format("SELECT {} FROM shapes", store::kShapeColumns),
             [&](SQLite::Statement& row) { (void)store::read_shape(row, file); });
    report("signatures", 0.5);
    each_row(fmt::format("SELECT {} FROM signatures", store::kDataColumns),
             [&](SQLite::Statement& row) { (void)store::read_data(row, file); });
    report("block", 0.8);
    collect(findings, file, [&] {
      if (!findings.empty()) return;  // nothing to compare the block with
      findings = state_->check_block();
    });
    return findings;
  });
}

}  // namespace morsel
