#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>
#include <string>

#include "base/input_file.h"

namespace wrinkle::io {

/// An image that is open for reading: the file, and OpenImageIO's reader of it, which knows no other way to its bytes.
class OpenImage {
public:
    /// Throws Error when the file is missing, no regular file, empty, cut short, not an image or claims to be larger
    /// than it can be, and says which.
    explicit OpenImage(const std::filesystem::path& file, const OIIO::ImageSpec& options = {});

    /// Another reader of the same open file: one that failed reads nothing more.
    OpenImage again() const { return OpenImage(file_, {}); }

    OIIO::ImageInput& input() const { return *input_; }
    const std::shared_ptr<const InputFile>& file() const { return file_; }

private:
    OpenImage(std::shared_ptr<const InputFile> file, const OIIO::ImageSpec& options);

    std::shared_ptr<const InputFile> file_;
    // In this order, so that the reader goes before what it reads from.
    std::unique_ptr<const std::string> bytes_;
    std::unique_ptr<OIIO::Filesystem::IOProxy> proxy_;
    std::unique_ptr<OIIO::ImageInput> input_;
};

}  // namespace wrinkle::io
