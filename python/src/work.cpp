#include "work.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace morsel::python {
namespace {

// How long Ctrl-C may go unnoticed.
constexpr std::chrono::milliseconds kPatience{50};

struct Report {
  std::string stage;
  double fraction = 0.0;
};

// From the working threads to the calling one.
class Mailbox {
 public:
  void post(std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex_);
    reports_.push_back({std::string(stage), fraction});
    changed_.notify_one();
  }
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_one();
  }
  // Returns what came meanwhile, after kPatience at the latest, and whether more can come.
  std::pair<std::vector<Report>, bool> wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kPatience, [&] { return closed_ || !reports_.empty(); });
    return {std::exchange(reports_, {}), !closed_};
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Report> reports_;
  bool closed_ = false;
};

void deliver(const std::vector<Report>& reports, const py::object& callback) {
  for (const Report& report : reports) callback(report.stage, report.fraction);
}

void raise_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// Serves the calling thread until the work is done; what Python code raises cancels the work.
std::exception_ptr attend(Mailbox& mailbox, const py::object& callback, Progress& progress) {
  std::exception_ptr raised;
  for (bool open = true; open;) {
    std::vector<Report> reports;
    {
      const py::gil_scoped_release release;
      std::tie(reports, open) = mailbox.wait();
    }
    if (raised) continue;
    try {
      deliver(reports, callback);
      raise_signals();
    } catch (...) {
      raised = std::current_exception();
      progress.cancel();
    }
  }
  return raised;
}

}  // namespace

void run_cancellable(const py::object& callback,
                     const std::function<void(const Progress& progress)>& work) {
  Mailbox mailbox;
  Progress::Callback post;
  if (!callback.is_none()) {
    post = [&](std::string_view stage, double fraction) { mailbox.post(stage, fraction); };
  }
  Progress progress(post);
  std::exception_ptr failure;
  std::thread worker([&] {
    try {
      work(progress);
    } catch (...) {
      failure = std::current_exception();
    }
    mailbox.close();
  });
  const std::exception_ptr raised = attend(mailbox, callback, progress);
  worker.join();
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace morsel::python
