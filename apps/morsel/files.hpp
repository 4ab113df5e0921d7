// From the paths on the command line to the files of shapes, their names and classes.
#pragma once

#include <filesystem>
#include <map>
#include <morsel/database.hpp>
#include <string>
#include <vector>

namespace morsel::cli {

/// Folders become the files in and below them whose extension is that of a shape, in order of their
/// paths, hidden ones left out; "-" becomes the paths that standard input lists, one a line, blank
/// lines and comments (#) left out; other paths stay. A shape's name is its path without "./" and
/// the like. Each path once. Throws Error(kInput) for a folder that cannot be read or holds no
/// shape.
[[nodiscard]] std::vector<ShapeFile> collect_files(const std::vector<std::string>& paths);

/// Classes by name, path or file name: the first two columns of a CSV file whose first line may be
/// "name,class". Throws Error(kInput) naming the line.
[[nodiscard]] std::map<std::string, std::string> read_classes(const std::filesystem::path& file);

/// Gives each file the class of its name, its file name or its file name without extension, in this
/// order. Returns how many have none.
std::size_t assign_classes(std::vector<ShapeFile>& files,
                           const std::map<std::string, std::string>& classes);

/// Gives each file the name of the folder that holds it as its class.
void assign_folders(std::vector<ShapeFile>& files);

}  // namespace morsel::cli
