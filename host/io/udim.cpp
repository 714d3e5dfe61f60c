#include "io/udim.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace wrinkle::io {
namespace {

constexpr std::string_view kPlace = "<UDIM>";
constexpr int kFirst = 1001, kLast = 1999, kColumns = 10;

}  // namespace

bool is_udim(const std::filesystem::path& file) { return file.filename().string().find(kPlace) != std::string::npos; }

std::vector<UdimTile> udim_tiles(const std::filesystem::path& pattern) {
    std::vector<UdimTile> tiles;
    const std::string name = pattern.filename().string();
    const auto place = name.find(kPlace);
    for (int number = kFirst; place != std::string::npos && number <= kLast; ++number) {
        auto tile = name;
        tile.replace(place, kPlace.size(), std::to_string(number));
        std::error_code code;
        if (std::filesystem::exists(pattern.parent_path() / tile, code))
            tiles.push_back({pattern.parent_path() / tile, (number - kFirst) % kColumns, (number - kFirst) / kColumns});
    }
    return tiles;
}

UdimSpan udim_span(const std::vector<UdimTile>& tiles) {
    UdimSpan span;
    for (const auto& tile : tiles) {
        span.columns = std::max(span.columns, tile.column + 1);
        span.rows = std::max(span.rows, tile.row + 1);
    }
    return span;
}

}  // namespace wrinkle::io
