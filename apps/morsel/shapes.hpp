// The shapes that a command compares: files, or names in a database.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <morsel/database.hpp>
#include <optional>
#include <string>
#include <vector>

namespace morsel::cli {

/// A shape ready to be compared and drawn.
struct Subject {
  std::string name;
  Signature signature;
  Sketch sketch;
};

/// How files are read.
struct ReadOptions {
  SampleOptions sample;
  int threads = 0;
};

/// The options of commands that compare shapes: those of the score and of reading files.
void add_comparison_options(CLI::App& command, MatchOptions& match, ReadOptions& read);

/// The shape stored under the name `text`, or else that of the file `text`; "-" is standard input.
/// Throws Error(kInput) when there is neither.
[[nodiscard]] Subject find_subject(const std::string& text, const Database* database,
                                   const ReadOptions& options, const Progress& progress);

[[nodiscard]] Subject stored_subject(const Database& database, const std::string& name);

/// In partial mode the source is the piece.
[[nodiscard]] Match match_subjects(const Subject& target, const Subject& source,
                                   const MatchOptions& options);

/// "########..", 20 wide.
[[nodiscard]] std::string score_bar(double score);

/// Shapes side by side, each turned onto the first by its match with it. Parts have the colour of
/// the first's part that they lie on, grey where there is none.
struct Aligned {
  const Subject* shape;
  Match match;  ///< target: the first shape
};
[[nodiscard]] Image draw_aligned(const Subject& first, const std::vector<Aligned>& others);

/// A piece, then each whole in grey with the piece where it lies on it: `match` has the whole as
/// target, the piece as source.
[[nodiscard]] Image draw_placed(const Subject& piece, const std::vector<Aligned>& wholes);

/// "name, name"
[[nodiscard]] std::string join_tags(const std::vector<std::string>& tags);

}  // namespace morsel::cli
