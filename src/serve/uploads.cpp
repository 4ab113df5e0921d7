#include "serve/uploads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <morsel/error.hpp>
#include <morsel/morsel.hpp>
#include <new>
#include <utility>

#include "html/shape_json.hpp"
#include "serve/guard.hpp"

namespace morsel::serve {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kWorkers = 2;     // files segmented at once
constexpr std::size_t kMostOpen = 6;    // those that wait included
constexpr std::size_t kKept = 12;       // in all, finished ones included
constexpr std::size_t kReadAtOnce = 4;  // files of the largest size that may be read at once

}  // namespace

struct Uploads::Job {
  UploadState state;
  std::string bytes;
  std::shared_ptr<const Uploaded> result;
  std::optional<Clock::time_point> overdue;  // while it is worked on
  bool took_too_long = false;
  Progress progress;

  explicit Job(Progress::Callback report) : progress(std::move(report)) {}
};

Uploads::Uploads(const ServeOptions& options) : options_(options) {
  for (std::size_t i = 0; i < kWorkers; ++i) threads_.emplace_back([this] { work(); });
  threads_.emplace_back([this] { watch(); });
}

Uploads::~Uploads() {
  stop();
  threads_.clear();  // joins
}

void Uploads::stop() {
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  for (const auto& [id, job] : jobs_) job->progress.cancel();
  changed_.notify_all();
}

Uploads::Room::~Room() {
  const std::lock_guard lock(uploads_.mutex_);
  uploads_.reading_ -= reserved_;
}

bool Uploads::Room::add(const char* data, std::size_t size) {
  too_large_ = bytes_.size() + size > uploads_.options_.most_upload_bytes;
  if (too_large_) return false;
  {
    const std::lock_guard lock(uploads_.mutex_);
    if (uploads_.reading_ + size > kReadAtOnce * uploads_.options_.most_upload_bytes) return false;
    uploads_.reading_ += size;
    reserved_ += size;
  }
  bytes_.append(data, size);
  return true;
}

std::optional<std::string> Uploads::add(std::string name, std::string bytes) {
  const std::lock_guard lock(mutex_);
  const auto open = std::count_if(jobs_.begin(), jobs_.end(), [](const auto& entry) {
    return is_open(entry.second->state.stage);
  });
  if (stopping_ || static_cast<std::size_t>(open) >= kMostOpen) return std::nullopt;
  if (jobs_.size() >= kKept) drop_oldest();
  std::string id = random_id();
  const auto job = std::make_shared<Job>([this, id](std::string_view step, double fraction) {
    const std::lock_guard inner(mutex_);
    const auto at = jobs_.find(id);
    if (at == jobs_.end()) return;
    UploadState& state = at->second->state;
    state.step = step;
    state.fraction = fraction;
    ++state.version;
    changed_.notify_all();
  });
  job->state.name = std::move(name);
  job->state.version = 1;
  job->bytes = std::move(bytes);
  jobs_.emplace(id, job);
  order_.push_back(id);
  changed_.notify_all();
  return id;
}

void Uploads::drop_oldest() {
  const auto done = std::find_if(order_.begin(), order_.end(), [&](const std::string& id) {
    return !is_open(jobs_.at(id)->state.stage);
  });
  if (done == order_.end()) return;
  jobs_.erase(*done);
  order_.erase(done);
}

bool Uploads::cancel(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto at = jobs_.find(id);
  if (at == jobs_.end()) return false;
  Job& job = *at->second;
  job.progress.cancel();
  if (job.state.stage == Stage::kWaiting) {
    job.state.stage = Stage::kCancelled;
    job.bytes = {};
    ++job.state.version;
    changed_.notify_all();
  }
  return true;
}

std::optional<UploadState> Uploads::state(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto at = jobs_.find(id);
  if (at == jobs_.end()) return std::nullopt;
  return at->second->state;
}

std::optional<UploadState> Uploads::wait(const std::string& id, std::uint64_t version,
                                         std::chrono::milliseconds most) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, most, [&] {
    const auto at = jobs_.find(id);
    return stopping_ || at == jobs_.end() || at->second->state.version > version;
  });
  const auto at = jobs_.find(id);
  if (stopping_ || at == jobs_.end()) return std::nullopt;
  return at->second->state;
}

std::shared_ptr<const Uploaded> Uploads::result(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto at = jobs_.find(id);
  return at == jobs_.end() ? nullptr : at->second->result;
}

void Uploads::work() {
  while (true) {
    std::shared_ptr<Job> next;
    {
      std::unique_lock lock(mutex_);
      const auto find = [&] {
        for (const std::string& id : order_) {
          if (jobs_.at(id)->state.stage == Stage::kWaiting) return jobs_.at(id);
        }
        return std::shared_ptr<Job>();
      };
      changed_.wait(lock, [&] { return stopping_ || (next = find()) != nullptr; });
      if (stopping_) return;
      next->state.stage = Stage::kWorking;
      next->overdue = Clock::now() + std::chrono::seconds(options_.upload_seconds);
      ++next->state.version;
    }
    run(next);
  }
}

// Cancels what takes too long.
void Uploads::watch() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    changed_.wait_for(lock, std::chrono::seconds(1));
    for (const auto& [id, job] : jobs_) {
      if (!job->overdue || Clock::now() < *job->overdue) continue;
      job->took_too_long = true;
      job->progress.cancel();
    }
  }
}

namespace {

std::shared_ptr<const Uploaded> segmented(const std::string& name, std::string bytes,
                                          const ServeOptions& options, const Progress& progress) {
  progress.report("read", 0.0);
  const PointCloud cloud = parse_points(std::move(bytes), name);
  if (cloud.points.size() > options.most_upload_points) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: has {} points; this server takes at most {}. Thin it out, or use "
                            "morsel segment and morsel search.",
                            name, cloud.points.size(), options.most_upload_points));
  }
  SegmentOptions segment_options;
  segment_options.threads = options.threads;
  const Segmentation result = segment(cloud.points, segment_options, &progress);
  auto uploaded = std::make_shared<Uploaded>();
  uploaded->name = name;
  uploaded->message = result.message;
  try {
    uploaded->data = make_shape_data(result, segment_options, {});
  } catch (const Error& error) {
    throw Error(error.code(), name + ": " + error.what());
  }
  MergeTree tree = result.tree;
  tree.piece_of_point.resize(cloud.points.size(), kNoBasin);  // no solid: no tree
  uploaded->parts = shape_json(cloud.points, tree, {.name = name});
  return uploaded;
}

}  // namespace

void Uploads::run(const std::shared_ptr<Job>& job) {
  try {
    auto result = segmented(job->state.name, std::move(job->bytes), options_, job->progress);
    job->progress.check();
    const std::string message = result->message;
    {
      const std::lock_guard lock(mutex_);
      job->result = std::move(result);
    }
    end(*job, Stage::kDone, message);
  } catch (const Error& error) {
    const bool cancelled = error.code() == ErrorCode::kCancelled;
    if (cancelled && job->took_too_long) {
      end(*job, Stage::kFailed,
          fmt::format("{}: took longer than {} seconds; give fewer points", job->state.name,
                      options_.upload_seconds));
    } else {
      end(*job, cancelled ? Stage::kCancelled : Stage::kFailed, cancelled ? "" : error.what());
    }
  } catch (const std::bad_alloc&) {
    end(*job, Stage::kFailed, "There is not enough memory for this file; give fewer points.");
  } catch (const std::exception& error) {
    end(*job, Stage::kFailed, fmt::format("internal error, please report it: {}", error.what()));
  }
}

void Uploads::end(Job& job, Stage stage, const std::string& message) {
  const std::lock_guard lock(mutex_);
  job.bytes = {};
  job.overdue.reset();
  job.state.stage = stage;
  job.state.message = message;
  if (stage == Stage::kDone) job.state.fraction = 1.0;
  ++job.state.version;
  changed_.notify_all();
}

}  // namespace morsel::serve
