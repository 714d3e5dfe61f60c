#include "io/image_format.h"

#include <array>

#include "base/names.h"

namespace wrinkle::io {
namespace {

using namespace std::string_view_literals;

struct Magic {
    std::string_view bytes, format;
    std::size_t at = 0;
};

constexpr Magic kMagic[] = {
    {"\x76\x2f\x31\x01"sv, "openexr"},
    {"\x89PNG\r\n\x1a\n"sv, "png"},
    {"\xff\xd8\xff"sv, "jpeg"},
    {"II\x2a\0"sv, "tiff"},
    {"MM\0\x2a"sv, "tiff"},
    {"II\x2b\0"sv, "tiff"},  // more than 4 GB
    {"MM\0\x2b"sv, "tiff"},
    {"#?"sv, "hdr"},
    {"SDPX"sv, "dpx"},
    {"XPDS"sv, "dpx"},
    {"8BPS"sv, "psd"},
    {"DDS "sv, "dds"},
    {"WEBP"sv, "webp", 8},
    {"\0\0\0\x0cjP  \r\n\x87\n"sv, "jpeg2000"},
    {"BM"sv, "bmp"},
};

bool is_pnm(std::string_view start) {
    return start.size() >= 3 && start[0] == 'P' && "123456Ff"sv.find(start[1]) != std::string_view::npos &&
           (start[2] == '\n' || start[2] == ' ' || start[2] == '\r' || start[2] == '\t');
}

}  // namespace

std::string_view image_format(const InputFile& file) {
    std::array<char, 16> bytes{};
    const std::string_view start(bytes.data(), file.read_at(0, bytes.data(), bytes.size()));
    for (const auto& magic : kMagic)
        if (start.size() >= magic.at + magic.bytes.size() && start.substr(magic.at).starts_with(magic.bytes))
            return magic.format;
    if (is_pnm(start)) return "pnm";
    const bool targa = lower(file.path().extension().string()) == ".tga";  // it has no magic bytes
    return targa ? "targa" : "";
}

}  // namespace wrinkle::io
