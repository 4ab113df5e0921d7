#include "outputs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <morsel/error.hpp>
#include <system_error>

#include "base/atomic_file.hpp"
#include "base/lower_case.hpp"

namespace morsel::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const Output& output, const std::string& reason) {
  throw Error(ErrorCode::kOutput,
              fmt::format("{}: {}: {}", output.option, output.path.string(), reason));
}

[[noreturn]] void fail_usage(const Output& output, const std::string& reason) {
  throw Error(ErrorCode::kUsage,
              fmt::format("{}: {}: {}", output.option, output.path.string(), reason));
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void check_extension(const Output& output) {
  if (output.extensions.empty()) return;
  const std::string extension = lower_case(output.path.extension().string());
  const auto& allowed = output.extensions;
  if (std::find(allowed.begin(), allowed.end(), extension) != allowed.end()) return;
  fail_usage(output, fmt::format("the name must end in {}", fmt::join(allowed, " or ")));
}

void check_place(const Output& output) {
  const fs::path folder = folder_of(output.path);
  std::error_code error;
  if (!fs::exists(folder, error)) fail(output, "the folder " + folder.string() + " does not exist");
  if (!fs::is_directory(folder, error)) fail(output, folder.string() + " is not a folder");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    fail(output, "cannot write to the folder " + folder.string() + ": " + std::strerror(errno));
  }
  // The temporary name beside it is longer by ".<process>-<number>.part".
  constexpr std::size_t kLongestName = 230;
  if (output.path.filename().string().size() > kLongestName) {
    fail(output, fmt::format("the name is longer than {} bytes", kLongestName));
  }
  const fs::file_status status = fs::status(output.path, error);
  if (!fs::exists(status)) return;
  if (fs::is_directory(status)) fail(output, "is a directory; name a file");
  // Files are replaced by renaming, which would put a file in place of a device.
  if (!fs::is_regular_file(status)) fail(output, "is not a regular file");
  if (::access(output.path.c_str(), W_OK) != 0) {
    fail(output, std::string("cannot be replaced: ") + std::strerror(errno));
  }
}

// Whether two paths are the same file, which need not exist yet.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return a.filename() == b.filename() && fs::equivalent(folder_of(a), folder_of(b), error);
}

}  // namespace

void check_outputs(const std::vector<Output>& outputs, const fs::path& input) {
  std::vector<const Output*> wanted;
  for (const Output& output : outputs) {
    if (!output.path.empty()) wanted.push_back(&output);
  }
  for (const Output* output : wanted) {
    if (!output->path.has_filename()) fail_usage(*output, "is a folder; name a file");
    check_extension(*output);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (input != "-" && same_file(wanted[i]->path, input)) {
      fail_usage(*wanted[i], "is the input file; name another");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!same_file(wanted[i]->path, wanted[j]->path)) continue;
      fail_usage(*wanted[i], "is the file of " + wanted[j]->option + " too; name another");
    }
  }
  for (const Output* output : wanted) check_place(*output);
}

void write_text(const fs::path& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace morsel::cli
