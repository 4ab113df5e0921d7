#include "picture/png.hpp"

#include <png.h>

#include <cstdint>
#include <cstring>
#include <morsel/error.hpp>
#include <morsel/picture.hpp>
#include <string>

#include "base/atomic_file.hpp"

namespace morsel {
namespace {

constexpr std::size_t kLargestSide = 1'000'000;  // libpng's own limit

}  // namespace

std::string picture::encode_png(const Image& image, const std::string& name) {
  if (image.width == 0 || image.height == 0 || image.width > kLargestSide ||
      image.height > kLargestSide || image.rgb.size() != 3 * image.width * image.height) {
    throw Error(ErrorCode::kUsage,
                name + ": image of " + std::to_string(image.width) + " x " +
                    std::to_string(image.height) + " pixels with " +
                    std::to_string(image.rgb.size()) +
                    " bytes; it needs 1 to 1000000 pixels a side and 3 bytes a pixel");
  }
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) ==
      0) {
    const std::string reason = header.message;
    png_image_free(&header);
    throw Error(ErrorCode::kOutput, name + ": cannot encode as PNG: " + reason);
  }
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  const std::string bytes = picture::encode_png(image, path.string());
  AtomicFile file(path);
  file.stream() << bytes;
  file.commit();
}

}  // namespace morsel
