// Requests to `morsel serve`, over a real socket.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <morsel/serve.hpp>
#include <thread>

#include "base/test_folder.hpp"
#include "base/test_shapes.hpp"
#include "targets.hpp"

namespace morsel::fuzz {
namespace {

constexpr std::string_view kAddress = "HOST";  // in the bytes: the server's own

// A server of two shapes that takes small files.
class Running {
 public:
  [[nodiscard]] const std::string& host() const { return host_; }

 private:
  static Database filled(const std::filesystem::path& file) {
    Database database = Database::open(file, Access::kCreate);
    SegmentOptions options;
    options.threads = 1;
    for (const std::uint64_t seed : {1U, 2U}) {
      const auto points = shapes::dumbbell(600, 0.4, seed);
      database.put(
          {"shape " + std::to_string(seed), "dumbbell", {"tag"}, "a.xyz"},
          make_shape_data(segment(points, options), options, content_key(points, options)));
    }
    return database;
  }

  TestFolder folder_;
  Database database_ = filled(folder_.path() / "shapes.db");
  Server server_{database_,
                 {.port = 0, .most_upload_bytes = 4096, .most_upload_points = 100, .threads = 1}};
  // "http://127.0.0.1:8642/"
  std::string host_ = server_.address().substr(7, server_.address().size() - 8);
  std::jthread thread_{[this] { server_.run(); }};
  struct Stop {
    Server& server;
    ~Stop() { server.stop(); }
  } stop_{server_};  // before the thread is waited for
};

std::string with_address(std::string bytes, const std::string& host) {
  for (std::size_t at = 0; (at = bytes.find(kAddress, at)) != std::string::npos;) {
    bytes.replace(at, kAddress.size(), host);
    at += host.size();
  }
  return bytes;
}

int connected(const std::string& host) {
  const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(host.substr(host.find(':') + 1))));
  const bool there = ::connect(client, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  require(there, "the server takes a connection");
  return client;
}

// All that the server answers to these bytes and no more.
std::string answer(const std::string& host, const std::string& bytes) {
  const int client = connected(host);
  // The server may have had enough before it has all.
  static_cast<void>(::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL));
  ::shutdown(client, SHUT_WR);
  std::string text;
  std::array<char, 65536> buffer{};
  for (ssize_t got = 0; (got = ::recv(client, buffer.data(), buffer.size(), 0)) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  ::close(client);
  return text;
}

}  // namespace

void run_http(std::string_view /*name*/, std::string bytes) {
  static const Running running;
  const std::string text = answer(running.host(), with_address(std::move(bytes), running.host()));
  require(text.empty() || text.starts_with("HTTP/1.1 "), "an answer is HTTP");
  require(!text.starts_with("HTTP/1.1 500"), "bad requests are no internal errors");
}

}  // namespace morsel::fuzz
