#pragma once

#include <OpenImageIO/filesystem.h>

namespace wrinkle::io {

/// Lets OpenImageIO write to an open file descriptor, which the caller goes on to own. Remembers why a write failed
/// ("No space left on device"), which the image libraries do not pass on: ask failure(). After a failure all further
/// writes are dropped and look successful, so that no library prints a message of its own.
class DescriptorProxy : public OIIO::Filesystem::IOProxy {
public:
    explicit DescriptorProxy(int descriptor) : IOProxy("", Write), descriptor_(descriptor) {}

    const char* proxytype() const override { return "descriptor"; }
    std::size_t write(const void* data, std::size_t size) override;
    std::size_t pwrite(const void* data, std::size_t size, std::int64_t offset) override;
    std::size_t size() const override;

    int failure() const { return failure_; }  ///< errno of the first write that failed, or 0
    void discard() { discarding_ = true; }    ///< drops everything that is written from now on

private:
    int descriptor_;
    int failure_ = 0;
    bool discarding_ = false;
};

}  // namespace wrinkle::io
