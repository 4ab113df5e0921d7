#include "tomato.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <morsel/error.hpp>

namespace morsel::bench {
namespace {

constexpr const char* kPython = "/usr/bin/python3";

// Prints the seconds, then a label a line.
constexpr const char* kScript = R"(
import sys, time, numpy
from gudhi.clustering.tomato import Tomato
path, neighbors, density_neighbors, prominence = sys.argv[1:]
points = numpy.fromfile(path).reshape(-1, 3)
began = time.process_time()
method = Tomato(k=int(neighbors), k_DTM=int(density_neighbors), merge_threshold=float(prominence))
labels = method.fit_predict(points)
print(time.process_time() - began)
print(*labels, sep="\n")
)";

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail(const char* what) {
  throw Error(ErrorCode::kResource, fmt::format("ToMATo: {}", what));
}

// Not named, gone when closed.
File file_of(std::span<const Vec3> points) {
  File file(std::tmpfile());
  if (!file ||
      std::fwrite(points.data(), sizeof(Vec3), points.size(), file.get()) != points.size() ||
      std::fflush(file.get()) != 0) {
    fail("cannot write the points");
  }
  return file;
}

}  // namespace

bool has_tomato() {
  const auto command = fmt::format("{} -c 'import gudhi.clustering.tomato, scipy' 2>&-", kPython);
  return std::system(command.c_str()) == 0;
}

TomatoResult tomato(std::span<const Vec3> points, const TomatoOptions& options) {
  const File file = file_of(points);
  const auto command =
      fmt::format("exec {} -c '{}' /dev/fd/{} {} {} {}", kPython, kScript, fileno(file.get()),
                  options.neighbors, options.density_neighbors, options.prominence);
  std::FILE* python = popen(command.c_str(), "r");
  if (python == nullptr) fail("cannot start Python");
  TomatoResult result;
  bool complete = std::fscanf(python, "%lf", &result.core_seconds) == 1;
  for (int label = 0; complete && std::fscanf(python, "%d", &label) == 1;) {
    result.labels.push_back(label);
  }
  complete = pclose(python) == 0 && result.labels.size() == points.size();
  if (!complete) fail("Python gave no labels");
  return result;
}

}  // namespace morsel::bench
