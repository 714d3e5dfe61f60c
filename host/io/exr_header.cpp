#include "io/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/claim.h"
#include "base/names.h"
#include "io/input_proxy.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

constexpr std::uint32_t kSeveralParts = 0x1000;  // a bit of the version field
constexpr std::size_t kLongestName = 255;

/// Attributes that decide where in the file which pixels are.
constexpr std::array<std::string_view, 9> kLayout{"channels", "compression", "dataWindow", "displayWindow", "lineOrder",
                                                  "tiles",    "type",        "chunkCount", "version"};

/// Types of attributes that have a fixed size, in bytes. OpenEXR always reads that many bytes, even where the header
/// states another size, and would then take the wrong bytes for the next attribute.
constexpr std::pair<std::string_view, std::int32_t> kSizes[] = {{"box2i", 16},
                                                                {"box2f", 16},
                                                                {"chromaticities", 32},
                                                                {"compression", 1},
                                                                {"deepImageState", 1},
                                                                {"double", 8},
                                                                {"envmap", 1},
                                                                {"float", 4},
                                                                {"int", 4},
                                                                {"keycode", 28},
                                                                {"lineOrder", 1},
                                                                {"m33f", 36},
                                                                {"m33d", 72},
                                                                {"m44f", 64},
                                                                {"m44d", 128},
                                                                {"rational", 8},
                                                                {"tiledesc", 9},
                                                                {"timecode", 8},
                                                                {"v2i", 8},
                                                                {"v2f", 8},
                                                                {"v2d", 16},
                                                                {"v3i", 12},
                                                                {"v3f", 12},
                                                                {"v3d", 24}};

struct Box {
    double width = 0, height = 0;
};

/// What the attributes of one part say. What is missing or malformed stays 0.
struct Stated {
    std::set<std::string, std::less<>> names;
    Box data, display, tile;
    double pixel_bytes = 0;
    int compression = 0;
};

/// Rows that a block of each compression holds, and how many bytes one of it may become. In the order of EXR's numbers:
/// none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB. Where runs are coded twice there is no bound worth a name.
constexpr double kUnbounded = 1e5;
constexpr struct {
    int rows;
    double expansion;
} kCompressions[] = {{1, 1},   {1, 128}, {1, kDeflate},    {16, kDeflate},   {32, kUnbounded}, {16, kDeflate * 2},
                     {32, 32}, {32, 32}, {32, kUnbounded}, {256, kUnbounded}};

class Scan {
public:
    explicit Scan(std::shared_ptr<const InputFile> file) : file_(std::move(file)), bytes_(file_) {}

    void run() {
        std::uint32_t magic = 0, version = 0;
        if (!get(magic) || !get(version)) return;
        const bool several = (version & kSeveralParts) != 0;
        while (const auto part = read_part()) {
            if (part->names.empty()) return;  // an empty header ends the list
            check(*part);
            if (!several) return;
        }
    }

private:
    template <class T>
    bool get(T& value) {
        return bytes_.read(&value, sizeof value) == sizeof value;
    }

    /// Nothing when it is not closed within what names may be.
    std::optional<std::string> text() {
        std::string out;
        for (char c = 0; get(c); out += c) {
            if (c == '\0') return out;
            if (out.size() == kLongestName) break;
        }
        return {};
    }

    std::optional<Box> box() {
        std::array<std::int32_t, 4> b{};
        if (!get(b)) return {};
        return Box{1.0 + b[2] - b[0], 1.0 + b[3] - b[1]};
    }

    /// Bytes of a pixel. Stands behind the empty name that closes the list then; nothing: there is none before `end`,
    /// where OpenEXR would read on.
    std::optional<double> channels(std::int64_t end) {
        double bytes = 0;
        while (bytes_.tell() < end) {
            const auto name = text();
            if (!name) break;
            if (name->empty()) return bytes;
            std::array<std::int32_t, 4> fields{};  // type, linear and reserved, sampling along x and y
            if (!get(fields)) break;
            bytes += fields[0] == 1 ? 2 : 4;
        }
        return {};
    }

    /// Whether the value that begins here ends where the file says.
    bool fits(std::string_view type, std::int64_t end) {
        const std::int64_t size = end - bytes_.tell();
        if (type == "chlist") return channels(end).has_value() && bytes_.tell() == end;
        if (type == "stringvector") {
            std::uint32_t length = 0;
            while (bytes_.tell() < end && get(length)) bytes_.seek(bytes_.tell() + std::int64_t{length});
            return bytes_.tell() == end;
        }
        if (std::array<std::uint32_t, 2> sides{}; type == "preview")
            return get(sides) && 8 + 4.0 * sides[0] * sides[1] == static_cast<double>(size);
        const auto known = std::ranges::find(kSizes, type, &std::pair<std::string_view, std::int32_t>::first);
        return known == std::end(kSizes) || known->second == size;
    }

    /// Nothing where the file ends, or holds no header.
    std::optional<Stated> read_part() {
        Stated part;
        for (;;) {
            const auto name = text();
            if (!name) return {};
            if (name->empty()) return part;
            const auto type = text();
            std::int32_t size = 0;
            if (!type || !get(size)) return {};
            const std::int64_t from = bytes_.tell(), end = from + size;
            if (size < 0 || end > static_cast<std::int64_t>(file_->size()))
                throw Error(
                    fmt::format("{}: the attribute {} claims {} bytes, more than the file has: it is damaged or "
                                "cut short",
                                file_->name(), quote(*name), static_cast<std::uint32_t>(size)));
            if (!fits(*type, end))
                throw Error(
                    fmt::format("{}: the attribute {} is of type {}, whose values do not take {} bytes: "
                                "it is damaged",
                                file_->name(), quote(*name), quote(*type), size));
            bytes_.seek(from);
            if (!part.names.insert(*name).second && std::ranges::find(kLayout, *name) != kLayout.end())
                throw Error(
                    fmt::format("{}: the header has two attributes {}, and programs differ about which of them "
                                "counts: write the file anew",
                                file_->name(), quote(*name)));
            if (*name == "dataWindow") part.data = box().value_or(Box{});
            if (*name == "displayWindow") part.display = box().value_or(Box{});
            if (*name == "channels") part.pixel_bytes = channels(end).value_or(0);
            if (*name == "compression") part.compression = compression();
            if (std::array<std::uint32_t, 2> sides{}; *name == "tiles" && get(sides))
                part.tile = {1.0 * sides[0], 1.0 * sides[1]};
            bytes_.seek(end);
        }
    }

    int compression() {
        std::uint8_t number = 0;
        get(number);
        return number < std::size(kCompressions) ? number : 0;
    }

    void check(const Stated& part) const {
        const auto& how = kCompressions[part.compression];
        const auto claim = [&](const std::string& what, double wanted, double expansion) {
            check_claim(file_->name(), {what, wanted, file_->size(), expansion});
        };
        claim(fmt::format("rows of {:.0f} pixels", part.data.width),
              part.data.width * std::min<double>(how.rows, part.data.height) * part.pixel_bytes, how.expansion);
        // OpenImageIO reads 64 rows at a time, as they are and as floats, however few there are: of a sound frame, too.
        constexpr double kRowsAtATime = 64 * 2 * 2;
        claim(fmt::format("rows of {:.0f} pixels", part.data.width), kRowsAtATime * part.data.width * part.pixel_bytes,
              kRowsAtATime * how.expansion);
        claim(fmt::format("tiles of {:.0f}x{:.0f} pixels", part.tile.width, part.tile.height),
              part.tile.width * part.tile.height * part.pixel_bytes, how.expansion);
        // Of the rows that the data window leaves out there is nothing in the file, but each costs time.
        constexpr double kPixel = 4, kEmptyFrame = 1e5;
        claim(fmt::format("a frame of {:.0f}x{:.0f} pixels", part.display.width, part.display.height),
              part.display.width * part.display.height * kPixel, kEmptyFrame);
    }

    std::shared_ptr<const InputFile> file_;
    InputProxy bytes_;
};

}  // namespace

void check_exr_header(const std::shared_ptr<const InputFile>& file) { Scan(file).run(); }

}  // namespace wrinkle::io
