#include "cli/eval_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/names.h"
#include "io/camera_json.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

std::vector<double> numbers_of(const std::string& text, const std::string& name) {
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        double number = 0;
        const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);
        if (error != std::errc() || stop != text.data() + end)
            throw CLI::ValidationError("--set " + name,
                                       fmt::format("{} is no number", quote(text.substr(begin, end - begin))));
        numbers.push_back(number);
        begin = end + 1;
    }
    return numbers;
}

CameraSetting camera_of(const std::filesystem::path& file, std::optional<Size> size, const std::string& name) {
    if (!size) size = io::camera_json_size(file);
    if (!size) throw Error(fmt::format("--set {}: {} has no width and height; give --size", name, file.string()));
    return {io::read_camera_json(file, *size), *size};
}

}  // namespace

EvalFile parse_eval_file(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const bool named = equals != std::string::npos && !name.empty() &&
                       std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
    if (!named) return {{}, text, {}};
    const std::string rest = text.substr(equals + 1), lowered = lower(rest);
    const std::size_t colon = lowered.rfind(".exr:");
    if (colon == std::string::npos) return {name, rest, {}};
    return {name, rest.substr(0, colon + 4), rest.substr(colon + 5)};
}

Size parse_size(const std::string& text) {
    Size size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = cross ? std::from_chars(width.ptr + 1, end, size.height) : width;
    if (!cross || height.ec != std::errc() || height.ptr != end || size.width == 0 || size.height == 0)
        throw CLI::ValidationError("--size", fmt::format("\"{}\" is no size; expected WIDTHxHEIGHT", text));
    return size;
}

std::map<std::string, SettingValue> parse_settings(const Function& function, const std::vector<std::string>& texts,
                                                   std::optional<Size> size) {
    std::vector<std::string> known;
    for (const Setting& setting : function.settings) known.push_back(setting.name);
    std::map<std::string, SettingValue> values;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw CLI::ValidationError("--set", fmt::format("\"{}\" is not NAME=VALUE", text));
        const std::string name = text.substr(0, equals), value = text.substr(equals + 1);
        const auto setting = std::ranges::find(function.settings, name, &Setting::name);
        if (setting == function.settings.end())
            throw Error(fmt::format("{} has no setting {}{}", function.name, quote(name),
                                    known.empty() ? "; it has none" : did_you_mean(name, known)));
        if (values.contains(name)) throw Error(fmt::format("the setting \"{}\" is given twice", name));
        switch (setting->kind) {
            case Setting::Kind::camera:
                values[name] = camera_of(value, size, name);
                break;
            case Setting::Kind::height_texture:
            case Setting::Kind::slope_texture:
            case Setting::Kind::volume:
            case Setting::Kind::smooth_volume:
            case Setting::Kind::vector_volume:
                values[name] = std::filesystem::path(value);
                break;
            default:
                values[name] = numbers_of(value, name);
        }
    }
    return values;
}

}  // namespace wrinkle::cli
