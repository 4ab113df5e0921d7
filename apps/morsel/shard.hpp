// Which of many processes this one is, and its share of the files.
#pragma once

#include <cstddef>
#include <morsel/database.hpp>
#include <optional>
#include <string>
#include <vector>

namespace morsel::cli {

/// One of `count` processes that share the work.
struct Shard {
  std::size_t index = 0;  ///< 0 … count - 1
  std::size_t count = 1;
};

/// Of "I/N". `option` names it in messages. Throws CLI::ValidationError.
[[nodiscard]] Shard read_shard(const std::string& option, const std::string& text);

/// What the engine that started this process says; nothing when there is none. The first of these
/// that is set counts: JOB_COMPLETION_INDEX of JOB_COMPLETIONS (a Kubernetes indexed job);
/// otherwise the rank among those of its step, OMPI_COMM_WORLD_RANK of OMPI_COMM_WORLD_SIZE
/// (mpirun) or SLURM_PROCID of SLURM_NTASKS (srun), within the task of a Slurm job array. Throws
/// Error(kUsage) when they contradict themselves.
[[nodiscard]] std::optional<Shard> shard_of_engine();

/// The shard's files, in their order. Runs of up to 64 neighbours stay together; all shards
/// together have each file once. The same for the same list and count, wherever it runs.
[[nodiscard]] std::vector<ShapeFile> part_of(const std::vector<ShapeFile>& files,
                                             const Shard& shard);

}  // namespace morsel::cli
