// Files into a database, several at once.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <utility>

#include "base/threads.hpp"
#include "io/source.hpp"
#include "store/rows.hpp"

namespace morsel {
namespace {

// What became of one file.
struct Outcome {
  std::optional<Change> change;
  bool without_inside = false;
  std::string failure;  // why there is no change
};

ShapeInfo info_of(const Database& database, const ShapeFile& file) {
  ShapeInfo info = database.find(file.name).value_or(ShapeInfo{file.name, {}, {}, {}});
  if (file.class_name) info.class_name = *file.class_name;
  info.tags.insert(info.tags.end(), file.tags.begin(), file.tags.end());
  info.source = file.path.lexically_normal().string();
  return store::checked(std::move(info));
}

// Segments unless the content is known. What the file has wrong is an outcome; what the database
// has wrong is thrown.
Outcome index_file(Database& database, const ShapeFile& file, const IndexOptions& options,
                   const Progress& progress) {
  Outcome outcome;
  ShapeInfo info;
  std::string content;
  std::optional<PointCloud> cloud;
  std::optional<ShapeData> data;
  const auto attempt = [&](const auto& work) {
    try {
      work();
      return true;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kCancelled) throw;
      outcome.failure = error.what();
    } catch (const std::bad_alloc&) {
      outcome.failure = "there is not enough memory for it";
    } catch (const std::exception& error) {
      outcome.failure = fmt::format("internal error, please report it: {}", error.what());
    }
    return false;
  };
  info = info_of(database, file);
  const bool read = attempt([&] {
    cloud = read_points(file.path, options.sample);
    content = content_key(cloud->points, options.segment);
  });
  if (!read) return outcome;
  outcome.change = database.put_known(info, content);
  if (outcome.change) return outcome;
  const bool made = attempt([&] {
    const Segmentation result = segment(cloud->points, options.segment, &progress);
    data = make_shape_data(result, options.segment, content);
  });
  if (!made) return outcome;
  outcome.without_inside = data->sketch.part_count == 0;
  outcome.change = database.put(info, *data);
  return outcome;
}

// Two files under one name would replace each other.
std::vector<Outcome> check_names(std::span<const ShapeFile> files) {
  std::vector<Outcome> outcomes(files.size());
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto [at, is_new] = first.emplace(files[i].name, i);
    if (!is_new) {
      outcomes[i].failure =
          fmt::format("its name {} is that of {} too", io::in_quotes(files[i].name),
                      io::display_name(files[at->second].path));
      continue;
    }
    try {
      (void)store::checked({files[i].name, files[i].class_name.value_or(""), files[i].tags, {}});
    } catch (const Error& error) {
      outcomes[i].failure = error.what();
    }
  }
  return outcomes;
}

// Calls body(i) for each i below `count` in about that order on `threads` threads. The first
// exception stops all and is thrown.
template <class Body>
void in_parallel(std::size_t count, int threads, const Body& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 1; i < threads; ++i) workers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

IndexReport summarize(std::span<const ShapeFile> files, const std::vector<Outcome>& outcomes) {
  IndexReport report;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    if (!outcome.change) report.failures.push_back({files[i].path, outcome.failure});
    if (outcome.change == Change::kAdded) ++report.added;
    if (outcome.change == Change::kReplaced) ++report.replaced;
    if (outcome.change == Change::kUnchanged) ++report.unchanged;
    if (outcome.without_inside) ++report.without_inside;
  }
  return report;
}

}  // namespace

IndexReport index_files(Database& database, std::span<const ShapeFile> files,
                        const IndexOptions& options, const Progress* progress) {
  options.segment.check();
  options.sample.check();
  // One file a thread needs no waiting between threads; only few large files share them.
  const int threads = resolve_threads(options.segment.threads);
  const int at_once =
      std::clamp(static_cast<int>(std::min<std::size_t>(files.size(), 1024)), 1, threads);
  IndexOptions one = options;
  one.segment.threads = std::max(1, threads / at_once);
  std::vector<Outcome> outcomes = check_names(files);
  std::atomic<std::size_t> done{0};
  const Progress silent(progress);
  try {
    in_parallel(files.size(), at_once, [&](std::size_t i) {
      silent.check();
      if (outcomes[i].failure.empty()) {
        outcomes[i] = index_file(database, files[i], one, silent);
        if (!outcomes[i].change) database.put_failure(files[i].name, outcomes[i].failure);
      }
      const double share = static_cast<double>(++done) / static_cast<double>(files.size());
      if (progress != nullptr) progress->report("index", share);
    });
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kCancelled) throw;
    throw Error(ErrorCode::kCancelled,
                fmt::format("cancelled with {} of {} files done; run it again for the rest",
                            done.load(), files.size()));
  }
  return summarize(files, outcomes);
}

}  // namespace morsel
