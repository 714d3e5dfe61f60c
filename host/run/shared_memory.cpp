#include "run/shared_memory.h"

#include <fmt/format.h>

#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// Bytes [begin, end) of a buffer, or of the host's memory.
struct Extent {
    cl_mem buffer = nullptr;  ///< null: the host's
    std::uintptr_t begin = 0, end = 0;

    bool shares(const Extent& other) const { return buffer == other.buffer && begin < other.end && other.begin < end; }
};

template <class T>
Extent extent_of(const std::span<T>& span) {
    const auto begin = reinterpret_cast<std::uintptr_t>(span.data());
    return {nullptr, begin, begin + span.size_bytes()};
}

/// A sub-buffer lies in its parent; a buffer that was lent the host's memory lies there.
Extent extent_of(const cl::Buffer& buffer) {
    const auto size = buffer.getInfo<CL_MEM_SIZE>(), offset = buffer.getInfo<CL_MEM_OFFSET>();
    const auto parent = buffer.getInfo<CL_MEM_ASSOCIATED_MEMOBJECT>();
    const cl::Memory& whole = parent() != nullptr ? parent : buffer;
    if ((whole.getInfo<CL_MEM_FLAGS>() & CL_MEM_USE_HOST_PTR) == 0) return {whole(), offset, offset + size};
    const auto begin = reinterpret_cast<std::uintptr_t>(whole.getInfo<CL_MEM_HOST_PTR>()) + offset;
    return {nullptr, begin, begin + size};
}

template <class In, class Out>
void refuse_shared(const In& in, const std::vector<std::string>& inputs, const Out& out,
                   const std::vector<std::string>& outputs) {
    struct Named {
        const char* what;
        const std::string& name;
        Extent extent;
    };
    std::vector<Named> others;
    const auto add = [&](const char* what, const std::string& name, const auto& planes) {
        if (const auto found = planes.find(name); found != planes.end())
            others.push_back({what, name, extent_of(found->second)});
    };
    for (const std::string& name : inputs) add("input", name, in);
    for (const std::string& name : outputs) {
        const std::size_t before = others.size();
        add("output", name, out);
        if (others.size() == before) continue;
        for (std::size_t i = 0; i < before; ++i)
            if (others[i].extent.shares(others.back().extent))
                throw Error(
                    fmt::format("the output plane \"{}\" shares memory with the {} plane \"{}\"; give every "
                                "output memory of its own",
                                name, others[i].what, others[i].name));
    }
}

}  // namespace

void refuse_shared_memory(const DevicePlanes& in, const std::vector<std::string>& inputs, const DevicePlanes& out,
                          const std::vector<std::string>& outputs) {
    refuse_shared(in, inputs, out, outputs);
}

void refuse_shared_memory(const HostBytes& in, const std::vector<std::string>& inputs, const HostByteOutputs& out,
                          const std::vector<std::string>& outputs) {
    refuse_shared(in, inputs, out, outputs);
}

}  // namespace wrinkle
