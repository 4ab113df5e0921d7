#include "run_options.hpp"

#include <gtest/gtest.h>

namespace morsel::bench {
namespace {

RunOptions parse(const std::string& arguments) {
  RunOptions options;
  CLI::App app;
  add_run_options(app, options);
  app.parse(arguments);
  return options;
}

TEST(RunOptions, HaveDefaults) {
  const RunOptions options = parse(".");
  EXPECT_EQ(options.noise_levels(), std::vector<double>{0.0});
  EXPECT_EQ(options.cloud(0.003).points, 20000U);
  EXPECT_EQ(options.segment().interior.method, Method::kDefault);
  EXPECT_EQ(options.segment().denoise.rounds, std::nullopt);
}

TEST(RunOptions, AreRead) {
  const RunOptions options = parse(". --noise 0 0.003,0.005 --outliers 0.01 --denoise 2 --paper");
  EXPECT_EQ(options.noise_levels(), (std::vector<double>{0.0, 0.003, 0.005}));
  EXPECT_EQ(options.cloud(0.0).outliers, 0.01);
  EXPECT_EQ(options.segment().denoise.rounds, 2);
  EXPECT_EQ(options.segment().interior.method, Method::kPaper);
  EXPECT_EQ(parse(". --denoise off").segment().denoise.rounds, 0);
}

TEST(RunOptions, AreChecked) {
  EXPECT_THROW(static_cast<void>(parse(". --denoise much").segment()), Error);
  EXPECT_THROW(static_cast<void>(parse(". --denoise -1").segment()), Error);
  EXPECT_THROW(static_cast<void>(parse(". --noise 7").models()), Error);
  EXPECT_THROW(parse(". --method best"), CLI::ParseError);
  EXPECT_THROW(parse("/nowhere/at/all"), CLI::ParseError);
}

}  // namespace
}  // namespace morsel::bench
