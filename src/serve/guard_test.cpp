#include "serve/guard.hpp"

#include <gtest/gtest.h>

#include <morsel/error.hpp>
#include <morsel/serve.hpp>

#include "serve/app_page.hpp"

namespace morsel::serve {
namespace {

const std::string kToken = "correct-horse-battery";

int status(const std::optional<Refusal>& refusal) { return refusal ? refusal->status : 200; }

Caller named(const std::string& host) { return {host, {}, {}, {}, {}}; }

TEST(Guard, OnlyItsOwnNames) {
  const Guard guard("127.0.0.1", 8642, "");
  for (const char* host : {"127.0.0.1:8642", "localhost:8642", "LocalHost:8642", "[::1]:8642"}) {
    EXPECT_EQ(status(guard.check_page(named(host))), 200) << host;
  }
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8642", "localhost:8642.",
                           "evil:8642@localhost:8642"}) {
    EXPECT_EQ(status(guard.check_page(named(host))), 403) << host;
    EXPECT_EQ(status(guard.check_call(named(host))), 403) << host;
  }
  const Guard lan("192.168.1.2", 80, kToken);
  EXPECT_EQ(status(lan.check_page(named("192.168.1.2"))), 200);
  EXPECT_EQ(status(lan.check_page(named("localhost:80"))), 403);
  const Guard all("0.0.0.0", 8642, kToken);
  EXPECT_EQ(status(all.check_page(named("shapes.example"))), 200);
  EXPECT_EQ(status(all.check_page(named(""))), 403);
}

TEST(Guard, NoOtherSites) {
  const Guard guard("localhost", 8642, "");
  Caller caller = named("localhost:8642");
  for (const char* origin : {"", "http://localhost:8642", "https://localhost:8642"}) {
    caller.origin = origin;
    EXPECT_EQ(status(guard.check_call(caller)), 200) << origin;
  }
  for (const char* origin : {"null", "http://localhost", "http://localhost:8643",
                             "http://127.0.0.1:8642", "http://evil.example"}) {
    caller.origin = origin;
    EXPECT_EQ(status(guard.check_call(caller)), 403) << origin;
  }
  caller.origin = "";
  for (const char* site : {"cross-site", "same-site", "nonsense"}) {
    caller.fetch_site = site;
    EXPECT_EQ(status(guard.check_call(caller)), 403) << site;
    EXPECT_EQ(status(guard.check_page(caller)), 200) << site;  // a link leads here
  }
}

TEST(Guard, TokenOrCookie) {
  const Guard guard("localhost", 8642, kToken);
  Caller caller = named("localhost:8642");
  EXPECT_EQ(status(guard.check_call(caller)), 401);
  EXPECT_EQ(status(guard.check_site(caller)), 200);
  caller.authorization = "Bearer " + kToken;
  EXPECT_EQ(status(guard.check_call(caller)), 200);
  for (const std::string& wrong : {std::string("Bearer "), "Bearer " + kToken + "x", kToken,
                                   "Bearer " + kToken.substr(1), "Bearer " + kToken + kToken}) {
    caller.authorization = wrong;
    EXPECT_EQ(status(guard.check_call(caller)), 401) << wrong;
  }
  caller.authorization = "";
  EXPECT_FALSE(guard.log_in("").has_value());
  EXPECT_FALSE(guard.log_in(kToken + "x").has_value());
  const std::string cookie = guard.log_in(kToken).value();
  EXPECT_EQ(cookie.find(kToken), std::string::npos);
  EXPECT_NE(cookie.find("; HttpOnly; SameSite=Strict"), std::string::npos);
  const std::string pair = cookie.substr(0, cookie.find(';'));
  for (const std::string& cookies : {pair, "a=b; " + pair, pair + "; a=b"}) {
    caller.cookie = cookies;
    EXPECT_EQ(status(guard.check_call(caller)), 200) << cookies;
  }
  for (const std::string& cookies :
       {"x" + pair, pair + "0", std::string("morsel-8642="), std::string("morsel-8642"),
        "morsel-8643" + pair.substr(pair.find('=')), std::string(";;;=; =")}) {
    caller.cookie = cookies;
    EXPECT_EQ(status(guard.check_call(caller)), 401) << cookies;
  }
}

TEST(Guard, ComparesAndInventsSecrets) {
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  for (const char* other : {"", "ab", "abd", "abcabc", "abca"}) {
    EXPECT_FALSE(equal_in_constant_time(other, "abc")) << other;
  }
  EXPECT_EQ(random_id().size(), 32U);
  EXPECT_NE(random_id(), random_id());
}

TEST(ServeOptions, AreChecked) {
  EXPECT_NO_THROW(ServeOptions{}.check());
  EXPECT_NO_THROW((ServeOptions{.host = "0.0.0.0", .token = kToken}.check()));
  EXPECT_THROW(ServeOptions{.host = "0.0.0.0"}.check(), Error);
  EXPECT_THROW(ServeOptions{.host = "example.org"}.check(), Error);
  EXPECT_THROW(ServeOptions{.host = ""}.check(), Error);
  EXPECT_THROW(ServeOptions{.port = 65536}.check(), Error);
  EXPECT_THROW(ServeOptions{.token = "short"}.check(), Error);
  EXPECT_THROW(ServeOptions{.token = "sixteen and space"}.check(), Error);
  EXPECT_THROW(ServeOptions{.most_upload_bytes = 0}.check(), Error);
}

TEST(Policy, IsThatOfThePage) {
  EXPECT_EQ(policy_of("<meta http-equiv=\"Content-Security-Policy\" content=\"a 'b'\" />"),
            "a 'b'; frame-ancestors 'none'");
  EXPECT_EQ(policy_of("<p>"), "default-src 'none'; frame-ancestors 'none'");
}

}  // namespace
}  // namespace morsel::serve
