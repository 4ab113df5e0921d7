#include "serve/http_server.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <string_view>
#include <utility>

#include "serve/client_stream.hpp"

namespace morsel::serve {
namespace {

constexpr std::size_t kThreads = 128;          // connections that are answered at once
constexpr std::size_t kMostConnections = 512;  // those that wait for a thread included
constexpr std::size_t kRequestsOfConnection = 1000;
constexpr std::string_view kBusy =
    "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Type: application/json\r\n"
    "Retry-After: 1\r\nContent-Length: 66\r\n\r\n"
    "{\"error\":\"Too many connections are open; try again in a moment.\"}\n";

thread_local bool turned_away = false;  // the connection at hand is one too many

// Called on the one thread that accepts, which alone may stop the server.
class Connections final : public httplib::ThreadPool {
 public:
  explicit Connections(HttpServer& server) : ThreadPool(kThreads), server_(server) {}

  void enqueue(std::function<void()> answer) override {
    on_idle();
    if (open_.load() >= kMostConnections || server_.stopping()) {
      turned_away = true;
      answer();  // at once, on this thread
      turned_away = false;
      return;
    }
    ++open_;
    ThreadPool::enqueue([this, answer = std::move(answer)] {
      answer();
      --open_;
    });
  }

  void on_idle() override {
    if (server_.stopping()) server_.stop();
  }

 private:
  HttpServer& server_;
  std::atomic<std::size_t> open_{0};
};

// No second server on the same port, as SO_REUSEPORT would allow.
void set_options(int socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

HttpServer::HttpServer() {
  new_task_queue = [this] { return new Connections(*this); };
  set_idle_interval(std::chrono::milliseconds(100));
  set_socket_options(set_options);
  set_keep_alive_max_count(kRequestsOfConnection);
  set_tcp_nodelay(true);
}

HttpServer::~HttpServer() {
  if (svr_sock_ != INVALID_SOCKET) ::close(svr_sock_);  // never listened
}

bool HttpServer::process_and_close_socket(socket_t socket) {
  ClientStream stream(socket, stopping_);
  if (turned_away) {
    ::send(socket, kBusy.data(), kBusy.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    ::shutdown(socket, SHUT_WR);
    ::close(socket);
    return false;
  }
  bool more = true;
  for (std::size_t left = kRequestsOfConnection; more && stream.wait_for_request(); --left) {
    bool understood = false;
    bool with_body = false;
    bool closed = false;
    const auto begin = [&](httplib::Request& request) {
      understood = true;
      stream.begin_body();
      with_body = request.has_header("Content-Length") || request.has_header("Transfer-Encoding");
      // What is left of a body that was refused would be taken for the next request.
      if (with_body) {
        request.headers.erase("Connection");
        request.set_header("Connection", "close");
      }
      // Nothing here is worth packing or serving in pieces.
      request.headers.erase("Accept-Encoding");
      request.headers.erase("Range");
      request.ranges.clear();
    };
    const bool answered = process_request(stream, left == 1 || stopping_.load(), closed, begin);
    more = answered && understood && !with_body && !closed && left > 1;
  }
  stream.finish();
  ::close(socket);
  return true;
}

}  // namespace morsel::serve
