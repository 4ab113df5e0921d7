#include "serve/uploads.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "base/test_shapes.hpp"
#include "serve/turns.hpp"

namespace morsel::serve {
namespace {

std::string xyz(const shapes::Points& points) {
  std::string text;
  for (const Vec3& p : points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  return text;
}

// The state at the end.
UploadState finish(const Uploads& uploads, const std::string& id) {
  UploadState state = uploads.state(id).value();
  while (state.stage == Stage::kWaiting || state.stage == Stage::kWorking) {
    const auto next = uploads.wait(id, state.version, std::chrono::seconds(10));
    if (!next) break;
    EXPECT_GE(next->version, state.version);
    state = *next;
  }
  return state;
}

TEST(Uploads, AreSegmentedAndKept) {
  Uploads uploads({});
  const std::string id = uploads.add("bell.xyz", xyz(shapes::dumbbell(2000))).value();
  const UploadState state = finish(uploads, id);
  EXPECT_EQ(state.stage, Stage::kDone) << state.message;
  EXPECT_EQ(state.fraction, 1.0);
  const auto result = uploads.result(id);
  ASSERT_NE(result, nullptr);
  EXPECT_EQ(result->data.points, 2000U);
  EXPECT_GT(result->data.signature.size, 0.0);
  EXPECT_NE(result->parts.find("\"name\":\"bell.xyz\""), std::string::npos);
  EXPECT_FALSE(uploads.state("nobody").has_value());
  EXPECT_EQ(uploads.result("nobody"), nullptr);
  EXPECT_FALSE(uploads.cancel("nobody"));
}

TEST(Uploads, FailuresAreSentences) {
  Uploads uploads({.most_upload_points = 100});
  const auto message = [&](const std::string& name, const std::string& bytes) {
    const UploadState state = finish(uploads, uploads.add(name, bytes).value());
    EXPECT_EQ(state.stage, Stage::kFailed);
    return state.message;
  };
  EXPECT_TRUE(message("a.ply", "ply\n").starts_with("a.ply:"));
  EXPECT_NE(message("b.xyz", xyz(shapes::dumbbell(101))).find("at most 100"), std::string::npos);
  EXPECT_NE(message("c.xyz", "0 0 0\n1 1 1\n").find("c.xyz: "), std::string::npos);
}

TEST(Uploads, OnlySoManyWaitAndAreKept) {
  Uploads uploads({});
  const std::string bytes = xyz(shapes::dumbbell(20000));
  std::vector<std::string> ids;
  while (const auto id = uploads.add("a.xyz", bytes)) {
    ids.push_back(*id);
    ASSERT_LT(ids.size(), 100U);
  }
  EXPECT_GE(ids.size(), 6U);
  for (const std::string& id : ids) EXPECT_TRUE(uploads.cancel(id));
  for (const std::string& id : ids) EXPECT_NE(finish(uploads, id).stage, Stage::kFailed);
  std::vector<std::string> later;
  for (int i = 0; i < 15; ++i) {
    later.push_back(uploads.add("b.xyz", "nonsense").value());
    (void)finish(uploads, later.back());
  }
  EXPECT_FALSE(uploads.state(later.front()).has_value());
  EXPECT_TRUE(uploads.state(later.back()).has_value());
}

TEST(Uploads, RoomIsBoundedAndGivenBack) {
  Uploads uploads({.most_upload_bytes = 10});
  {
    Uploads::Room room(uploads);
    EXPECT_TRUE(room.add("0123456789", 10));
    EXPECT_FALSE(room.add("0", 1));
    EXPECT_TRUE(room.too_large());
    Uploads::Room second(uploads);
    Uploads::Room third(uploads);
    Uploads::Room fourth(uploads);
    Uploads::Room fifth(uploads);
    for (Uploads::Room* other : {&second, &third, &fourth})
      EXPECT_TRUE(other->add("0123456789", 10));
    EXPECT_FALSE(fifth.add("0", 1));
    EXPECT_FALSE(fifth.too_large());
  }
  Uploads::Room room(uploads);
  EXPECT_TRUE(room.add("0123456789", 10));
  EXPECT_EQ(room.take(), "0123456789");
}

TEST(Turns, AtMostSoManyAtOnce) {
  Turns turns(2);
  std::atomic<int> inside{0};
  std::atomic<int> most{0};
  std::atomic<int> done{0};
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 16; ++i) {
      threads.emplace_back([&] {
        done += turns.take([&] {
          const int now = ++inside;
          for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
          std::this_thread::sleep_for(std::chrono::milliseconds(2));
          --inside;
          return 1;
        });
      });
    }
  }
  EXPECT_EQ(done.load(), 16);
  EXPECT_LE(most.load(), 2);
}

}  // namespace
}  // namespace morsel::serve
