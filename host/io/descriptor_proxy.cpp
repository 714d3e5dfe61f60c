#include "io/descriptor_proxy.h"

#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>

namespace wrinkle::io {

std::size_t DescriptorProxy::write(const void* data, std::size_t size) {
    const std::size_t written = pwrite(data, size, m_pos);
    m_pos += static_cast<std::int64_t>(written);
    return written;
}

std::size_t DescriptorProxy::pwrite(const void* data, std::size_t size, std::int64_t offset) {
    std::size_t written = discarding_ || failure_ != 0 ? size : 0;
    while (written < size) {
        const auto count = ::pwrite(descriptor_, static_cast<const char*>(data) + written, size - written,
                                    offset + static_cast<std::int64_t>(written));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            if (failure_ == 0) failure_ = count < 0 ? errno : EIO;
            return size;
        }
        written += static_cast<std::size_t>(count);
    }
    return written;
}

std::size_t DescriptorProxy::size() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

}  // namespace wrinkle::io
