#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/gbuffer_reader.h"
#include "io/image_writer.h"
#include "run/pass_impl.h"

namespace wrinkle {

/// Throws Error when a picture would replace a file that the scene is made of. To be asked before anything runs.
void check_outputs(const Scene& scene, const GBufferReader& reader, const std::filesystem::path& directory,
                   std::optional<int> frame);

/// Files that a frame of the scene is read from; not all of the names need be those of files.
std::vector<std::filesystem::path> inputs_of(const Scene& scene, const GBufferReader& reader, int frame);

/// The files that one frame becomes: normal.exr (with what else the scene wants), normal.png, lit.exr, lit.png, and
/// before.png where a picture is relit, by the names that run/output_names.h gives them. Nothing is seen under these
/// names before finish().
class FrameOutputs {
public:
    FrameOutputs(const Scene& scene, const Pass::Impl& pass, const GBufferReader& reader,
                 const std::filesystem::path& directory, std::optional<int> frame, const std::string& provenance = {});

    /// One EXR file of all that the pass writes: of accumulated decals, gradients in world space.
    static FrameOutputs single(const std::filesystem::path& file, const Scene& scene, const Pass::Impl& pass,
                               const GBufferReader& reader, const std::string& provenance);

    /// Planes of the input that go into the output untouched.
    const std::vector<std::string>& passed_planes() const { return passed_; }

    /// Rows from planes by name: inputs as they are called, outputs as "out:NAME".
    void write(std::uint32_t begin, std::uint32_t end, const std::map<std::string, const float*>& planes);

    void finish(std::vector<std::filesystem::path>& files);

private:
    FrameOutputs() = default;

    struct File {
        std::filesystem::path path;
        std::vector<std::string> planes;
        ImageWriter writer;
        std::uint32_t scale = 1;  ///< pixels of the frame along each side of one of its own
    };

    std::vector<File> files_;
    std::size_t width_ = 0;  ///< of the rows that come
    std::vector<std::string> passed_;
};

}  // namespace wrinkle
