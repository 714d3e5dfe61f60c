#include "io/input_proxy.h"

#include <algorithm>
#include <cstring>

#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

constexpr std::size_t kSmall = 1 << 12, kKept = 1 << 15;

}  // namespace

std::size_t InputProxy::read(void* to, std::size_t size) {
    if (size > kSmall) {
        const std::size_t got = pread(to, size, m_pos);
        m_pos += static_cast<std::int64_t>(got);
        return got;
    }
    const auto kept_to = [&] { return kept_from_ + static_cast<std::int64_t>(kept_.size()); };
    if (m_pos < kept_from_ || m_pos + static_cast<std::int64_t>(size) > kept_to()) {
        kept_.resize(kKept);
        kept_from_ = m_pos;
        kept_.resize(pread(kept_.data(), kept_.size(), m_pos));
    }
    const std::size_t got = std::min(size, static_cast<std::size_t>(std::max<std::int64_t>(kept_to() - m_pos, 0)));
    std::memcpy(to, kept_.data() + (m_pos - kept_from_), got);
    m_pos += static_cast<std::int64_t>(got);
    return got;
}

std::size_t InputProxy::pread(void* to, std::size_t size, std::int64_t offset) {
    if (offset < 0) return 0;
    try {
        return file_->read_at(static_cast<std::uint64_t>(offset), to, size);
    } catch (const Error&) { return 0; }  // the libraries take it for the file's end, and say so
}

}  // namespace wrinkle::io
