#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <morsel/error.hpp>
#include <morsel/serve.hpp>
#include <optional>
#include <string>
#include <thread>

#include "base/test_folder.hpp"

namespace morsel {
namespace {

class ServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_web_app()) GTEST_SKIP() << "built without the web app";
    database_.emplace(Database::open(folder_ / "s.db", Access::kCreate));
  }

  TestFolder temporary_;
  std::filesystem::path folder_ = temporary_.path();
  std::optional<Database> database_;
};

TEST_F(ServerTest, StopsBeforeItRunsAndWhileItDoes) {
  Server early(*database_, {.port = 0});
  early.stop();
  early.run();
  Server late(*database_, {.port = 0});
  EXPECT_TRUE(late.address().starts_with("http://127.0.0.1:"));
  std::jthread running([&] { late.run(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  late.stop();
}

TEST_F(ServerTest, AddressesThatCannotBeHadAreNamed) {
  const Server first(*database_, {.port = 0});
  const std::string address = first.address();
  const int port = std::stoi(address.substr(address.rfind(':') + 1));
  EXPECT_THROW(Server(*database_, {.port = port}), Error);
  EXPECT_THROW(Server(*database_, {.host = "0.0.0.0"}), Error);
}

}  // namespace
}  // namespace morsel
