// Files that visitors hand in: segmented one after the other, the last few kept, none on the disk.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/serve.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace morsel::serve {

/// What is kept of a file: enough to show and compare it.
struct Uploaded {
  std::string name;
  std::string message;  ///< what segment() says of it
  ShapeData data;       ///< without a thumbnail
  std::string parts;    ///< shape_json
};

enum class Stage { kWaiting, kWorking, kDone, kFailed, kCancelled };

/// Whether more is to come.
[[nodiscard]] inline bool is_open(Stage stage) {
  return stage == Stage::kWaiting || stage == Stage::kWorking;
}

/// How far a file has come.
struct UploadState {
  Stage stage = Stage::kWaiting;
  std::string name;
  std::string step;           ///< of segment(), while working
  double fraction = 0.0;      ///< of all work
  std::string message;        ///< of segment() when done, why when failed
  std::uint64_t version = 0;  ///< grows with every change
};

class Uploads {
 public:
  explicit Uploads(const ServeOptions& options);
  Uploads(const Uploads&) = delete;
  Uploads& operator=(const Uploads&) = delete;
  ~Uploads();

  /// Room for a body that is about to be read; given back when this goes.
  class Room {
   public:
    explicit Room(Uploads& uploads) : uploads_(uploads) {}
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;
    ~Room();

    /// False when the file is too large or all files being read together are.
    [[nodiscard]] bool add(const char* data, std::size_t size);
    [[nodiscard]] bool too_large() const { return too_large_; }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

   private:
    Uploads& uploads_;
    std::string bytes_;
    std::size_t reserved_ = 0;
    bool too_large_ = false;
  };

  /// Lines a file up to be segmented; returns its id, or nothing when too many wait already.
  [[nodiscard]] std::optional<std::string> add(std::string name, std::string bytes);
  /// False when there is no such upload. One that is worked on ends soon after.
  bool cancel(const std::string& id);
  [[nodiscard]] std::optional<UploadState> state(const std::string& id) const;
  /// As state(), after waiting for one newer than `version`, at most `most`.
  [[nodiscard]] std::optional<UploadState> wait(const std::string& id, std::uint64_t version,
                                                std::chrono::milliseconds most) const;
  /// Nothing unless done.
  [[nodiscard]] std::shared_ptr<const Uploaded> result(const std::string& id) const;
  /// Cancels everything; waits for none of it.
  void stop();

 private:
  struct Job;

  void work();
  void watch();
  void run(const std::shared_ptr<Job>& job);
  void end(Job& job, Stage stage, const std::string& message);
  void drop_oldest();

  const ServeOptions options_;
  mutable std::mutex mutex_;  // guards all below
  mutable std::condition_variable changed_;
  bool stopping_ = false;
  std::size_t reading_ = 0;  // bytes of files that are being read
  std::map<std::string, std::shared_ptr<Job>> jobs_;
  std::deque<std::string> order_;  // of ids, the oldest first
  std::vector<std::jthread> threads_;
};

}  // namespace morsel::serve
