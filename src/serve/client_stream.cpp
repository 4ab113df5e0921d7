#include "serve/client_stream.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace morsel::serve {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kIdleTime{5};             // between requests
constexpr seconds kHeadTime{10};            // for a request's head
constexpr seconds kBodyTime{60};            // for its body
constexpr seconds kWriteTime{10};           // without the client taking anything …
constexpr std::size_t kLeastRate = 50'000;  // … and bytes a second for the whole of a long answer
constexpr seconds kFarewellTime{2};
constexpr milliseconds kLook{200};  // how often to look whether the server is to stop
constexpr std::size_t kMostHead = 64 * 1024;

}  // namespace

ClientStream::ClientStream(int socket, const std::atomic<bool>& stopping)
    : socket_(socket), stopping_(stopping) {}

bool ClientStream::wait(short events, Clock::time_point deadline, bool also_stopping) const {
  while (also_stopping || !stopping_.load()) {
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
    if (left <= milliseconds(0)) return false;
    pollfd entry{socket_, events, 0};
    const int found = ::poll(&entry, 1, static_cast<int>(std::min(left, kLook).count()));
    if (found > 0) return true;
    if (found < 0 && errno != EINTR) return false;
  }
  return false;
}

bool ClientStream::wait_for_request() {
  in_head_ = true;
  head_left_ = kMostHead;
  const bool here = begin_ < end_ || wait(POLLIN, Clock::now() + kIdleTime, false);
  deadline_ = Clock::now() + kHeadTime;
  return here;
}

void ClientStream::begin_body() {
  in_head_ = false;
  deadline_ = Clock::now() + kBodyTime;
}

ssize_t ClientStream::read(char* to, std::size_t size) {
  if (begin_ == end_) {
    if (!wait(POLLIN, deadline_, false)) return -1;
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (got <= 0) return got;
    begin_ = 0;
    end_ = static_cast<std::size_t>(got);
  }
  std::size_t count = std::min(size, end_ - begin_);
  if (in_head_) {
    if (head_left_ == 0) return -1;
    count = std::min(count, head_left_);
    head_left_ -= count;
  }
  std::memcpy(to, buffer_.data() + begin_, count);
  begin_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t ClientStream::write(const char* from, std::size_t size) {
  const auto deadline = Clock::now() + kWriteTime + seconds(size / kLeastRate);
  std::size_t sent = 0;
  while (sent < size) {
    if (!wait(POLLOUT, std::min(deadline, Clock::now() + kWriteTime), true)) return -1;
    const ssize_t took = ::send(socket_, from + sent, size - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (took > 0) sent += static_cast<std::size_t>(took);
    if (took < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) return -1;
  }
  return static_cast<ssize_t>(size);
}

void ClientStream::finish() {
  ::shutdown(socket_, SHUT_WR);
  const auto deadline = Clock::now() + kFarewellTime;
  while (wait(POLLIN, deadline, false)) {
    if (::recv(socket_, buffer_.data(), buffer_.size(), 0) <= 0) return;
  }
}

bool ClientStream::is_readable() const { return begin_ < end_ || wait(POLLIN, deadline_, false); }

bool ClientStream::is_writable() const {
  char byte = 0;
  const bool gone = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  return !gone && wait(POLLOUT, Clock::now() + kWriteTime, true);
}

void ClientStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

void ClientStream::get_local_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

}  // namespace morsel::serve
