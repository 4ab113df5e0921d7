#include "study.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "base/atomic_file.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::reproduce {

std::string Study::keep(const std::string& name, const Image& image) const {
  const std::string path = "pictures/" + name + ".png";
  write_png(options.out / path, image);
  return path;
}

std::string Study::keep(const std::string& name, const std::string& svg) const {
  const std::string path = "pictures/" + name + ".svg";
  AtomicFile file(options.out / path);
  file.stream() << svg;
  file.commit();
  return path;
}

void Study::save() const { bench::write_json(options.out / "figures.json", figures); }

void say(const std::string& what) {
  static const bench::Stopwatch since_start;
  fmt::print("{:6.1f} s  {}\n", since_start.seconds(), what);
  std::fflush(stdout);
}

}  // namespace morsel::reproduce
