#include "base/memory.hpp"

#include <gtest/gtest.h>

#include <morsel/error.hpp>
#include <string>

namespace morsel {
namespace {

TEST(MemoryTest, TooLittleIsAnErrorWithBothFigures) {
  expect_memory(1000, 1000, "this");
  try {
    expect_memory(3'200'000'000, 1'000'000'000, "triangulating 5 points");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kResource);
    EXPECT_NE(std::string(error.what())
                  .find("triangulating 5 points needs about 3.2 GB of memory, "
                        "1.0 GB are available"),
              std::string::npos)
        << error.what();
  }
}

TEST(MemoryTest, OfTheSystem) {
  EXPECT_GT(available_memory(), 1U << 20);
  EXPECT_GT(peak_memory(), 1U << 20);
}

}  // namespace
}  // namespace morsel
