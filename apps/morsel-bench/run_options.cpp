#include "run_options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include "summary.hpp"

namespace morsel::bench {
namespace {

// "auto", "off" or a number of rounds.
std::optional<int> parse_denoise(const std::string& text) {
  if (text == "auto") return std::nullopt;
  if (text == "off") return 0;
  int rounds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rounds);
  if (error != std::errc() || end != text.data() + text.size() || rounds < 0) {
    throw Error(ErrorCode::kUsage,
                fmt::format("--denoise is '{}'; expected auto, off or a number of rounds", text));
  }
  return rounds;
}

}  // namespace

std::vector<double> RunOptions::noise_levels() const {
  return noise.empty() ? std::vector<double>{0.0} : noise;
}

CloudOptions RunOptions::cloud(double noise_level) const {
  return {.points = points, .noise = noise_level, .outliers = outliers, .hole = hole, .seed = seed};
}

SegmentOptions RunOptions::segment() const {
  SegmentOptions result;
  result.interior.method = method == "paper" ? Method::kPaper : Method::kDefault;
  result.denoise.rounds = parse_denoise(denoise);
  result.denoise.threads = 1;
  result.threads = 1;
  result.check();
  return result;
}

std::vector<Model> RunOptions::models() const {
  for (const double level : noise_levels()) cloud(level).check();
  static_cast<void>(segment());
  return list_models(folder, IdFilter::parse(ids));
}

void add_run_options(CLI::App& command, RunOptions& options) {
  command
      .add_option("DIR", options.folder,
                  "Folder of the benchmark: meshes off/N.off, segmentations seg/N/N_k.seg")
      ->required()
      ->check(CLI::ExistingDirectory);
  command.add_option("--points", options.points, "Samples of each mesh")->capture_default_str();
  command
      .add_option("--noise", options.noise,
                  "Noise as a fraction of the bounding-box diagonal; several: one run each")
      ->delimiter(',');
  command.add_option("--outliers", options.outliers,
                     "Outliers as a fraction of the samples, uniform in the bounding box grown by "
                     "half");
  command.add_option("--hole", options.hole,
                     "Radius of a hole around a random sample, as a fraction of the bounding-box "
                     "diagonal");
  command.add_option("--ids", options.ids, "all, or RmodM such as 1mod4")->capture_default_str();
  command.add_option("--threads", options.threads, "Models at a time, one thread each")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  command.add_option("--seed", options.seed, "Of samples, noise and outliers")
      ->capture_default_str();
  command.add_option("--method", options.method, "default or paper")
      ->capture_default_str()
      ->check(CLI::IsMember({"default", "paper"}));
  command.add_flag_callback(
      "--paper", [&options] { options.method = "paper"; }, "The same as --method paper");
  command.add_option("--denoise", options.denoise, "auto, off or a number of rounds")
      ->capture_default_str();
  command.add_option("--json", options.json, "Write all values of all models");
}

nlohmann::ordered_json report_head(const std::string& command, const RunOptions& options) {
  nlohmann::ordered_json head;
  head["program"] = "morsel-bench " + command;
  head["version"] = version();
  head["date"] = utc_now();
  head["options"] = {
      {"ids", options.ids},           {"points", options.points}, {"noise", options.noise_levels()},
      {"outliers", options.outliers}, {"hole", options.hole},     {"threads", options.threads},
      {"seed", options.seed},         {"method", options.method}, {"denoise", options.denoise}};
  return head;
}

}  // namespace morsel::bench
