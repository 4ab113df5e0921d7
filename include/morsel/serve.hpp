// morsel: a database of shapes in the browser, served from this machine.
#pragma once

#include <cstddef>
#include <memory>
#include <morsel/database.hpp>
#include <string>

namespace morsel {

/// Who may ask, and how much of the machine a visitor may take.
struct ServeOptions {
  std::string host =
      "127.0.0.1";         ///< address to listen on; all but this machine's own need a token
  int port = 8642;         ///< 0 … 65535; 0: any that is free
  std::string token = {};  ///< empty: none; else 16 … 256 printable ASCII characters
  std::size_t most_upload_bytes = std::size_t{64} << 20;  ///< of one file, 1 … 2^32
  std::size_t most_upload_points = 500'000;  ///< of one file, about 1 kB of memory each
  int upload_seconds = 120;                  ///< that segmenting one may take, 1 … 86400
  int threads = 0;                           ///< of one segmentation; 0: all cores

  /// Throws Error(kUsage) that names field, value and what would be right.
  void check() const;
};

/// Whether this build holds the web app; one made without Node.js does not.
[[nodiscard]] bool has_web_app() noexcept;

/// Serves a page and the JSON API behind it (docs/serve.md, docs/openapi.json) over HTTP/1.1. Reads
/// the database and no other file; writes nothing. Other sites' pages are refused.
class Server {
 public:
  /// Listens from now on; `database` must outlive it. Throws Error(kUsage) for bad options or
  /// without a web app, Error(kResource) when the address cannot be had.
  explicit Server(const Database& database, const ServeOptions& options = {});
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server();

  /// "http://127.0.0.1:8642/"
  [[nodiscard]] const std::string& address() const;

  /// Answers until stop(); then finishes what is being answered, some seconds at most.
  void run();
  /// Safe from any thread, also before run().
  void stop() noexcept;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace morsel
