#include "base/claim.h"

#include <fmt/format.h>

#include "base/limits.h"
#include "wrinkle/error.h"

namespace wrinkle {

void check_claim(const std::string& name, const Claim& claim) {
    if (claim.wanted <= kHarmless) return;
    if (claim.wanted <= claim.expansion * static_cast<double>(claim.file_bytes))
        return check_memory(name, claim.wanted, std::string(claim.what));
    throw Error(fmt::format("{}: it claims {}, {} of memory, in a file of {}: the file is damaged or cut short", name,
                            claim.what, bytes_text(claim.wanted), bytes_text(static_cast<double>(claim.file_bytes))));
}

std::string bytes_text(double bytes) {
    constexpr double kStep = 1000;
    const char* const units[] = {"bytes", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (; bytes >= kStep && unit + 1 < std::size(units); ++unit) bytes /= kStep;
    return fmt::format("{:.{}f} {}", bytes, unit == 0 || bytes >= 100 ? 0 : 1, units[unit]);
}

}  // namespace wrinkle
