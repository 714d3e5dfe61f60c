#include "plain_files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <thread>

#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

namespace fs = std::filesystem;

std::size_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

}  // namespace

/// A picture's header, and its channels one after another.
struct PlainFiles::Exr {
    fs::path name;
    Imf::Header header;
    std::vector<std::vector<char>> planes;

    explicit Exr(const fs::path& file) : name(file.filename()) {
        Imf::InputFile in(file.c_str());
        header = in.header();
        in.setFrameBuffer(buffer());
        in.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
    }

    void write(const fs::path& folder) {
        Imf::OutputFile out((folder / name).c_str(), header);
        out.setFrameBuffer(buffer());
        out.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
    }

private:
    Imf::FrameBuffer buffer() {
        const Imath::Box2i& window = header.dataWindow();
        const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
        const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
        Imf::FrameBuffer buffer;
        std::size_t count = 0;
        for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel, ++count) {
            const std::size_t bytes = bytes_of(channel.channel().type);
            if (count == planes.size()) planes.emplace_back(width * height * bytes);
            buffer.insert(channel.name(),
                          Imf::Slice::Make(channel.channel().type, planes[count].data(), window, bytes, bytes * width));
        }
        return buffer;
    }
};

struct PlainFiles::Png {
    fs::path name;
    OIIO::ImageSpec spec;
    std::vector<unsigned char> pixels;

    explicit Png(const fs::path& file) : name(file.filename()) {
        const auto in = OIIO::ImageInput::open(file.string());
        if (!in) throw Error(fmt::format("cannot read {}", file.string()));
        spec = in->spec();
        spec.attribute("png:compressionLevel", 1);
        pixels.resize(spec.image_bytes());
        in->read_image(0, 0, 0, -1, spec.format, pixels.data());
    }

    void write(const fs::path& folder) const {
        const auto out = OIIO::ImageOutput::create("png");
        if (!out || !out->open((folder / name).string(), spec) || !out->write_image(spec.format, pixels.data()) ||
            !out->close())
            throw Error(fmt::format("cannot write {}", (folder / name).string()));
    }
};

PlainFiles::PlainFiles(fs::path frame, std::vector<std::string> channels, const fs::path& pictures)
    : frame_(std::move(frame)), channels_(std::move(channels)) {
    Imf::setGlobalThreadCount(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
    for (const auto& entry : fs::directory_iterator(pictures)) {
        if (entry.path().extension() == ".exr") exrs_.push_back(std::make_unique<Exr>(entry.path()));
        if (entry.path().extension() == ".png") pngs_.push_back(std::make_unique<Png>(entry.path()));
    }
}

PlainFiles::~PlainFiles() = default;

void PlainFiles::run(const fs::path& folder) {
    fs::create_directories(folder);
    Imf::InputFile in(frame_.c_str());
    const Imath::Box2i& window = in.header().dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
    std::vector<std::vector<float>> planes;
    planes.reserve(channels_.size());
    Imf::FrameBuffer buffer;
    for (const std::string& channel : channels_) {
        planes.emplace_back(width * height);
        buffer.insert(channel,
                      Imf::Slice::Make(Imf::FLOAT, planes.back().data(), window, sizeof(float), sizeof(float) * width));
    }
    in.setFrameBuffer(buffer);
    in.readPixels(window.min.y, window.max.y);
    for (const auto& exr : exrs_) exr->write(folder);
    // Several at a time, in turns of as many as there are cores.
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    for (std::size_t first = 0; first < pngs_.size(); first += cores) {
        std::vector<std::jthread> threads;
        for (std::size_t k = first; k < std::min(first + cores, pngs_.size()); ++k)
            threads.emplace_back([&, k] { pngs_[k]->write(folder); });
    }
}

}  // namespace wrinkle::bench
