#include "wrinkle/plane_format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/names.h"
#include "plan/stored_planes.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

const std::vector<std::string> kNormal{"normal.x", "normal.y", "normal.z"};

bool is_octahedral(PlaneEncoding encoding) {
    return encoding == PlaneEncoding::octahedral8 || encoding == PlaneEncoding::octahedral16;
}

bool is_plain(const std::string& plane, const PlaneFormat& format) {
    return format == PlaneFormat{.stride = sizeof(float), .memory = plane};
}

/// One plane by itself.
void check_alone(const std::string& who, const std::string& plane, const PlaneFormat& format) {
    const auto refuse = [&](const std::string& what) {
        throw Error(fmt::format("{}: the plane \"{}\", as {}, {}", who, plane, encoding_name(format.encoding), what));
    };
    const std::uint32_t bytes = bytes_of(format.encoding);
    if (format.offset % bytes != 0 || format.stride % bytes != 0)
        refuse(fmt::format("begins at byte {} of pixels of {} bytes; both must be multiples of {}", format.offset,
                           format.stride, bytes));
    if (format.offset > format.stride || format.stride - format.offset < bytes)
        refuse(fmt::format("ends beyond its pixels, which have {} bytes", format.stride));
    if (!std::isnormal(static_cast<float>(format.scale)) || !std::isfinite(static_cast<float>(format.bias)))
        refuse(fmt::format("has the scale {} and the bias {}; both must be finite, and the scale not 0", format.scale,
                           format.bias));
    const bool direction = is_octahedral(format.encoding);
    if ((direction || format.encoding == PlaneEncoding::uint32) && (format.scale != 1 || format.bias != 0))
        refuse("has a scale or a bias; numbers so stored are taken as they are");
    const bool bits = format.encoding == PlaneEncoding::float32 || format.encoding == PlaneEncoding::uint32;
    if (holds_bits(plane) && (!bits || format.scale != 1 || format.bias != 0))
        refuse("loses the bits of Cryptomatte's ids; they must be float32 or uint32 without a scale or bias");
    if (direction && std::ranges::find(kNormal, plane) == kNormal.end())
        refuse("is no part of the normal, which alone can be octahedral");
}

}  // namespace

std::uint32_t bytes_of(PlaneEncoding encoding) {
    switch (encoding) {
        case PlaneEncoding::unorm8:
        case PlaneEncoding::snorm8:
            return 1;
        case PlaneEncoding::half:
        case PlaneEncoding::unorm16:
        case PlaneEncoding::snorm16:
        case PlaneEncoding::octahedral8:
            return 2;
        case PlaneEncoding::float32:
        case PlaneEncoding::octahedral16:
        case PlaneEncoding::uint32:
            break;
    }
    return 4;
}

std::string encoding_name(PlaneEncoding encoding) {
    constexpr const char* kNames[] = {"float32", "half",        "unorm8",       "unorm16", "snorm8",
                                      "snorm16", "octahedral8", "octahedral16", "uint32"};
    return kNames[static_cast<std::size_t>(encoding)];
}

PlaneFormats interleaved(const std::string& memory, PlaneEncoding encoding, const std::vector<std::string>& planes,
                         double scale, double bias) {
    PlaneFormats formats;
    const std::uint32_t bytes = bytes_of(encoding);
    const bool one = is_octahedral(encoding);
    if (one && planes != kNormal)
        throw Error(fmt::format("interleaved \"{}\": {} pixels hold {} and nothing else; found \"{}\"", memory,
                                encoding_name(encoding), fmt::join(kNormal, ", "), fmt::join(planes, "\", \"")));
    for (std::size_t i = 0; i < planes.size(); ++i)
        if (!planes[i].empty())
            formats[planes[i]] = {.encoding = encoding,
                                  .offset = one ? 0 : static_cast<std::uint32_t>(i) * bytes,
                                  .stride = one ? bytes : static_cast<std::uint32_t>(planes.size()) * bytes,
                                  .scale = scale,
                                  .bias = bias,
                                  .memory = memory};
    return formats;
}

PlaneFormats checked_formats(const PlaneFormats& formats, const std::string& who, bool apart) {
    PlaneFormats checked;
    for (auto [plane, format] : formats) {
        if (format.stride == 0) format.stride = bytes_of(format.encoding);
        if (format.memory.empty()) format.memory = plane;
        check_alone(who, plane, format);
        if (!is_plain(plane, format)) checked.emplace(plane, std::move(format));
    }
    for (const auto& [plane, format] : checked) {
        for (const auto& [other, beside] : checked) {
            if (other == plane || beside.memory != format.memory) continue;
            if (beside.stride != format.stride)
                throw Error(
                    fmt::format("{}: the planes \"{}\" and \"{}\" share the memory \"{}\", but have pixels of {} "
                                "and {} bytes",
                                who, plane, other, format.memory, format.stride, beside.stride));
            const bool together = is_octahedral(format.encoding) && format == beside;
            if (apart && !together && format.offset < beside.offset + bytes_of(beside.encoding) &&
                beside.offset < format.offset + bytes_of(format.encoding))
                throw Error(
                    fmt::format("{}: the planes \"{}\" and \"{}\" would be written to the same bytes of the "
                                "memory \"{}\"",
                                who, plane, other, format.memory));
        }
        if (is_octahedral(format.encoding))
            for (const std::string& part : kNormal)
                if (const auto found = checked.find(part); found == checked.end() || found->second != format)
                    throw Error(
                        fmt::format("{}: the plane \"{}\" is octahedral; \"{}\" must have the same format and "
                                    "memory",
                                    who, plane, part));
    }
    return checked;
}

void require_planes(const PlaneFormats& formats, const std::set<std::string>& planes, const std::string& who) {
    const std::vector<std::string> names(planes.begin(), planes.end());
    for (const auto& [plane, format] : formats) {
        if (!planes.contains(plane))
            throw Error(fmt::format("{}: there is no plane \"{}\"; nearest: \"{}\"; there are {}", who, plane,
                                    nearest_name(plane, names), fmt::join(names, ", ")));
        const auto other = formats.find(format.memory);
        if (planes.contains(format.memory) && (other == formats.end() || other->second.memory != format.memory))
            throw Error(
                fmt::format("{}: the memory of the plane \"{}\" is called \"{}\", as a plane that lies elsewhere", who,
                            plane, format.memory));
    }
}

}  // namespace wrinkle
