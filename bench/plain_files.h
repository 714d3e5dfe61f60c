#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace wrinkle::bench {

/// The files of a run as a program would read and write them that does nothing else: channels of a frame by OpenEXR,
/// EXR pictures by OpenEXR with the headers of the given ones, PNG pictures by libpng (through OpenImageIO) at its
/// level 1; on as many threads as there are cores, of which a PNG takes one.
class PlainFiles {
public:
    /// `pictures`: a folder of EXR and PNG files, which are read here. Throws Error.
    PlainFiles(std::filesystem::path frame, std::vector<std::string> channels, const std::filesystem::path& pictures);
    ~PlainFiles();
    PlainFiles(const PlainFiles&) = delete;
    PlainFiles& operator=(const PlainFiles&) = delete;

    /// Reads the frame's channels, then writes all pictures into `folder`.
    void run(const std::filesystem::path& folder);

private:
    struct Exr;
    struct Png;
    std::filesystem::path frame_;
    std::vector<std::string> channels_;
    std::vector<std::unique_ptr<Exr>> exrs_;
    std::vector<std::unique_ptr<Png>> pngs_;
};

}  // namespace wrinkle::bench
