#pragma once

#include <OpenImageIO/filesystem.h>

#include <memory>
#include <vector>

#include "base/input_file.h"

namespace wrinkle::io {

/// Lets OpenImageIO read a file that is open already, so that it never opens one by its name.
class InputProxy : public OIIO::Filesystem::IOProxy {
public:
    explicit InputProxy(std::shared_ptr<const InputFile> file) : IOProxy("", Read), file_(std::move(file)) {}

    const char* proxytype() const override { return "input"; }
    std::size_t read(void* to, std::size_t size) override;
    std::size_t pread(void* to, std::size_t size, std::int64_t offset) override;
    std::size_t size() const override { return static_cast<std::size_t>(file_->size()); }

private:
    std::shared_ptr<const InputFile> file_;
    // Libraries read headers byte by byte. What lies around the last such read is kept; a system call each would cost
    // more than the header.
    std::vector<char> kept_;
    std::int64_t kept_from_ = 0;
};

}  // namespace wrinkle::io
