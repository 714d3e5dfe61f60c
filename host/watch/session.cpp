#include "watch/session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/only_errors.h"
#include "base/text_file.h"
#include "io/frame_path.h"
#include "io/udim.h"
#include "layers/kinds.h"
#include "look/look_data.h"
#include "look/page.h"
#include "tools/frame_warnings.h"
#include "watch/pixel_data.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<fs::path> with_tiles(const std::vector<fs::path>& files) {
    std::vector<fs::path> out = files;
    for (const fs::path& file : files)
        for (const io::UdimTile& tile : io::udim_tiles(file)) out.push_back(tile.file);
    return out;
}

std::string text_of(const fs::path& scene) {
    if (scene == "-") throw Error("standard input cannot be watched; give the scene as a file");
    return read_text(scene, "a scene file");
}

std::vector<fs::path> files_of_frame(const scene::SceneFile& scene, int frame) {
    std::vector<fs::path> out;
    for (const fs::path& file : scene.kept_files) out.push_back(frame_path(file, frame));
    if (const auto beside = camera_beside(frame_path(scene.scene.gbuffer.file, frame))) out.push_back(*beside);
    return out;
}

/// What layers have opened with the frame, as text.
std::string opened_by_layers(const Scene& scene) {
    std::string text;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const LayerKind& kind = kind_of(layer_kinds(), scene.layers[i]);
        if (const auto source = kind.vectors ? kind.vectors(scene.layers[i]) : std::nullopt)
            text += fmt::format("{} {} {} {} {}\n", i, source->file.string(), source->layer,
                                fmt::join(source->channels, " "), source->camera_space);
    }
    return text;
}

}  // namespace

WatchSession::WatchSession(const fs::path& scene, std::optional<int> frame, const std::string& device)
    : path_(scene), frame_(frame), look_(Device::open(device)), text_(text_of(scene)) {
    stamps_.know({&path_, 1});
}

void WatchSession::look_at_files() {
    if (stamps_.changed({&path_, 1})) {
        try {
            const std::string text = read_text(path_, "a scene file");
            if (text != text_) {
                text_ = text;
                numbers_.clear();  // they were meant for the text as it was
                due_ = true;
            }
        } catch (const Error&) {
            // An editor is about to put the new file into its place, which shows by another stamp.
        }
    }
    if (stamps_.changed(textures_)) {
        look_.forget_textures();
        due_ = true;
    }
    if (stamps_.changed(frames_)) due_ = reopen_ = true;
    constexpr double again = 1;  // second: a file that was missing is not among those looked at
    if (unloaded_ && seconds_since(tried_) > again) due_ = true;
}

void WatchSession::load() {
    const std::string text = scene::with_numbers(text_, numbers_);
    scene::SceneFile file = scene::load_scene_text(layer_kinds(), text, path_, {.frame = frame_});
    file_ = std::move(file);
    shown_numbers_ = scene::numbers_in(text);
    textures_ = with_tiles(file_.files);
    frames_ = files_of_frame(file_, frame_.value_or(0));
    stamps_.know(textures_);
    stamps_.know(frames_);
    std::string tables = scene::frame_tables(text) + opened_by_layers(file_.scene);
    if (reopen_ || tables != frame_tables_) {
        look_.open(file_.scene, frame_.value_or(0));
        frame_tables_ = std::move(tables);
        reopen_ = false;
        doubt_ = true;
    }
}

bool WatchSession::evaluate() {
    if (!due_) return false;
    due_ = false;
    const std::string before = error_;
    const bool retried = unloaded_;
    const auto start = tried_ = Clock::now();
    try {
        only_errors(path_.c_str(), [&] {
            unloaded_ = true;
            load();
            unloaded_ = false;
            std::set<std::size_t> off;
            for (std::size_t i = 0; i < file_.scene.layers.size(); ++i)
                if (off_.contains(file_.scene.layers[i].name)) off.insert(i);
            image_ = look_.evaluate(file_.scene, off, condition_);
        });
        if (image_->built || doubt_) {
            warnings_ = frame_warnings(file_.scene, look_.reader(), look_.camera());
            warnings_.insert(warnings_.end(), look_.doubts().begin(), look_.doubts().end());
            doubt_ = false;
        }
        error_.clear();
        seconds_ = seconds_since(start);
    } catch (const Error& error) {
        error_ = error.what();
        if (retried && error_ == before) return false;
    }
    ++version_;
    return true;
}

void WatchSession::set_numbers(const std::map<std::string, double>& numbers) {
    for (const auto& [id, value] : numbers) numbers_[id] = value;
    due_ = true;
}

void WatchSession::switch_off(std::set<std::string> layers) {
    off_ = std::move(layers);
    due_ = true;
}

void WatchSession::want_condition(bool wanted) {
    due_ |= wanted && !condition_;
    condition_ = wanted;
}

void WatchSession::write_numbers() {
    if (read_text(path_, "a scene file") != text_)
        throw Error(
            fmt::format("{} was changed meanwhile; look at it again before numbers are written", path_.string()));
    std::string text = scene::with_numbers(text_, numbers_);
    scene::load_scene_text(layer_kinds(), text, path_, {.frame = frame_});  // refuses what the scene may not hold
    AtomicFile file(path_);
    file.write(text);
    file.commit();
    text_ = std::move(text);
    numbers_.clear();
    due_ = true;
}

std::string WatchSession::pixel(std::uint32_t x, std::uint32_t y) {
    if (!image_ || x >= image_->size.width || y >= image_->size.height) throw Error("there is no such pixel");
    return page_json(pixel_data(*image_, look_.pixel(x, y), x, y));
}

std::string WatchSession::state() const {
    json numbers = json::array();
    std::map<std::string, double> saved;
    std::string source = text_;
    try {
        for (const scene::SceneNumber& number : scene::numbers_in(text_)) saved[number.id] = number.value;
        source = scene::with_numbers(text_, numbers_);
    } catch (const Error&) {
        // the problems say so
    }
    for (const scene::SceneNumber& number : shown_numbers_) {
        const auto file = saved.find(number.id);
        numbers.push_back({{"id", number.id},
                           {"group", number.group},
                           {"name", number.name},
                           {"line", number.line},
                           {"value", number.value},
                           {"saved", file != saved.end() ? file->second : number.value},
                           {"whole", number.whole}});
    }
    json out = {{"title", path_.filename().string()},
                {"version", version_},
                {"views", json::array()},
                {"layers", layers_of(file_.scene)},
                {"off", off_},
                {"marked", marked_legend()},
                {"problems", problems_of(error_, path_.string())},
                {"warnings", warnings_},
                {"source", source},
                {"tables", json::array()},
                {"numbers", numbers},
                {"unsaved", !numbers_.empty()},
                {"status", error_.empty() ? "building the kernel, which takes seconds the first time" : ""}};
    if (!image_) return page_json(out);
    out["size"] = {image_->size.width, image_->size.height};
    out["status"] =
        fmt::format("{} x {}, {:.0f} ms, {:.0f} of them in the pass{}", image_->size.width, image_->size.height,
                    1000 * seconds_, 1000 * image_->kernel_seconds, image_->built ? ", which was built anew" : "");
    out["views"] = views_of(
        *image_, [&](const std::string& picture) { return fmt::format("/picture/{}?v={}", picture, version_); });
    if (!image_->out.contains("condition"))
        out["views"].push_back(
            {{"id", "condition"},
             {"title", "condition"},
             {"note", "is being evaluated; the kernel in double that it takes may be a minute in the building"},
             {"after", ""}});
    return page_json(out);
}

WatchBoard::Shown WatchSession::shown() const { return {version_, state(), image_}; }

}  // namespace wrinkle
