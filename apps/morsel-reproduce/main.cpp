// morsel-reproduce: everything that the paper shows, measured again: figures.json and pictures.
#include <fmt/format.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <functional>
#include <morsel/morsel.hpp>

#include "sections.hpp"
#include "summary.hpp"

namespace morsel::reproduce {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

void run(const Options& options) {
  Study study{.options = options, .figures = {}};
  std::filesystem::create_directories(options.out / "pictures");
  study.figures = {{"program", "morsel-reproduce"}, {"version", version()},
                   {"date", bench::utc_now()},      {"quick", options.quick},
                   {"processor", processor()},      {"cores", tbb::info::default_concurrency()}};
  const auto section = [&](const char* title, const std::function<void()>& add) {
    say(title);
    add();
    study.save();
  };
  section("times", [&] { add_times(study); });
  section("figures 1 and 2: the steps in the plane", [&] { add_plane(study); });
  section("figures 3 and 4: parts of real shapes", [&] { add_parts(study); });
  Collection generated;
  section("figures 5 to 7: generated shapes in seventeen classes", [&] {
    generated = make_generated(study);
    add_retrieval(study, "generated", generated);
  });
  section("claims", [&] { add_claims(study, generated); });
  if (!options.psb.empty()) {
    section("figures 5 to 7: Princeton Shape Benchmark",
            [&] { add_retrieval(study, "psb", make_psb(study)); });
  }
  if (!options.segmentation.empty()) {
    section("claims: people's segmentations", [&] { add_annotated(study); });
  }
  say("done: " + (options.out / "figures.json").string());
}

int main_of(int argc, char** argv) {
  CLI::App app(
      "Measures everything that Dey, Giesen and Goswami (2004) show, from real data: writes "
      "figures.json and pictures, from which make reproduce makes a page.");
  Options options;
  app.add_option("--out", options.out, "Folder to write to")->capture_default_str();
  app.add_option("--data", options.data,
                 "Folder of Debian's libcgal-demo (scripts/fetch-demo-data.sh)")
      ->check(CLI::ExistingDirectory);
  app.add_option("--scan", options.scans, "A raw scan to be cut as well; may be repeated")
      ->check(CLI::ExistingFile);
  app.add_option("--psb", options.psb,
                 "Folder of the Princeton Shape Benchmark: a .cla file, and mN.off anywhere below")
      ->check(CLI::ExistingDirectory);
  app.add_option("--segmentation-benchmark", options.segmentation,
                 "Folder of the Princeton Segmentation Benchmark: off/N.off, seg/N/N_k.seg")
      ->check(CLI::ExistingDirectory);
  app.add_flag("--quick", options.quick, "Little of everything, to see that it works");
  try {
    app.parse(argc, argv);
    run(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "morsel-reproduce: {}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace morsel::reproduce

int main(int argc, char** argv) { return morsel::reproduce::main_of(argc, argv); }
