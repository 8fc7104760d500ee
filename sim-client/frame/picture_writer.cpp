#include "sim-client/frame/picture_writer.hpp"

#include <utility>

#include "engine/image/png.hpp"

namespace septet::frame {

PictureWriter::PictureWriter()
    : thread_(4, [](Job& job) { return image::write_png(job.file, job.picture, image::PngEffort::fast); }) {}

Expected<void> PictureWriter::write(std::filesystem::path file, image::Image picture) {
  return thread_.give({std::move(file), std::move(picture)});
}

Expected<void> PictureWriter::finish() { return thread_.wait(); }

}  // namespace septet::frame
