#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <new>

#include "wrinkle/error.h"

namespace wrinkle {

/// Does `work`; what it throws that is no Error becomes one that says what was being done.
template <class Work>
decltype(auto) only_errors(const char* what, Work work) {
    try {
        return work();
    } catch (const Error&) { throw; } catch (const std::bad_alloc&) {
        throw Error(fmt::format("{}: out of memory", what));
    } catch (const std::filesystem::filesystem_error& error) {
        throw Error(fmt::format("{}: {}: {}", what, error.path1().string(), error.code().message()));
    } catch (const std::exception& error) { throw Error(fmt::format("{}: {}", what, error.what())); }
}

}  // namespace wrinkle
