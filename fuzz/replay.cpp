// Runs a target without libFuzzer, on files and on each of them damaged in the same ways each time:
//   morsel_replay TARGET DAMAGES FILE|FOLDER…
// Of a folder whose files have extensions, only those whose extension is the target.

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "targets.hpp"

namespace {

using Path = std::filesystem::path;

std::vector<Path> files_of(const Path& path, std::string_view target) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    const std::string extension = entry.path().extension().string();
    if (extension.empty() || extension.substr(1) == target) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::string content(const Path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Cut short, a piece left out or repeated, a number or some bytes where they hurt.
std::string damaged(std::string bytes, morsel::Random& random) {
  static constexpr std::array kTexts{"-1", "0", "nan", "1e308", "4294967296", "\"", "\xff\xff"};
  const std::size_t at = random.below(bytes.size() + 1);
  const std::size_t count = random.below(std::min<std::size_t>(bytes.size() - at, 32) + 1);
  switch (random.below(5)) {
    case 0:
      return bytes.substr(0, at);
    case 1:
      return bytes.erase(at, count);
    case 2:
      return bytes.insert(random.below(bytes.size() + 1), bytes.substr(at, count));
    case 3:
      return bytes.replace(at, count / 8, kTexts[random.below(kTexts.size())]);
    default:
      if (at < bytes.size()) bytes[at] = static_cast<char>(random.next());
      return bytes;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto* const target = argc > 3 ? morsel::fuzz::find_target(argv[1]) : nullptr;
  if (target == nullptr) {
    std::fprintf(stderr, "usage: %s TARGET DAMAGES FILE|FOLDER…\n", argv[0]);
    return 2;
  }
  const int damages = std::stoi(argv[2]);
  std::size_t runs = 0;
  for (int i = 3; i < argc; ++i) {
    for (const Path& file : files_of(argv[i], target->name)) {
      const std::string bytes = content(file);
      morsel::Random random(bytes.size());
      target->run(target->name, bytes);
      for (int k = 0; k < damages; ++k) target->run(target->name, damaged(bytes, random));
      runs += 1 + static_cast<std::size_t>(damages);
    }
  }
  std::printf("%s: %zu runs\n", argv[1], runs);
  return runs > 0 ? 0 : 1;
}
