#include <gtest/gtest.h>

#include <morsel/error.hpp>
#include <morsel/morsel.hpp>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

TEST(SignatureTest, SurvivesBytesAndJson) {
  const Signature signature = segment(shapes::dumbbell(5000)).signature;
  ASSERT_GT(signature.parts.size(), 1U);
  const auto bytes = encode(signature);
  EXPECT_LE(bytes.size(), kMostSignatureBytes);
  EXPECT_EQ(decode(bytes), signature);
  EXPECT_EQ(signature_from_json(to_json(signature)), signature);
  EXPECT_EQ(encode(signature_from_json(to_json(signature))), bytes);
}

TEST(SignatureTest, EachDamagedByteIsNoticed) {
  const auto bytes = encode(segment(shapes::dumbbell(5000)).signature);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    auto damaged = bytes;
    damaged[i] ^= std::byte{1};
    EXPECT_THROW(decode(damaged), Error);
    EXPECT_THROW(decode(std::span(bytes).first(i)), Error);
  }
}

}  // namespace
}  // namespace morsel
