#include "run/output_names.h"

#include <algorithm>

#include "io/frame_path.h"

namespace wrinkle {
namespace {

constexpr std::string_view kPicture = "<picture>";

}  // namespace

OutputNames::OutputNames(const Scene& scene, std::filesystem::path directory, std::optional<int> frame)
    : directory_(std::move(directory)),
      frame_(frame),
      name_(scene.output.name),
      pattern_(frame ? "<picture>.####.exr" : "<picture>.exr"),
      lit_(scene.lighting.relight != Relight::off),
      ratio_(scene.lighting.relight == Relight::ratio) {
    single_ = !name_.empty() && name_.find(kPicture) == std::string::npos;
    if (!name_.empty() && !single_) pattern_ = name_;
    if (scene.output.png != 0) pictures_ = scene.output.pictures;
}

bool OutputNames::wants(const std::string& picture) const {
    if ((picture == "lit" && !lit_) || (picture == "before" && !ratio_)) return false;
    return std::ranges::find(pictures_, picture) != pictures_.end();
}

std::vector<std::filesystem::path> OutputNames::all() const {
    std::vector<std::filesystem::path> files{exr("normal")};
    if (lit_ && !single_) files.push_back(exr("lit"));
    for (const char* picture : {"normal", "lit", "before"})
        if (wants(picture)) files.push_back(png(picture));
    return files;
}

std::filesystem::path OutputNames::path(const std::string& name, const std::string& picture,
                                        const char* extension) const {
    std::string filled = name;
    if (const auto place = filled.find(kPicture); place != std::string::npos)
        filled.replace(place, kPicture.size(), picture);
    if (frame_) filled = with_frame(filled, *frame_);
    const std::filesystem::path file = directory_ / filled;
    return *extension == '\0' ? file : std::filesystem::path(file).replace_extension(extension);
}

}  // namespace wrinkle
