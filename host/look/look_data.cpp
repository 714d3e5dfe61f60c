#include "look/look_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "layers/kinds.h"
#include "look/look_picture.h"

namespace wrinkle {

using nlohmann::json;

json views_of(const LookImage& image, const std::function<std::string(const std::string&)>& url) {
    struct View {
        const char *after, *before, *title, *note;
    };
    static constexpr View views[] = {
        {"lit", "before", "picture", ""},
        {"normal", "base_normal", "normals", "world space, (n + 1) / 2"},
        {"roughness", nullptr, "roughness", "of the frame or the scene, widened by the bumps within a pixel"},
        {"condition", nullptr, "condition",
         "by how much the normal magnifies errors of the inputs: black 1, white a million, in powers of ten"},
        {"marked", nullptr, "marked", ""},
    };
    const std::vector<std::string> names = picture_names(image);
    const auto has = [&](const char* name) { return name != nullptr && std::ranges::find(names, name) != names.end(); };
    json out = json::array();
    for (const View& view : views) {
        if (!has(view.after)) continue;
        out.push_back({{"id", view.after}, {"title", view.title}, {"note", view.note}, {"after", url(view.after)}});
        if (has(view.before)) out.back()["before"] = url(view.before);
    }
    return out;
}

json layers_of(const Scene& scene) {
    json out = json::array();
    for (const Layer& layer : scene.layers)
        out.push_back(
            {{"name", layer.name}, {"kind", layer.kind()}, {"resolve", kind_of(layer_kinds(), layer).ends_stage}});
    return out;
}

json marked_legend() {
    json out = json::array();
    for (const MarkedColor& mark : kMarkedColors) out.push_back({{"color", mark.color}, {"meaning", mark.meaning}});
    return out;
}

json problems_of(const std::string& message, const std::string& file) {
    json out = json::array();
    std::istringstream lines(message);
    for (std::string text; std::getline(lines, text);) {
        std::size_t line = 0, from = 0;
        if (text.starts_with(file + ":"))
            for (from = file.size() + 1;
                 from < text.size() && std::isdigit(static_cast<unsigned char>(text[from])) != 0; ++from)
                line = line * 10 + static_cast<std::size_t>(text[from] - '0');
        if (line != 0)
            out.push_back(
                {{"line", line}, {"text", text.substr(std::min(text.find_first_not_of(": ", from), text.size()))}});
        else if (!out.empty() && text.starts_with(" "))  // goes on
            out.back()["text"] = out.back()["text"].get<std::string>() + "\n" + text;
        else
            out.push_back({{"line", 0}, {"text", text}});
    }
    return out;
}

}  // namespace wrinkle
