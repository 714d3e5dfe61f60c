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

}  // namespace

void add_format_option(CLI::App& command, std::vector<std::string>& formats) {
    command
        .add_option(
            "--format", formats,
            "as if a plane, or those of a role in pixels together, were so stored: normal=octahedral16, depth=half")
        ->type_name("NAME=ENCODING")
        ->allow_extra_args(false);
}

PlaneFormats formats_of(const std::vector<std::string>& arguments) {
    PlaneFormats formats;
    for (const std::string& argument : arguments) {
        const std::size_t end = std::min(argument.find('='), argument.size());
        const std::string name = argument.substr(0, end);
        const PlaneEncoding encoding = encoding_of(end == argument.size() ? "" : argument.substr(end + 1), argument);
        const auto role = std::ranges::find(gbuffer_roles(), name, &Role::name);
        const bool together = role != gbuffer_roles().end() && role->planes.size() > 1;
        const PlaneFormats some =
            together ? interleaved(name, encoding, role->planes) : PlaneFormats{{name, {.encoding = encoding}}};
        formats.insert(some.begin(), some.end());
    }
    return formats;
}

}  // namespace wrinkle::cli
