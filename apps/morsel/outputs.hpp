// The files that a command is to write, checked before the work so that nothing fails after it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace morsel::cli {

/// One file to be written.
struct Output {
  std::string option;                   ///< as the user knows it: "--labels"
  std::filesystem::path path;           ///< empty: not asked for
  std::vector<std::string> extensions;  ///< allowed ones, lower case with dot; empty: any
};

/// Checks those of `outputs` that were asked for: extension, folder, permission, and that no two
/// are the same file and none is the input ("-": standard input). Throws Error(kUsage) for what the
/// command line has wrong, Error(kOutput) for what the disk has.
void check_outputs(const std::vector<Output>& outputs, const std::filesystem::path& input);

/// Writes `text` to `path`, completely or not at all. Throws Error(kOutput).
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace morsel::cli
