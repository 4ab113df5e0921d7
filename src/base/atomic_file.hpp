// A file that appears under its name complete or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>

namespace morsel {

/// Writes go to a temporary file beside `path`; `commit` flushes it to disk and renames it over
/// `path`. Destroyed without commit, it leaves nothing behind and `path` untouched.
class AtomicFile {
 public:
  /// Throws Error(kOutput) when the folder does not exist or cannot be written.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }

  /// Throws Error(kOutput), e.g. when the disk is full.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
};

}  // namespace morsel
