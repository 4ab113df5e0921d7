// Who may ask what: the checks that keep other sites and strangers out.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace morsel::serve {

/// The headers of a request that tell who asks; empty where there are none.
struct Caller {
  std::string host;
  std::string origin;
  std::string fetch_site;  ///< Sec-Fetch-Site
  std::string authorization;
  std::string cookie;
};

/// Why a request is not answered: an HTTP status and a sentence.
struct Refusal {
  int status = 0;
  std::string reason;
};

/// True for the addresses and names of this machine that no other can reach.
[[nodiscard]] bool is_loopback(std::string_view host);

/// Compares in a time that depends on the lengths alone.
[[nodiscard]] bool equal_in_constant_time(std::string_view a, std::string_view b);

/// 32 hexadecimal digits that nobody can guess.
[[nodiscard]] std::string random_id();

/// A host as it stands in a URL: an IPv6 address in brackets.
[[nodiscard]] std::string in_url(const std::string& host);

class Guard {
 public:
  /// `host` and `port` as listened on; no `token`: everybody on this machine may ask.
  Guard(std::string host, int port, std::string token);

  /// The page itself holds nothing secret; only its name must be right, so that no other site can
  /// have its own name point here (DNS rebinding).
  [[nodiscard]] std::optional<Refusal> check_page(const Caller& caller) const;
  /// Everything else: also no request that another site's page makes, and the token.
  [[nodiscard]] std::optional<Refusal> check_call(const Caller& caller) const;
  /// As check_call() without the token: for handing it in.
  [[nodiscard]] std::optional<Refusal> check_site(const Caller& caller) const;

  /// The value of Set-Cookie that stands for the token from now on; nothing for a wrong one.
  [[nodiscard]] std::optional<std::string> log_in(std::string_view token) const;

 private:
  [[nodiscard]] bool knows(const Caller& caller) const;

  std::string host_;
  int port_;
  std::string token_;
  std::string session_;  // what the cookie holds: the token itself is not kept by browsers
};

}  // namespace morsel::serve
