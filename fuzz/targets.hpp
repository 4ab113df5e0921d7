// What is fuzzed: everything that reads bytes of strangers, one target each.
#pragma once

#include <morsel/error.hpp>
#include <span>
#include <string>
#include <string_view>

namespace morsel::fuzz {

struct Target {
  std::string_view name;
  /// Reads the bytes and uses what comes of them. Returns also when they were refused as bad input;
  /// any other exception and any broken promise ends the program. `name` is the target's.
  void (*run)(std::string_view name, std::string bytes);
};

[[nodiscard]] std::span<const Target> targets();
/// Null when there is none of that name.
[[nodiscard]] const Target* find_target(std::string_view name);

/// Says what was promised and ends the program unless it holds.
void require(bool holds, std::string_view promise);

/// False when `work` refuses its input. An internal error is a broken promise.
template <class Work>
bool accepts(const Work& work) {
  try {
    work();
    return true;
  } catch (const Error& error) {
    const std::string_view message = error.what();
    require(error.code() != ErrorCode::kInternal, message);
    require(message.find('\n') == std::string_view::npos, "a message is one line");
    return false;
  }
}

// Each in a file of this folder.
void run_reader(std::string_view name, std::string bytes);
void run_signature(std::string_view name, std::string bytes);
void run_signature_json(std::string_view name, std::string bytes);
void run_sketch(std::string_view name, std::string bytes);
void run_block(std::string_view name, std::string bytes);
void run_lines(std::string_view name, std::string bytes);
void run_database(std::string_view name, std::string bytes);
void run_http(std::string_view name, std::string bytes);
void run_segment(std::string_view name, std::string bytes);

}  // namespace morsel::fuzz
