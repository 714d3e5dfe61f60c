#include "io/provenance.h"

#include <OpenImageIO/hash.h>
#include <sys/stat.h>

#include <fmt/format.h>
#include <vector>

#include "io/image_open.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

namespace {

bool ends_as_png(const InputFile& file) {
    constexpr std::string_view last_chunk("\0\0\0\0IEND\xae\x42\x60\x82", 12);
    std::string end(last_chunk.size(), ' ');
    return file.size() >= end.size() && file.read_at(file.size() - end.size(), end.data(), end.size()) == end.size() &&
           end == last_chunk;
}

}  // namespace

struct Provenance::Impl {
    OIIO::SHA1 hash;
};

Provenance::Provenance() : impl_(std::make_unique<Impl>()) {}
Provenance::~Provenance() = default;

void Provenance::add(std::string_view text) {
    const auto size = static_cast<std::uint64_t>(text.size());  // first, so that "ab", "c" is not "a", "bc"
    impl_->hash.append(&size, sizeof size);
    impl_->hash.append(text.data(), text.size());
}

void Provenance::add_file(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
    add(fmt::format("{} {} {}.{:09}", file.filename().string(), status.st_size, status.st_mtim.tv_sec,
                    status.st_mtim.tv_nsec));
}

std::string Provenance::digest() { return impl_->hash.digest(); }

bool is_finished(const std::filesystem::path& file, const std::string& provenance) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return false;
    try {
        const OpenImage image(file);
        const OIIO::ImageSpec spec = image.input().spec(0);
        if (spec.get_string_attribute(kProvenance) != provenance) return false;
        if (image.input().format_name() == std::string_view("png")) return ends_as_png(*image.file());
        std::vector<float> row(static_cast<std::size_t>(spec.width));
        const int last = spec.y + spec.height - 1;
        return image.input().read_scanlines(0, 0, last, last + 1, 0, 0, 1, OIIO::TypeFloat, row.data());
    } catch (const Error&) { return false; }
}

}  // namespace wrinkle::io
