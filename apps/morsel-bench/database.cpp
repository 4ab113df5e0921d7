// morsel-bench database: bytes and seconds of a database of many shapes.
#include <fmt/format.h>

#include <memory>
#include <morsel/database.hpp>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "collection.hpp"
#include "commands.hpp"
#include "perturb.hpp"
#include "sampling.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

struct DatabaseOptions {
  std::filesystem::path folder;
  std::filesystem::path database;
  std::size_t shapes = 1000;
  std::size_t models = 8;
  std::uint64_t seed = 1;
};

struct Real {
  std::vector<ClassedShape> models;
  std::vector<ShapeData> data;
};

// Models spread over all classes.
Real segment_models(const DatabaseOptions& options) {
  const std::vector<ClassedShape> all = list_shapes(options.folder, IdFilter::parse("all"));
  Real real;
  for (std::size_t i = 0; i < std::min(options.models, all.size()); ++i) {
    const std::size_t at = i * all.size() / std::min(options.models, all.size());
    const Cloud cloud =
        sample_cloud(read_mesh(all[at].path), static_cast<int>(at), {.seed = options.seed});
    const SegmentOptions with;
    real.models.push_back(all[at]);
    real.data.push_back(
        make_shape_data(segment(cloud.points, with), with, content_key(cloud.points, with)));
  }
  return real;
}

std::string name_of(const Real& real, std::size_t i) {
  return fmt::format("{}-{}", real.models[i % real.models.size()].name, i);
}

// Contents that no two shapes share.
void fill(Database& database, const DatabaseOptions& options, const Real& real) {
  Random random(options.seed);
  for (std::size_t i = 0; i < options.shapes; ++i) {
    const ClassedShape& model = real.models[i % real.models.size()];
    ShapeData data = real.data[i % real.data.size()];
    const Signature& mate = real.data[random.below(real.data.size())].signature;
    data.signature = perturbed(data.signature, mate, kPerturbation, random);
    const Vec3 key{static_cast<double>(i), 0.0, 0.0};
    data.content = content_key(std::span(&key, 1), {});
    database.put({name_of(real, i), model.category, {}, model.path.string()}, data);
  }
}

void print_bytes(const DatabaseOptions& options, const Real& real) {
  std::vector<double> signatures;
  std::vector<double> sketches;
  for (const ShapeData& data : real.data) {
    signatures.push_back(static_cast<double>(encode(data.signature).size()));
    sketches.push_back(static_cast<double>(encode_sketch(data.sketch).size()));
  }
  const double all = static_cast<double>(std::filesystem::file_size(options.database)) /
                     static_cast<double>(options.shapes);
  fmt::print("bytes a shape: {:.0f}; signature {:.0f}, sketch {:.0f}, all else {:.0f}\n", all,
             mean(signatures), mean(sketches), all - mean(signatures) - mean(sketches));
}

// What `morsel search` does with a stored name. The first search after a change writes the block.
void time_searches(const DatabaseOptions& options, const Real& real) {
  std::vector<double> seconds;
  for (std::size_t i = 0; i <= 20; ++i) {
    const Stopwatch watch;
    const Database database = Database::open(options.database, Access::kRead);
    const Signature query = database.get(name_of(real, i)).data.signature;
    static_cast<void>(database.search(query, 10));
    if (i == 0) {
      fmt::print("first search: {:.4f} s waited, {:.4f} s on the cores\n", watch.seconds(),
                 watch.core_seconds());
    } else {
      seconds.push_back(watch.seconds());
    }
  }
  fmt::print("next ones: {:.4f} s waited, median of {}\n", median(seconds), seconds.size());
}

void time_matrix(const DatabaseOptions& options) {
  const Database database = Database::open(options.database, Access::kRead);
  const Stopwatch watch;
  static_cast<void>(database.matrix());
  fmt::print("all pairs: {:.3f} s waited, {:.3f} s on the cores\n", watch.seconds(),
             watch.core_seconds());
}

void run(const DatabaseOptions& options) {
  if (std::filesystem::exists(options.database)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{}: is there already; name a new file", options.database.string()));
  }
  const Real real = segment_models(options);
  {
    Database database = Database::open(options.database, Access::kCreate);
    fill(database, options, real);
  }
  print_bytes(options, real);
  time_searches(options, real);
  time_matrix(options);
  fmt::print("{} holds {} shapes, the first of them {}\n", options.database.string(),
             options.shapes, name_of(real, 0));
}

}  // namespace

void add_database(CLI::App& app) {
  auto options = std::make_shared<DatabaseOptions>();
  CLI::App* command = app.add_subcommand(
      "database", "Writes a database of many perturbed shapes and times searches and all pairs");
  command->add_option("DIR", options->folder, "Folder of meshes, as of retrieval")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("DB", options->database, "New database; it stays")->required();
  command->add_option("--shapes", options->shapes, "Shapes to store")
      ->capture_default_str()
      ->check(CLI::Range(21, 10000000));
  command->add_option("--models", options->models, "Models that they are made of")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  command->add_option("--seed", options->seed)->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
