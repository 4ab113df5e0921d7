#include "shard.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <morsel/error.hpp>
#include <string_view>

namespace morsel::cli {
namespace {

std::optional<std::size_t> whole(std::string_view text) {
  std::size_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || at != end || text.empty()) return std::nullopt;
  return value;
}

// Nothing when it is not set.
std::optional<std::size_t> variable(const char* name) {
  const char* const text = std::getenv(name);
  if (text == nullptr || *text == '\0') return std::nullopt;
  const auto value = whole(text);
  if (!value) {
    throw Error(ErrorCode::kUsage, fmt::format("{}={} is not a whole number; give --shard I/N "
                                               "instead",
                                               name, text));
  }
  return value;
}

std::optional<Shard> variables(const char* index_name, const char* count_name) {
  const auto index = variable(index_name);
  if (!index) return std::nullopt;
  const auto count = variable(count_name);
  if (!count || *index >= *count) {
    throw Error(
        ErrorCode::kUsage,
        fmt::format("{} is {}, but {} is {}; set it to the number of processes, or give "
                    "--shard I/N",
                    index_name, *index, count_name, count ? std::to_string(*count) : "not set"));
  }
  return Shard{*index, *count};
}

// Of a job array whose tasks are numbered first, first + step, …
std::optional<Shard> array_task() {
  const auto id = variable("SLURM_ARRAY_TASK_ID");
  if (!id) return std::nullopt;
  const std::size_t first = variable("SLURM_ARRAY_TASK_MIN").value_or(0);
  const std::size_t last = variable("SLURM_ARRAY_TASK_MAX").value_or(*id);
  const std::size_t step = std::max<std::size_t>(variable("SLURM_ARRAY_TASK_STEP").value_or(1), 1);
  const std::size_t count = variable("SLURM_ARRAY_TASK_COUNT").value_or(0);
  const bool regular = *id >= first && *id <= last && (*id - first) % step == 0 &&
                       (last - first) / step + 1 == count;
  if (!regular) {
    throw Error(ErrorCode::kUsage,
                "the numbers of the job array have gaps, so the files cannot be shared out by "
                "them; give --shard I/N, the same as in the first run");
  }
  return Shard{(*id - first) / step, count};
}

// The rank within the step. A batch script has a SLURM_PROCID as well, but it is no step.
std::optional<Shard> step_task() {
  if (auto rank = variables("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE")) return rank;
  if (!variable("SLURM_STEP_ID")) return std::nullopt;
  return variables("SLURM_PROCID", "SLURM_NTASKS");
}

}  // namespace

Shard read_shard(const std::string& option, const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto index = whole(std::string_view(text).substr(0, slash));
  const auto count = whole(std::string_view(text).substr(std::min(slash + 1, text.size())));
  if (!index || !count || *index >= *count) {
    throw CLI::ValidationError(
        option, fmt::format("'{}' is not I/N, two whole numbers, I from 0 to N - 1", text));
  }
  return {*index, *count};
}

std::optional<Shard> shard_of_engine() {
  if (auto pod = variables("JOB_COMPLETION_INDEX", "JOB_COMPLETIONS")) return pod;
  const std::optional<Shard> array = array_task();
  const std::optional<Shard> task = step_task();
  if (!array || !task) return array ? array : task;
  return Shard{array->index * task->count + task->index, array->count * task->count};
}

std::vector<ShapeFile> part_of(const std::vector<ShapeFile>& files, const Shard& shard) {
  // Small enough that the shards are of about the same size.
  const std::size_t unit = std::clamp<std::size_t>(files.size() / (8 * shard.count), 1, 64);
  std::vector<ShapeFile> part;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (i / unit % shard.count == shard.index) part.push_back(files[i]);
  }
  return part;
}

}  // namespace morsel::cli
