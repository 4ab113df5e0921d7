#include "serve/guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>

#include "base/lower_case.hpp"

namespace morsel::serve {
namespace {

bool is_any_address(std::string_view host) { return host == "0.0.0.0" || host == "::"; }

std::string cookie_name(int port) { return fmt::format("morsel-{}", port); }

// The value of a cookie in "a=1; b=2".
std::string_view cookie_value(std::string_view cookies, std::string_view name) {
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    std::string_view one = cookies.substr(0, end);
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (one.size() > name.size() && one.starts_with(name) && one[name.size()] == '=') {
      return one.substr(name.size() + 1);
    }
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
  }
  return {};
}

}  // namespace

bool is_loopback(std::string_view host) {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const char mine = a.empty() ? '\0' : a[i % a.size()];
    different |= static_cast<unsigned char>(mine) ^ static_cast<unsigned char>(b[i]);
  }
  return different == 0;
}

std::string in_url(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

std::string random_id() {
  std::random_device device;  // the kernel's generator
  std::string id;
  for (int i = 0; i < 4; ++i) id += fmt::format("{:08x}", device());
  return id;
}

Guard::Guard(std::string host, int port, std::string token)
    : host_(std::move(host)), port_(port), token_(std::move(token)), session_(random_id()) {}

std::optional<Refusal> Guard::check_page(const Caller& caller) const {
  const std::string asked = lower_case(caller.host);
  // Behind any address any name may be right, and a token is needed.
  if (is_any_address(host_) && !asked.empty()) return std::nullopt;
  const auto is = [&](const std::string& name) {
    return asked == fmt::format("{}:{}", in_url(name), port_) ||
           (port_ == 80 && asked == in_url(name));
  };
  if (is(lower_case(host_))) return std::nullopt;
  if (is_loopback(host_)) {
    for (const char* name : {"localhost", "127.0.0.1", "::1"}) {
      if (is(name)) return std::nullopt;
    }
  }
  return Refusal{403,
                 fmt::format("This address does not answer under that name; open http://{}:{}/",
                             in_url(host_), port_)};
}

std::optional<Refusal> Guard::check_site(const Caller& caller) const {
  if (auto refusal = check_page(caller)) return refusal;
  const bool own_origin = caller.origin.empty() ||
                          lower_case(caller.origin) == "http://" + lower_case(caller.host) ||
                          lower_case(caller.origin) == "https://" + lower_case(caller.host);
  const bool own_site = caller.fetch_site.empty() || caller.fetch_site == "same-origin" ||
                        caller.fetch_site == "none";
  if (own_origin && own_site) return std::nullopt;
  return Refusal{403, "Requests from pages of other sites are not answered."};
}

std::optional<Refusal> Guard::check_call(const Caller& caller) const {
  if (auto refusal = check_site(caller)) return refusal;
  if (knows(caller)) return std::nullopt;
  return Refusal{401, "This server wants a token; it was given when the server was started."};
}

bool Guard::knows(const Caller& caller) const {
  if (token_.empty()) return true;
  constexpr std::string_view kBearer = "Bearer ";
  if (caller.authorization.starts_with(kBearer)) {
    return equal_in_constant_time(std::string_view(caller.authorization).substr(kBearer.size()),
                                  token_);
  }
  return equal_in_constant_time(cookie_value(caller.cookie, cookie_name(port_)), session_);
}

std::optional<std::string> Guard::log_in(std::string_view token) const {
  if (!token_.empty() && !equal_in_constant_time(token, token_)) return std::nullopt;
  return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name(port_), session_);
}

}  // namespace morsel::serve
