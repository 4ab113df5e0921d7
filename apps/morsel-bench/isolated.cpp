#include "isolated.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <morsel/error.hpp>

namespace morsel::bench {
namespace {

using Job = std::function<nlohmann::json(std::size_t)>;

struct Child {
  pid_t process = 0;
  int pipe = -1;  // the end that is read
  std::size_t index = 0;
  std::vector<std::uint8_t> bytes;
};

[[noreturn]] void fail(const char* what) {
  throw Error(ErrorCode::kResource, fmt::format("{}: {}", what, std::strerror(errno)));
}

void write_all(int file, const std::vector<std::uint8_t>& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = write(file, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;  // the parent is gone, and nobody reads an error
    written += static_cast<std::size_t>(count);
  }
}

// The result goes through the pipe as {"value": …} or {"error": …}. Leaves without running the
// parent's exit handlers.
[[noreturn]] void run_child(int pipe, const Job& job, std::size_t index) {
  nlohmann::json message;
  try {
    message["value"] = job(index);
  } catch (const std::exception& error) {
    message = {{"error", error.what()}};
  } catch (...) {
    message = {{"error", "threw something that is not a std::exception"}};
  }
  write_all(pipe, nlohmann::json::to_cbor(message));
  _exit(0);
}

Child start_child(const Job& job, std::size_t index) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("cannot make a pipe");
  std::fflush(nullptr);  // or the child holds a copy of what is not written yet
  const pid_t process = fork();
  if (process < 0) fail("cannot start a process");
  if (process == 0) {
    close(ends[0]);
    run_child(ends[1], job, index);
  }
  close(ends[1]);
  return {.process = process, .pipe = ends[0], .index = index, .bytes = {}};
}

// False at the end of the pipe, that is, when the child has ended.
bool read_some(Child& child) {
  std::array<std::uint8_t, 65536> buffer{};
  const ssize_t count = read(child.pipe, buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR;
  child.bytes.insert(child.bytes.end(), buffer.begin(), buffer.begin() + count);
  return count > 0;
}

Outcome finish(const Child& child) {
  close(child.pipe);
  int status = 0;
  while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return {.value = {}, .error = fmt::format("crashed: {}", strsignal(number))};
  }
  auto message = nlohmann::json::from_cbor(child.bytes, true, false);
  if (message.is_object() && message.contains("value")) {
    return {.value = std::move(message["value"]), .error = {}};
  }
  if (message.is_object() && message.contains("error")) {
    return {.value = {}, .error = message["error"].get<std::string>()};
  }
  const int exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : status;
  return {.value = {}, .error = fmt::format("ended with status {}, no result", exit_status)};
}

void wait_for_any(const std::vector<Child>& children, std::vector<pollfd>& polled) {
  polled.clear();
  for (const Child& child : children) polled.push_back({child.pipe, POLLIN, 0});
  while (poll(polled.data(), polled.size(), -1) < 0) {
    if (errno != EINTR) fail("cannot wait for processes");
  }
}

void show_progress(std::size_t done, std::size_t count) {
  if (isatty(STDERR_FILENO) == 0) return;
  fmt::print(stderr, "\r{} of {}{}", done, count, done == count ? "\n" : "");
}

}  // namespace

std::vector<Outcome> run_isolated(std::size_t count, int workers, const Job& job) {
  std::vector<Outcome> outcomes(count);
  std::vector<Child> children;
  std::vector<pollfd> polled;
  const auto limit = static_cast<std::size_t>(std::max(workers, 1));
  std::size_t started = 0;
  std::size_t done = 0;
  while (done < count) {
    while (started < count && children.size() < limit) {
      children.push_back(start_child(job, started));
      ++started;
    }
    wait_for_any(children, polled);
    for (std::size_t i = children.size(); i-- > 0;) {
      if (polled[i].revents == 0 || read_some(children[i])) continue;
      outcomes[children[i].index] = finish(children[i]);
      children.erase(children.begin() + static_cast<std::ptrdiff_t>(i));
      ++done;
      show_progress(done, count);
    }
  }
  return outcomes;
}

std::vector<std::vector<nlohmann::json>> run_in_turns(
    std::size_t contenders, std::size_t runs,
    const std::function<nlohmann::json(std::size_t, std::size_t)>& job) {
  const auto contender_of = [&](std::size_t i) { return (i / contenders + i) % contenders; };
  auto outcomes = run_isolated(contenders * runs, 1,
                               [&](std::size_t i) { return job(contender_of(i), i / contenders); });
  std::vector<std::vector<nlohmann::json>> values(contenders);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (!outcomes[i].error.empty()) throw Error(ErrorCode::kResource, outcomes[i].error);
    values[contender_of(i)].push_back(std::move(outcomes[i].value));
  }
  return values;
}

}  // namespace morsel::bench
