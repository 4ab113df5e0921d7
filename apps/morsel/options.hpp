// Options that several commands have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <morsel/io.hpp>
#include <morsel/match.hpp>
#include <morsel/morsel.hpp>
#include <string>
#include <vector>

#include "outputs.hpp"

namespace morsel::cli {

/// Adds an option whose text `read(name, text)` turns into a value; `value` stands for it in the
/// help.
template <class Read>
CLI::Option* add(CLI::App& app, const std::string& names, const char* value,
                 const std::string& description, Read read) {
  const std::string name = names.substr(names.find("--"));
  return app
      .add_option_function<std::string>(
          names, [name, read](const std::string& text) { read(name, text); }, description)
      ->option_text(value);
}

/// --sample, --noise, --seed.
void add_mesh_options(CLI::App& app, SampleOptions& sample);
/// Those of them that were given.
[[nodiscard]] std::vector<std::string> given_mesh_options(const CLI::App& app);

/// --method, --big-ball-ratio, --deep-angle, --denoise, --ground, --threads.
void add_method_options(CLI::App& app, SegmentOptions& options);
/// Throws CLI::ValidationError for an option that the chosen method would ignore.
void check_method_options(const CLI::App& app, const SegmentOptions& options);

/// --threads, in the group `group`.
void add_threads(CLI::App& app, int& threads, const std::string& group);

/// --method, --mode, one of `modes`, and --no-mirror of the score; --same-scale with kPartial.
void add_match_options(CLI::App& app, MatchOptions& options, const std::vector<MatchMode>& modes);

/// An option that names a file to be written.
CLI::Option* add_output(CLI::App& app, const std::string& names, const char* value, Output& output,
                        const std::string& description);

/// --database, which must be given unless `required` is false.
void add_database(CLI::App& app, std::filesystem::path& database, bool required = true);

/// --json.
void add_json(CLI::App& app, bool& json);

}  // namespace morsel::cli
