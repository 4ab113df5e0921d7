#include "base/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <morsel/error.hpp>

namespace morsel {
namespace {

constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();

std::size_t of_system() {
  std::ifstream file("/proc/meminfo");
  for (std::string name, unit; file >> name;) {
    std::size_t kilobytes = 0;
    if (!(file >> kilobytes)) break;
    if (name == "MemAvailable:") return kilobytes * 1024;
    std::getline(file, unit);
  }
  return kUnknown;
}

std::size_t of_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnknown;
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const std::size_t used = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur - std::min<std::size_t>(used, limit.rlim_cur);
}

}  // namespace

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

std::size_t available_memory() { return std::min(of_system(), of_limit()); }

void expect_memory(std::size_t needed, std::size_t available, const std::string& what) {
  if (needed <= available) return;
  constexpr double kGigabyte = 1e9;
  throw Error(ErrorCode::kResource,
              fmt::format("{} needs about {:.1f} GB of memory, {:.1f} GB are available; thin the "
                          "cloud, or leave out --denoise off and --method paper, which take all "
                          "points",
                          what, static_cast<double>(needed) / kGigabyte,
                          static_cast<double>(available) / kGigabyte));
}

}  // namespace morsel
