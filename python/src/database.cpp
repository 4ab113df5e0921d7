// <morsel/database.hpp>: shapes in a file, and those that look alike.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/sketch.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "options.hpp"
#include "segment.hpp"
#include "signature.hpp"
#include "work.hpp"

namespace morsel::python {
namespace {

namespace fs = std::filesystem;

const char* name_of(Change change) {
  switch (change) {
    case Change::kAdded:
      return "added";
    case Change::kReplaced:
      return "replaced";
    case Change::kUnchanged:
      return "unchanged";
  }
  return "";
}

py::tuple tuple_of(const ShapeInfo& info) {
  return py::make_tuple(info.name, info.class_name, info.tags, info.source);
}

// A file open until close(); calls under way in other threads keep it open until they return.
class File {
 public:
  File(const fs::path& path, const std::string& mode) {
    const Access access = mode == "r"   ? Access::kRead
                          : mode == "w" ? Access::kWrite
                                        : Access::kCreate;
    database_ =
        short_work([&] { return std::make_shared<Database>(Database::open(path, access)); });
  }

  void close() { database_.reset(); }
  [[nodiscard]] std::shared_ptr<Database> database() const {
    if (!database_) throw py::value_error("the database is closed");
    return database_;
  }

 private:
  std::shared_ptr<Database> database_;
};

// What is not given stays as it was.
struct Described {
  std::string name;
  std::optional<std::string> class_name;
  std::optional<std::vector<std::string>> tags;
  std::optional<std::string> source;

  [[nodiscard]] ShapeInfo in(const Database& database) const {
    ShapeInfo info = database.find(name).value_or(ShapeInfo{name, {}, {}, {}});
    if (class_name) info.class_name = *class_name;
    if (tags) info.tags = *tags;
    if (source) info.source = *source;
    return info;
  }
};

const char* put(const File& file, const std::string& name, const std::shared_ptr<CutShape>& shape,
                const std::optional<std::string>& class_name,
                const std::optional<std::vector<std::string>>& tags,
                const std::optional<std::string>& source) {
  const std::shared_ptr<Database> database = file.database();
  return short_work([&] {
    const ShapeInfo info = Described{name, class_name, tags, source}.in(*database);
    const std::string content = content_key(view(shape->points), shape->options);
    if (const auto change = database->put_known(info, content)) return name_of(*change);
    const ShapeData data =
        on_values([&] { return make_shape_data(*shape->segmentation(), shape->options, content); });
    return name_of(database->put(info, data));
  });
}

using PathAndName = std::pair<fs::path, std::string>;
using Sampling = std::tuple<std::size_t, double, std::uint64_t>;  // as in SampleOptions
// As segment_options() has it.
using Segmenting = std::tuple<std::string, std::optional<int>, std::string, int>;

py::tuple put_files(const File& file, const std::vector<PathAndName>& named,
                    const std::optional<std::string>& class_name,
                    const std::vector<std::string>& tags, const Sampling& sampling,
                    const Segmenting& segmenting, const py::object& progress) {
  const std::shared_ptr<Database> database = file.database();
  const auto& [count, noise, seed] = sampling;
  const IndexOptions options{std::apply(segment_options, segmenting), {count, noise, seed}};
  std::vector<ShapeFile> files;
  for (const auto& [path, name] : named) files.push_back({path, name, class_name, tags});
  const IndexReport report = long_work(progress, [&](const Progress& watched) {
    return index_files(*database, files, options, &watched);
  });
  py::list failures;
  for (const IndexFailure& failure : report.failures) {
    failures.append(py::make_tuple(py::cast(failure.path), failure.reason));
  }
  return py::make_tuple(report.added, report.replaced, report.unchanged, report.without_inside,
                        failures);
}

py::list list_shapes(const File& file, const std::optional<std::string>& class_name,
                     const std::optional<std::string>& tag) {
  const std::shared_ptr<Database> database = file.database();
  py::list list;
  for (const ShapeInfo& info : short_work([&] { return database->list({class_name, tag}); })) {
    list.append(tuple_of(info));
  }
  return list;
}

py::object find(const File& file, const std::string& name) {
  const std::shared_ptr<Database> database = file.database();
  const auto info = short_work([&] { return database->find(name); });
  return info ? py::object(tuple_of(*info)) : py::object(py::none());
}

py::bytes signature(const File& file, const std::string& name) {
  const std::shared_ptr<Database> database = file.database();
  const std::vector<std::byte> bytes =
      short_work([&] { return encode(database->get(name).data.signature); });
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void remove(const File& file, const std::vector<std::string>& names) {
  const std::shared_ptr<Database> database = file.database();
  short_work([&] { database->remove(names); });
}

void rename(const File& file, const std::string& from, const std::string& to) {
  const std::shared_ptr<Database> database = file.database();
  short_work([&] { database->rename(from, to); });
}

py::list list_of(const std::vector<LookAlike>& found) {
  py::list list;
  for (const LookAlike& hit : found) list.append(py::make_tuple(tuple_of(hit.info), hit.score));
  return list;
}

py::list search(const File& file, const std::string& query, std::size_t top,
                const std::string& method, const std::string& mode, bool mirror, bool same_scale) {
  const std::shared_ptr<Database> database = file.database();
  const MatchOptions options = match_options(method, mode, mirror, same_scale);
  return list_of(short_work([&] { return database->search(signature_of(query), top, options); }));
}

py::list search_partial(const File& file, const CutShape& query, std::size_t top,
                        const std::string& method, bool mirror, bool same_scale) {
  const std::shared_ptr<Database> database = file.database();
  const MatchOptions options = match_options(method, "partial", mirror, same_scale);
  return list_of(short_work(
      [&] { return database->search_partial(make_sketch(*query.segmentation()), top, options); }));
}

py::tuple matrix(const File& file, const std::string& method, const std::string& mode, bool mirror,
                 int threads, const py::object& progress) {
  const std::shared_ptr<Database> database = file.database();
  const MatchOptions options = match_options(method, mode, mirror);
  SimilarityMatrix found = long_work(progress, [&](const Progress& watched) {
    return database->matrix(options, threads, &watched);
  });
  py::list shapes;
  for (const ShapeInfo& info : found.shapes) shapes.append(tuple_of(info));
  const auto count = static_cast<py::ssize_t>(found.shapes.size());
  return py::make_tuple(shapes, array_from<double>(std::move(found.scores), {count, count}));
}

}  // namespace

void bind_database(py::module_& module) {
  py::class_<File>(module, "Database")
      .def(py::init<const fs::path&, const std::string&>(), py::arg("path"), py::arg("mode"))
      .def("close", &File::close)
      .def("size",
           [](const File& file) {
             return short_work([&, d = file.database()] { return d->size(); });
           })
      .def("put", &put, py::arg("name"), py::arg("shape"), py::arg("class_name"), py::arg("tags"),
           py::arg("source"))
      .def("put_files", &put_files, py::arg("files"), py::arg("class_name"), py::arg("tags"),
           py::arg("sampling"), py::arg("segmenting"), py::arg("progress"))
      .def("shapes", &list_shapes, py::arg("class_name"), py::arg("tag"))
      .def("find", &find, py::arg("name"))
      .def("signature", &signature, py::arg("name"))
      .def("remove", &remove, py::arg("names"))
      .def("rename", &rename, py::arg("old"), py::arg("new"))
      .def("search", &search, py::arg("query"), py::arg("top"), py::arg("method"), py::arg("mode"),
           py::arg("mirror"), py::arg("same_scale"))
      .def("search_partial", &search_partial, py::arg("query"), py::arg("top"), py::arg("method"),
           py::arg("mirror"), py::arg("same_scale"))
      .def("matrix", &matrix, py::arg("method"), py::arg("mode"), py::arg("mirror"),
           py::arg("threads"), py::arg("progress"));
}

}  // namespace morsel::python
