#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <morsel/error.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "commands.hpp"

namespace morsel::cli {
namespace {

// A signal handler reaches only what is static; both are lock-free.
std::atomic<Progress*> running{nullptr};
std::atomic<bool> writing{false};

void interrupt(int /*signal*/) {
  Progress* const progress = running.load();
  // Nothing has been written before the task, nor while it computes: a second signal need not wait
  // for a stage that looks seldom.
  if (progress == nullptr || (progress->cancelled() && !writing.load())) ::_exit(kInterrupted);
  progress->cancel();
}

}  // namespace

std::string pretty(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void say(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return;
  throw Error(ErrorCode::kOutput,
              std::string("standard output: cannot write: ") + std::strerror(errno));
}

void complain(std::string_view message) {
  std::string line = "morsel: " + std::string(message);
  while (line.ends_with('\n')) line.pop_back();
  // File names may hold anything, also what would steer the terminal.
  const auto control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(line.begin(), line.end(), control, ' ');
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action = {};
    // nohup and background jobs ask for signals to be ignored.
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = interrupt;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

Task::Task(Label label)
    : label_(std::move(label)),
      progress_([this](std::string_view stage, double fraction) { draw(stage, fraction); }),
      on_terminal_(::isatty(STDERR_FILENO) == 1) {
  running.store(&progress_);
}

Task::~Task() {
  running.store(nullptr);
  writing.store(false);
  clear();
}

void Task::begin_writing() {
  writing.store(true);
  clear();
  progress_.check();
}

void Task::draw(std::string_view stage, double fraction) {
  if (!on_terminal_) return;
  const std::lock_guard lock(mutex_);
  const int percent = static_cast<int>(std::floor(100.0 * std::clamp(fraction, 0.0, 1.0)));
  const std::string text = label_ ? label_(stage, fraction) : std::string(stage);
  if (percent == percent_ && text == text_) return;
  percent_ = percent;
  text_ = text;
  drawn_ = true;
  constexpr int kWidth = 30;
  const auto filled = static_cast<std::size_t>(kWidth * percent / 100);
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  fmt::print(stderr, "\r[{}] {:3}% {}\x1b[K", bar, percent, text);
  std::fflush(stderr);
}

void Task::clear() {
  const std::lock_guard lock(mutex_);
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
  drawn_ = false;
}

}  // namespace morsel::cli
