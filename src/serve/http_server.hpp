// cpp-httplib's server with bounds that it does not have: connections, deadlines, size of a head.
#pragma once

#include <httplib.h>

#include <atomic>
#include <functional>

namespace morsel::serve {

class HttpServer final : public httplib::Server {
 public:
  HttpServer();
  ~HttpServer() override;

  /// From any thread, also before listening: what waits for a client ends, and
  /// listen_after_bind() returns soon, when all that is being answered has been.
  void begin_stop() noexcept { stopping_.store(true); }
  [[nodiscard]] const std::atomic<bool>& stopping() const { return stopping_; }

 private:
  bool process_and_close_socket(socket_t socket) override;

  std::atomic<bool> stopping_{false};
};

}  // namespace morsel::serve
