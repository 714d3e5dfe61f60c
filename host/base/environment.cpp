#include "base/environment.h"

#include <fmt/format.h>

#include <cstdlib>
#include <regex>

#include "base/limits.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

std::string value_of(const std::string& name) {
    if (!limits().sandbox.empty())
        throw Error(
            fmt::format("${} stands for a variable of the environment, which scenes in a sandbox do not see", name));
    const char* const value = std::getenv(name.c_str());
    if (value == nullptr)
        throw Error(fmt::format("${} stands for a variable of the environment, and none of that name is set", name));
    return value;
}

}  // namespace

std::string with_environment(std::string_view text) {
    static const std::regex variable(R"(\$F[0-9]{0,2}(?![A-Za-z0-9])|\$([A-Za-z_]\w*)|\$\{([A-Za-z_]\w*)\})");
    const std::string in(text);
    std::string out;
    std::size_t copied = 0;
    for (std::sregex_iterator match(in.begin(), in.end(), variable), end; match != end; ++match) {
        const std::string name = (*match)[1].str() + (*match)[2].str();
        if (name.empty()) continue;
        out += in.substr(copied, static_cast<std::size_t>(match->position()) - copied) + value_of(name);
        copied = static_cast<std::size_t>(match->position() + match->length());
    }
    return out + in.substr(copied);
}

}  // namespace wrinkle
