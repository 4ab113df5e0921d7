// What the person at the terminal sees and presses: results, messages, the progress bar, Ctrl-C.
#pragma once

#include <functional>
#include <morsel/progress.hpp>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace morsel::cli {

/// Prints to standard output at once. Throws Error(kOutput) when that fails.
void say(std::string_view text);

/// JSON as it is shown: indented, bytes that are no UTF-8 replaced.
[[nodiscard]] std::string pretty(const nlohmann::ordered_json& json);

/// Prints "morsel: MESSAGE" as one line on standard error, whatever `message` holds.
void complain(std::string_view message);

/// From now on SIGINT, SIGTERM and SIGHUP end the program with status kInterrupted: at once while
/// there is no Task, through the task's Progress while there is one. Ignored signals stay ignored.
void catch_interrupts();

/// Long work: shows a bar while it runs, if standard error is a terminal, and lets a signal cancel
/// it. At most one at a time.
class Task {
 public:
  /// What stands beside the bar, made from the stage and the share of the work that is done.
  using Label = std::function<std::string(std::string_view stage, double fraction)>;

  explicit Task(Label label = {});
  ~Task();
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  [[nodiscard]] const Progress& progress() const { return progress_; }

  /// Ends the computing part: takes the bar away, and a second signal no longer ends the program
  /// at once, so that a file being written is finished or removed.
  void begin_writing();

 private:
  void draw(std::string_view stage, double fraction);
  void clear();

  Label label_;
  Progress progress_;
  std::mutex mutex_;  // stages may report from any of their threads
  bool on_terminal_ = false;
  bool drawn_ = false;
  int percent_ = -1;
  std::string text_;
};

}  // namespace morsel::cli
