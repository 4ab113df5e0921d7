#include <fmt/format.h>

#include <algorithm>
#include <morsel/error.hpp>
#include <morsel/serve.hpp>

#include "serve/guard.hpp"

namespace morsel {
namespace {

[[noreturn]] void fail(const std::string& message) { throw Error(ErrorCode::kUsage, message); }

void check_token(const std::string& token, const std::string& host) {
  if (token.empty()) {
    if (serve::is_loopback(host)) return;
    fail(fmt::format("host is {}, which others can reach; give a token of 16 or more characters",
                     host));
  }
  const bool printable =
      std::all_of(token.begin(), token.end(), [](char c) { return c > ' ' && c < '\x7f'; });
  if (token.size() < 16 || token.size() > 256 || !printable) {
    fail("token: expected 16 to 256 letters, digits and signs of ASCII, no spaces");
  }
}

template <class Number>
void check_range(const char* name, Number value, Number least, Number most) {
  if (value >= least && value <= most) return;
  fail(fmt::format("{} is {}; it must be {} to {}", name, value, least, most));
}

}  // namespace

void ServeOptions::check() const {
  if (host.empty()) fail("host is empty; give an address or a name of this machine");
  check_token(token, host);
  check_range("port", port, 0, 65535);
  check_range<std::size_t>("most_upload_bytes", most_upload_bytes, 1, std::size_t{1} << 32);
  check_range<std::size_t>("most_upload_points", most_upload_points, 1, 100'000'000);
  check_range("upload_seconds", upload_seconds, 1, 86'400);
  check_range("threads", threads, 0, 1024);
}

}  // namespace morsel
