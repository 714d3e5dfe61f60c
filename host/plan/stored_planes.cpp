#include "plan/stored_planes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "plan/section.h"

namespace wrinkle {

namespace {

const PlaneFormat* format_of(const std::string& plane, const PlaneFormats& formats) {
    const auto found = formats.find(plane);
    return found == formats.end() ? nullptr : &found->second;
}

struct Text {
    const char* type;  ///< as kernels know it
    double full = 1;   ///< the integer that stands for 1
};

Text text_of(PlaneEncoding encoding) {
    switch (encoding) {
        case PlaneEncoding::half:
            return {"WR_STORED_HALF"};
        case PlaneEncoding::unorm8:
            return {"WR_STORED_UNSIGNED", 255};
        case PlaneEncoding::unorm16:
            return {"WR_STORED_UNSIGNED", 65535};
        case PlaneEncoding::snorm8:
            return {"WR_STORED_SIGNED", 127};
        case PlaneEncoding::snorm16:
            return {"WR_STORED_SIGNED", 32767};
        case PlaneEncoding::octahedral8:
        case PlaneEncoding::octahedral16:
            return {"WR_STORED_OCTAHEDRAL"};
        case PlaneEncoding::uint32:
            return {"WR_STORED_UNSIGNED"};
        case PlaneEncoding::float32:
            break;
    }
    return {"WR_STORED_FLOAT"};
}

/// Declares each plane that has a format, as a part of the memory that an argument is.
std::string declarations(const std::vector<std::string>& planes, const PlaneFormats& formats, bool written) {
    const std::vector<std::string> memories = memories_of(planes, formats);
    const std::string way = written ? "out" : "in";
    std::string text;
    for (const std::string& plane : planes) {
        const PlaneFormat* format = format_of(plane, formats);
        if (format == nullptr) continue;
        const auto memory = std::ranges::find(memories, format->memory) - memories.begin();
        const Text encoding = text_of(format->encoding);
        const bool number = format->encoding == PlaneEncoding::uint32 && !written;
        const char* const type = !number ? encoding.type : holds_bits(plane) ? "WR_STORED_BITS" : "WR_STORED_LABEL";
        const int axis = is_octahedral({{plane, *format}}) ? plane.back() - 'x' : 0;
        text += fmt::format(
            "    const wr_stored {0}_{1} = {{(global uchar *){0}_memory_{2}, {3}, {4}, {5}, {6}, {7}, {8:#.9g}f, "
            "{9:#.9g}f}};\n",
            way, identifier(plane).substr(3), memory, type, bytes_of(format->encoding), format->stride, format->offset,
            axis, format->scale / encoding.full, format->bias);
    }
    return text;
}

std::string arguments(const std::vector<std::string>& planes, const PlaneFormats& formats, bool written) {
    std::string text;
    const std::vector<std::string> memories = memories_of(planes, formats);
    for (std::size_t i = 0; i < memories.size(); ++i) {
        const bool plain = std::ranges::count(planes, memories[i]) == 1 && format_of(memories[i], formats) == nullptr;
        const std::string name = identifier(memories[i]).substr(3);
        if (plain)
            text += written ? fmt::format("    global WR_SCALAR *restrict out_{},\n", name)
                            : fmt::format("    global const float *restrict in_{},\n", name);
        else
            text += written ? fmt::format("    global uchar *restrict out_memory_{},\n", i)
                            : fmt::format("    global const uchar *restrict in_memory_{},\n", i);
    }
    return text;
}

}  // namespace

std::vector<std::string> memories_of(const std::vector<std::string>& planes, const PlaneFormats& formats) {
    std::vector<std::string> memories;
    for (const std::string& plane : planes) {
        const PlaneFormat* format = format_of(plane, formats);
        const std::string& memory = format != nullptr ? format->memory : plane;
        if (std::ranges::find(memories, memory) == memories.end()) memories.push_back(memory);
    }
    return memories;
}

std::uint32_t pixel_bytes(const std::string& memory, const PlaneFormats& formats) {
    for (const auto& [plane, format] : formats)
        if (format.memory == memory) return format.stride;
    return sizeof(float);
}

std::uint32_t store_alignment(const std::string& memory, const PlaneFormats& formats, int lanes) {
    const auto found = std::ranges::find(formats, memory, [](const auto& entry) { return entry.second.memory; });
    const std::uint32_t together = static_cast<std::uint32_t>(lanes) * pixel_bytes(memory, formats);
    if (found == formats.end()) return together;
    const std::uint32_t number = bytes_of(found->second.encoding);
    return found->second.stride == number ? together : sizeof(float);
}

bool has_gaps(const std::string& memory, const PlaneFormats& formats) {
    std::map<std::uint32_t, std::uint32_t> bytes;  // octahedral planes share theirs
    for (const auto& [plane, format] : formats)
        if (format.memory == memory) bytes[format.offset] = bytes_of(format.encoding);
    std::uint32_t covered = 0;
    for (const auto& [offset, count] : bytes) covered += count;
    return covered < pixel_bytes(memory, formats) && !bytes.empty();
}

bool holds_bits(const std::string& plane) { return plane.starts_with("crypto.id") || plane == "crypto.front"; }

std::string input_arguments(const std::vector<std::string>& planes, const PlaneFormats& formats) {
    return arguments(planes, formats, false);
}
std::string input_declarations(const std::vector<std::string>& planes, const PlaneFormats& formats) {
    return declarations(planes, formats, false);
}
std::string input_type(const std::string& plane, const PlaneFormats& formats) {
    return format_of(plane, formats) != nullptr ? "wr_stored " : "global const float *";
}
std::string output_arguments(const std::vector<std::string>& planes, const PlaneFormats& formats) {
    return arguments(planes, formats, true);
}
std::string output_declarations(const std::vector<std::string>& planes, const PlaneFormats& formats) {
    return declarations(planes, formats, true);
}

bool is_octahedral(const PlaneFormats& formats) {
    return std::ranges::any_of(formats, [](const auto& each) {
        return each.second.encoding == PlaneEncoding::octahedral8 ||
               each.second.encoding == PlaneEncoding::octahedral16;
    });
}

}  // namespace wrinkle
