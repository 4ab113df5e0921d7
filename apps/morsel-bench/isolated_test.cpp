#include "isolated.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <morsel/error.hpp>
#include <stdexcept>

namespace morsel::bench {
namespace {

TEST(RunIsolated, ReturnsValuesInOrder) {
  const auto outcomes = run_isolated(7, 3, [](std::size_t i) { return nlohmann::json(i * i); });
  ASSERT_EQ(outcomes.size(), 7U);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    EXPECT_EQ(outcomes[i].error, "");
    EXPECT_EQ(outcomes[i].value.get<std::size_t>(), i * i);
  }
}

TEST(RunIsolated, CarriesMoreThanAPipeHolds) {
  const std::string large(1 << 20, 'x');
  const auto outcomes = run_isolated(2, 2, [&](std::size_t) { return nlohmann::json(large); });
  EXPECT_EQ(outcomes.at(1).value.get<std::string>(), large);
}

TEST(RunIsolated, OutlivesWhatGoesWrong) {
  const auto outcomes = run_isolated(5, 2, [](std::size_t i) -> nlohmann::json {
    if (i == 0) throw std::runtime_error("no such shape");
    if (i == 1) raise(SIGKILL);
    if (i == 2) _exit(9);
    if (i == 3) throw 4;
    return "fine";
  });
  EXPECT_EQ(outcomes.at(0).error, "no such shape");
  EXPECT_NE(outcomes.at(1).error.find("crashed"), std::string::npos);
  EXPECT_NE(outcomes.at(2).error.find("status 9"), std::string::npos);
  EXPECT_FALSE(outcomes.at(3).error.empty());
  EXPECT_EQ(outcomes.at(4).error, "");
  EXPECT_EQ(outcomes.at(4).value, "fine");
}

TEST(RunIsolated, DoesNothingForNoJobs) {
  EXPECT_TRUE(run_isolated(0, 2, [](std::size_t) { return nlohmann::json(); }).empty());
}

TEST(RunInTurns, SortsByContenderAndSaysWhatWentWrong) {
  const auto values = run_in_turns(
      3, 2, [](std::size_t contender, std::size_t run) { return 10 * contender + run; });
  EXPECT_EQ(values, (std::vector<std::vector<nlohmann::json>>{{0, 1}, {10, 11}, {20, 21}}));
  const auto fails = [](std::size_t, std::size_t) -> nlohmann::json {
    throw std::runtime_error("no such shape");
  };
  EXPECT_THROW(static_cast<void>(run_in_turns(1, 1, fails)), Error);
}

}  // namespace
}  // namespace morsel::bench
