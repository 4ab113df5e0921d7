#include "options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

#include "numbers.hpp"

namespace morsel::cli {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr const char* kSampling = "Sampling (meshes only)";

Method method_of(const std::string& name, const std::string& text) {
  if (text == "paper") return Method::kPaper;
  if (text == "default") return Method::kDefault;
  throw CLI::ValidationError(name, fmt::format("'{}' is not default or paper", text));
}

GroundMode ground_mode_of(const std::string& name, const std::string& text) {
  if (const auto mode = ground_mode_named(text)) return *mode;
  throw CLI::ValidationError(name, fmt::format("'{}' is not auto, keep or remove", text));
}

}  // namespace

void add_mesh_options(CLI::App& app, SampleOptions& sample) {
  add(app, "--sample", "N", "Points on the surface [20000]",
      [&sample](const std::string& name, const std::string& text) {
        sample.count = whole_number(name, text, 1, std::uint64_t{1} << 31);
      })
      ->group(kSampling);
  add(app, "--noise", "S", "Gaussian noise, as a fraction of the diagonal [0]",
      [&sample](const std::string& name, const std::string& text) {
        sample.noise = number(name, text, {0.0, 1.0});
      })
      ->group(kSampling);
  add(app, "--seed", "N", "Of the random numbers [1]",
      [&sample](const std::string& name, const std::string& text) {
        sample.seed = whole_number(name, text, 0, std::numeric_limits<std::uint64_t>::max());
      })
      ->group(kSampling);
}

std::vector<std::string> given_mesh_options(const CLI::App& app) {
  std::vector<std::string> given;
  for (const char* name : {"--sample", "--noise", "--seed"}) {
    if (app.count(name) > 0) given.emplace_back(name);
  }
  return given;
}

void add_threads(CLI::App& app, int& threads, const std::string& group) {
  add(app, "--threads", "N", "0 for all cores; the result is the same [0]",
      [&threads](const std::string& name, const std::string& text) {
        threads = static_cast<int>(whole_number(name, text, 0, 1024));
      })
      ->group(group);
}

void add_method_options(CLI::App& app, SegmentOptions& options) {
  InteriorOptions& interior = options.interior;
  add(app, "--method", "default|paper", "Robust rules, or the paper's to the letter [default]",
      [&interior](const std::string& name, const std::string& text) {
        interior.method = method_of(name, text);
      })
      ->group("Method");
  add(app, "--big-ball-ratio", "R", "Paper: balls above R times the spacing are big [0.5]",
      [&interior](const std::string& name, const std::string& text) {
        interior.big_ball_ratio = number(name, text, {0.0, kUnbounded, false});
      })
      ->group("Method");
  add(app, "--deep-angle", "DEGREES", "Paper: balls below this angle meet deeply [60]",
      [&interior](const std::string& name, const std::string& text) {
        interior.deep_angle = number(name, text, {0.0, 180.0});
      })
      ->group("Method");
  add(app, "--denoise", "auto|off|K", "Smooth K times, 1 to 20; off: not, take all points [auto]",
      [&options](const std::string& name, const std::string& text) {
        if (text == "auto") return;
        if (!text.empty() && (text[0] < '0' || text[0] > '9') && text != "off") {
          throw CLI::ValidationError(name, fmt::format("'{}' is not auto, off or 0 to 20", text));
        }
        options.denoise.rounds =
            text == "off" ? 0 : static_cast<int>(whole_number(name, text, 0, 20));
      })
      ->group("Method");
  add(app, "--ground", "auto|keep|remove", "What becomes of a plane under the objects [auto]",
      [&options](const std::string& name, const std::string& text) {
        options.ground.mode = ground_mode_of(name, text);
      })
      ->group("Method");
  add_threads(app, options.threads, "Method");
}

void check_method_options(const CLI::App& app, const SegmentOptions& options) {
  const bool paper = options.interior.method == Method::kPaper;
  for (const char* name : {"--big-ball-ratio", "--deep-angle"}) {
    if (!paper && app.count(name) > 0) {
      throw CLI::ValidationError(name, "is an option of the paper's method; add --method paper");
    }
  }
  for (const char* name : {"--denoise", "--ground"}) {
    if (paper && app.count(name) > 0) {
      throw CLI::ValidationError(name, "the paper's method takes the points as they are");
    }
  }
}

void add_match_options(CLI::App& app, MatchOptions& options, const std::vector<MatchMode>& modes) {
  add(app, "--method", "default|paper", "Which score: ours or the paper's [default]",
      [&options](const std::string& name, const std::string& text) {
        options.method = method_of(name, text);
      })
      ->group("Score");
  std::vector<std::string_view> names;
  for (const MatchMode mode : modes) names.push_back(mode_name(mode));
  const std::string choice = fmt::format("{}", fmt::join(names, "|"));
  add(app, "--mode", choice.c_str(), "What else is the same: one that was bent, a piece [rigid]",
      [&options, names, choice](const std::string& name, const std::string& text) {
        if (std::ranges::find(names, text) == names.end()) {
          throw CLI::ValidationError(name, fmt::format("'{}' is none of {}", text, choice));
        }
        options.mode = mode_named(text).value();
      })
      ->group("Score");
  if (std::ranges::find(modes, MatchMode::kPartial) != modes.end()) {
    app.add_flag_callback(
           "--same-scale", [&options] { options.same_scale = true; },
           "A piece has the unit of what it is compared with (--mode partial)")
        ->group("Score");
  }
  app.add_flag_callback(
         "--no-mirror", [&options] { options.mirror = false; },
         "A shape and its mirror image are two shapes")
      ->group("Score");
}

CLI::Option* add_output(CLI::App& app, const std::string& names, const char* value, Output& output,
                        const std::string& description) {
  return add(app, names, value, description,
             [&output](const std::string& name, const std::string& text) {
               if (text.empty()) throw CLI::ValidationError(name, "the file name is empty");
               output.path = text;
             })
      ->group("Results");
}

void add_database(CLI::App& app, std::filesystem::path& database, bool required) {
  CLI::Option* const option = add(app, "--database", "DB", "A file, or postgresql://HOST/NAME",
                                  [&database](const std::string& name, const std::string& text) {
                                    if (text.empty())
                                      throw CLI::ValidationError(name, "the name is empty");
                                    database = text;
                                  });
  if (required) option->required()->option_text("DB (required)");
}

void add_json(CLI::App& app, bool& json) {
  app.add_flag("--json", json, "Print JSON instead of a table")->group("Results");
}

}  // namespace morsel::cli
