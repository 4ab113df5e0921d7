// One connection, read and written under deadlines: a client that is slow, silent or endless costs
// a thread for a bounded time and bounded memory.
#pragma once

#include <httplib.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>

namespace morsel::serve {

class ClientStream final : public httplib::Stream {
 public:
  /// Does not own the socket. When `stopping` becomes true, no more is read.
  ClientStream(int socket, const std::atomic<bool>& stopping);

  /// Waits for the first byte of a request, some seconds; false when none came.
  [[nodiscard]] bool wait_for_request();
  /// The head of the request has been read: the time for its body begins.
  void begin_body();
  /// Tells the client that all is said and reads what it still sends for a moment: it would not
  /// see the answer otherwise.
  void finish();

  [[nodiscard]] bool is_readable() const override;
  /// False also when the client has gone.
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool wait(short events, Clock::time_point deadline, bool also_stopping) const;

  int socket_;
  const std::atomic<bool>& stopping_;
  Clock::time_point deadline_;
  std::size_t head_left_ = 0;  // bytes that the head may still have
  bool in_head_ = true;
  std::array<char, 8192> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace morsel::serve
