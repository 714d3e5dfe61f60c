#include "tools/readiness.h"

#include <fmt/format.h>

#include "layers/kinds.h"

namespace wrinkle {

namespace {

/// Adds the roles that the frame lacks; of "a or b" one is enough.
std::vector<std::string> need(std::vector<std::string> missing, const GBufferInfo& info,
                              std::span<const char* const> roles) {
    for (const std::string role : roles) {
        bool found = false;
        for (std::size_t from = 0, to; from < role.size(); from = to + 4) {
            to = std::min(role.find(" or ", from), role.size());
            found = found || info.roles.has_role(role.substr(from, to - from));
        }
        if (!found) missing.push_back(role);
    }
    return missing;
}

template <std::size_t N>
std::vector<std::string> need(std::vector<std::string> missing, const GBufferInfo& info,
                              const char* const (&roles)[N]) {
    return need(std::move(missing), info, std::span<const char* const>(roles));
}

}  // namespace

std::vector<Readiness> readiness(const GBufferInfo& info) {
    std::vector<std::string> base = need({}, info, {"normal", "depth or position"});
    if (!info.camera)
        base.emplace_back("camera");
    else if (!info.camera_problem.empty())
        base.emplace_back("camera that fits the positions");

    std::vector<Readiness> uses;
    for (const LayerKind* kind : layer_kinds()) {
        if (kind->ends_stage) continue;
        if (kind->uses.empty()) uses.push_back({kind->name, base, {}});
        for (const LayerUse& use : kind->uses)
            uses.push_back({*use.how == 0 ? kind->name : fmt::format("{} with {}", kind->name, use.how),
                            need(base, info, use.roles),
                            {}});
    }
    Readiness lighting{"lighting", base, need({}, info, {"albedo", "roughness"})};
    uses.push_back(lighting);
    uses.push_back({"relight = \"ratio\"", need(base, info, {"beauty"}), lighting.defaults});
    uses.push_back({"mask by object", need(base, info, {"object"}), {}});
    uses.push_back({"mask by cryptomatte", need(base, info, {"cryptomatte"}), {}});
    if (!info.cryptomatte_problem.empty()) uses.back().missing.emplace_back("whole ids of 32 bits");
    return uses;
}

}  // namespace wrinkle
