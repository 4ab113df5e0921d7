// morsel-bench: jobs in child processes, so that a crash costs one result and not the whole run.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace morsel::bench {

/// What became of a job: its value, or why there is none.
struct Outcome {
  nlohmann::json value;
  std::string error;  ///< empty when the job returned a value
};

/// Runs job(0) … job(count - 1), each in a child process of its own, at most `workers` at a time,
/// and returns what they returned, in order. What a job throws and how it crashes is its outcome's
/// error. Counts the jobs done on stderr when that is a terminal.
/// The caller has no other threads: a child has only the one that forked it.
/// Throws Error(kResource) when no child can be started.
[[nodiscard]] std::vector<Outcome> run_isolated(
    std::size_t count, int workers, const std::function<nlohmann::json(std::size_t)>& job);

/// Runs job(contender, run) for each, one at a time, each in a process of its own; a run begins
/// with another contender than the one before, so that none always follows the same one. Returns of
/// each contender what it gave in each run. Throws Error(kResource), also with what went wrong in a
/// job.
[[nodiscard]] std::vector<std::vector<nlohmann::json>> run_in_turns(
    std::size_t contenders, std::size_t runs,
    const std::function<nlohmann::json(std::size_t contender, std::size_t run)>& job);

}  // namespace morsel::bench
