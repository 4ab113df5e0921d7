#include <fmt/format.h>

#include <exception>
#include <fstream>
#include <iostream>
#include <morsel/error.hpp>
#include <morsel/io.hpp>
#include <new>
#include <stdexcept>
#include <utility>

#include "io/format.hpp"
#include "io/geometry.hpp"
#include "io/source.hpp"

namespace morsel {
namespace {

using io::Format;
using io::Geometry;
using io::Source;

Geometry parse(const Source& source, Format format) {
  switch (format) {
    case Format::kText:
      return io::read_text(source);
    case Format::kPly:
      return io::read_ply(source);
    case Format::kPcd:
      return io::read_pcd(source);
    case Format::kNpy:
      return io::read_npy(source);
    case Format::kLas:
      return io::read_las(source);
    case Format::kOff:
      return io::read_off(source);
    case Format::kObj:
      return io::read_obj(source);
    case Format::kStl:
      return io::read_stl(source);
    case Format::kGltf:
      return io::read_gltf(source);
  }
  throw Error(ErrorCode::kInternal, "a format without a reader");
}

// Runs `read`, which loads and parses; no memory is the one failure that is not the file's.
template <class Read>
auto guarded(const std::string& name, Read read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  throw Error(ErrorCode::kResource, name + ": there is not enough memory to read it");
}

Source load_named(const std::filesystem::path& path) {
  return path == "-" ? io::load(std::cin, "standard input") : io::load(path);
}

Geometry parse_geometry(const Source& source) {
  Geometry geometry = parse(source, io::detect_format(source));
  if (geometry.cloud.points.empty()) {
    io::fail(source.name, "holds no points; expected at least one");
  }
  return geometry;
}

Geometry read_geometry(const std::filesystem::path& path) {
  return guarded(io::display_name(path), [&] { return parse_geometry(load_named(path)); });
}

TriangleMesh to_mesh(Geometry geometry) {
  return {std::move(geometry.cloud.points), std::move(geometry.triangles)};
}

PointCloud to_points(Geometry geometry, const SampleOptions& sample, const std::string& name) {
  if (geometry.triangles.empty()) return std::move(geometry.cloud);
  try {
    return {sample_surface(to_mesh(std::move(geometry)), sample).points, {}};
  } catch (const Error& error) {
    throw Error(error.code(), name + ": " + error.what());
  }
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
  return path != "-" && !read_geometry(path).triangles.empty();
}

PointCloud read_points(const std::filesystem::path& path, const SampleOptions& sample) {
  sample.check();
  return to_points(read_geometry(path), sample, io::display_name(path));
}

PointCloud parse_points(std::string bytes, const std::string& name, const SampleOptions& sample) {
  sample.check();
  const Source source = io::from_memory(std::move(bytes), name);
  return guarded(source.name,
                 [&] { return to_points(parse_geometry(source), sample, source.name); });
}

PointCloud read_xyz(std::istream& stream, const std::string& name) {
  return guarded(name, [&] {
    const Source source = io::load(stream, name);
    PointCloud cloud = io::read_text(source).cloud;
    if (cloud.points.empty()) {
      io::fail(source.name, "holds no points; expected 'x y z' on each line");
    }
    return cloud;
  });
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  Geometry geometry = read_geometry(path);
  if (geometry.triangles.empty()) {
    io::fail(io::display_name(path), "holds points but no face; expected a mesh");
  }
  return to_mesh(std::move(geometry));
}

}  // namespace morsel
