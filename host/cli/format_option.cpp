#include "cli/format_option.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/names.h"
#include "wrinkle/error.h"
#include "wrinkle/gbuffer.h"

namespace wrinkle::cli {

namespace {

constexpr PlaneEncoding kLast = PlaneEncoding::uint32;

PlaneEncoding encoding_of(const std::string& name, const std::string& argument) {
    std::vector<std::string> names;
    for (int i = 0; i <= static_cast<int>(kLast); ++i) {
        names.push_back(encoding_name(static_cast<PlaneEncoding>(i)));
        if (names.back() == name) return static_cast<PlaneEncoding>(i);
    }
    throw Error(fmt::format("--format {}: no encoding is called \"{}\"{}; there are {}", argument, name,
                            did_you_mean(name, names), quote_list(names)));
}

bool is_unsigned(PlaneEncoding encoding) {
    return encoding == PlaneEncoding::unorm8 || encoding == PlaneEncoding::unorm16;
}

/// Of what engines store from -1 to 1 in integers from 0 to 1.
bool is_direction(const std::string& role) { return role == "normal" || role == "tangent" || role == "bitangent"; }

}  // namespace

void add_format_option(CLI::App& command, std::vector<std::string>& formats) {
    command
        .add_option("--format", formats,
                    "as if a plane, or those of a role in pixels together, were so stored: normal=octahedral16, "
                    "depth=half; of normals and "
                    "tangents 0 to 1 of unorm8 and unorm16 means -1 to 1")
        ->type_name("NAME=ENCODING")
        ->allow_extra_args(false);
}

PlaneFormats formats_of(const std::vector<std::string>& arguments) {
    PlaneFormats formats;
    for (const std::string& argument : arguments) {
        const std::size_t end = argument.find('=');
        if (end == std::string::npos)
            throw Error(fmt::format("--format {}: NAME=ENCODING is expected, as normal=octahedral16", argument));
        const std::string name = argument.substr(0, end);
        const PlaneEncoding encoding = encoding_of(argument.substr(end + 1), argument);
        const auto role = std::ranges::find(gbuffer_roles(), name, &Role::name);
        const bool together = role != gbuffer_roles().end() && role->planes.size() > 1;
        const bool to_signed = is_unsigned(encoding) && is_direction(name);
        const PlaneFormats some = together
                                      ? interleaved(name, encoding, role->planes, to_signed ? 2 : 1, to_signed ? -1 : 0)
                                      : PlaneFormats{{name, {.encoding = encoding}}};
        for (const auto& [plane, format] : some)
            if (!formats.emplace(plane, format).second)
                throw Error(fmt::format("--format {}: the plane \"{}\" has a format already", argument, plane));
    }
    return formats;
}

}  // namespace wrinkle::cli
