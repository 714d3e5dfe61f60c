#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/names.h"
#include "functions/tables.h"
#include "io/volume_file.h"
#include "resources/frame_constants.h"
#include "resources/texture_heap.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

using Kind = Setting::Kind;

constexpr std::size_t kLatticeOctaves = 16;
constexpr std::size_t kFrameNumbers = sizeof(wr_camera) / sizeof(double),
                      kRowNumbers = sizeof(wr_projector) / sizeof(double);

/// Numbers that a value of this kind has; {0, 0} where it is not made of numbers.
struct Count {
    std::size_t least, most;
};
Count numbers_of(Kind kind) {
    switch (kind) {
        case Kind::number:
            return {1, 1};
        case Kind::vector:
            return {3, 3};
        case Kind::lattice:
            return {2, 2};
        case Kind::projector:
            return {13, 19};
        default:
            return {0, 0};
    }
}

template <class Struct>
void append(std::vector<double>& to, const Struct& from) {
    const auto* numbers = reinterpret_cast<const double*>(&from);
    to.insert(to.end(), numbers, numbers + sizeof(Struct) / sizeof(double));
}

wr_projector row_of(const std::vector<double>& v) {
    const auto three = [&](std::size_t i) { return Vec3{v[i], v[i + 1], v[i + 2]}; };
    Projector row{.center = three(1), .axis_x = three(4), .axis_y = three(7), .half_size = three(10)};
    row.shape = v[0] == 2 ? ProjectorShape::cone : v[0] == 1 ? ProjectorShape::sphere : ProjectorShape::box;
    row.falloff = v.size() > 15 ? three(13) : Vec3{};
    row.angle_fade = v.size() > 17 ? std::array{v[16], v[17]} : std::array{-2.0, -1.0};
    row.two_sided = v.size() > 18 && v[18] != 0;
    return projector_constants(row, {.texture = 0, .height = true}, 1, {});
}

/// Throws unless every number is finite, in the setting's range, and whole where it must be; and the half sizes of a
/// projector, which the region is divided by, are above 0.
void check_range(const Function& function, const Setting& setting, const std::vector<double>& numbers) {
    const auto fail = [&](double found, const std::string& expected) {
        throw Error(
            fmt::format("{}: the setting \"{}\" holds {}; expected {}", function.name, setting.name, found, expected));
    };
    for (const double number : numbers)
        if (!std::isfinite(number) || number < setting.least || number > setting.most ||
            (setting.whole && number != std::floor(number)))
            fail(number, range_text(setting).empty() ? "a finite number" : range_text(setting));
    if (setting.kind != Kind::projector) return;
    constexpr std::size_t half_size = 10;
    for (std::size_t i = half_size; i < half_size + 3; ++i)
        if (numbers[i] <= 0) fail(numbers[i], "a half_size above 0");
}

/// FILE, or FILE#GRID.
PlannedTexture volume_of(const std::filesystem::path& name, Kind kind) {
    const std::string text = name.string();
    const std::size_t hash = std::filesystem::exists(name) ? std::string::npos : text.rfind('#');
    const std::string file = text.substr(0, hash), grid = hash == std::string::npos ? "" : text.substr(hash + 1);
    const VolumeInfo info = volume_info(file, grid);
    if ((info.channels == 3) != (kind == Kind::vector_volume))
        throw Error(fmt::format("{}: the grid {} holds {}; {} are expected", file, quote(info.grid),
                                info.channels == 3 ? "vectors" : "numbers",
                                info.channels == 3 ? "numbers" : "vectors"));
    return {.use = {.file = file},
            .kind = kind == Kind::smooth_volume ? TexelKind::volume_smooth : TexelKind::volume,
            .grid = grid,
            .vectors = info.channels == 3};
}

void append_lattice(std::vector<double>& to, double frequency, double lacunarity) {
    for (std::size_t i = 0; i < kLatticeOctaves; ++i, frequency *= lacunarity)
        to.insert(to.end(), {0, 0, 0, frequency});
}

}  // namespace

const char* wanted_text(Setting::Kind kind) {
    switch (kind) {
        case Kind::number:
            return "a number";
        case Kind::vector:
            return "3 numbers";
        case Kind::camera:
            return "a camera and the frame's size";
        case Kind::height_texture:
        case Kind::slope_texture:
            return "an image file";
        case Kind::volume:
        case Kind::smooth_volume:
            return "a volume file (.vdb, .nvdb), or FILE#GRID";
        case Kind::vector_volume:
            return "a volume file of vectors (.vdb, .nvdb), or FILE#GRID";
        case Kind::projector:
            return "13 numbers (shape 0 box, 1 sphere, 2 cone; center, axis_x, axis_y, half_size), or up to 19 "
                   "(falloff x, y, z, 2 cosines of the angle fade, two_sided)";
        case Kind::lattice:
            return "2 numbers, the frequency of the first octave and the lacunarity";
    }
    return "";
}

std::string range_text(const Setting& setting) {
    const char* const number = setting.whole ? "whole numbers" : "numbers";
    if (setting.most < std::numeric_limits<double>::max())
        return fmt::format("{} from {} to {}", number, setting.least, setting.most);
    if (setting.least > std::numeric_limits<double>::lowest()) return fmt::format("{} from {}", number, setting.least);
    return "";
}

SettingSize size_of(const Setting& setting) {
    switch (setting.kind) {
        case Kind::vector:
            return {3, 0};
        case Kind::camera:
            return {kFrameNumbers, 0};
        case Kind::projector:
            return {0, kRowNumbers};
        case Kind::lattice:
            return {4 * kLatticeOctaves, 0};
        default:
            return {1, 0};  // a number, or the number of a texture
    }
}

ColumnData column_data(const Function& function, const std::map<std::string, SettingValue>& values,
                       const DeviceInfo& device) {
    std::vector<std::string> known;
    for (const Setting& setting : function.settings) known.push_back(setting.name);
    for (const auto& [name, value] : values)
        if (std::ranges::find(known, name) == known.end())
            throw Error(fmt::format("{} has no setting \"{}\"{}", function.name, name, did_you_mean(name, known)));
    ColumnData data;
    std::vector<PlannedTexture> textures;
    for (const Setting& setting : function.settings) {
        const auto found = values.find(setting.name);
        if (found == values.end() && setting.standard.empty())
            throw Error(fmt::format("{} needs the setting \"{}\": {}, {}", function.name, setting.name,
                                    wanted_text(setting.kind), setting.meaning));
        const SettingValue value = found == values.end() ? SettingValue{setting.standard} : found->second;
        const auto* numbers = std::get_if<std::vector<double>>(&value);
        const auto* camera = std::get_if<CameraSetting>(&value);
        const auto* file = std::get_if<std::filesystem::path>(&value);
        const Count count = numbers_of(setting.kind);
        const bool fits = setting.kind == Kind::camera ? camera != nullptr
                          : count.most == 0
                              ? file != nullptr
                              : numbers && numbers->size() >= count.least && numbers->size() <= count.most;
        if (!fits)
            throw Error(fmt::format("{}: the setting \"{}\" must be {}", function.name, setting.name,
                                    wanted_text(setting.kind)));
        if (numbers) check_range(function, setting, *numbers);
        switch (setting.kind) {
            case Kind::number:
            case Kind::vector:
                data.constants.insert(data.constants.end(), numbers->begin(), numbers->end());
                break;
            case Kind::lattice:
                append_lattice(data.constants, (*numbers)[0], (*numbers)[1]);
                break;
            case Kind::camera:
                append(data.constants, camera_constants(camera->camera, camera->size));
                break;
            case Kind::projector:
                append(data.records, row_of(*numbers));
                break;
            case Kind::height_texture:
            case Kind::slope_texture:
                data.constants.push_back(static_cast<double>(textures.size()));
                textures.push_back(
                    {{.file = *file}, setting.kind == Kind::slope_texture ? TexelKind::slope : TexelKind::height});
                break;
            case Kind::volume:
            case Kind::smooth_volume:
            case Kind::vector_volume:
                data.constants.push_back(static_cast<double>(textures.size()));
                textures.push_back(volume_of(*file, setting.kind));
                break;
        }
    }
    if (!textures.empty()) {
        TextureHeap heap = load_textures(textures);
        check_fits(heap, device);
        data.texels = std::move(heap.texels);
        data.textures = std::move(heap.table);
    }
    return data;
}

ColumnKernel column_kernel(const Function& function, const FunctionVariant& variant) {
    ColumnKernel kernel;
    SettingSize at;
    for (const Setting& setting : function.settings) {
        const std::string here = fmt::format("constants + {}", at.constants);
        std::string value;
        switch (setting.kind) {
            case Kind::number:
                value = fmt::format("WR_SCALAR {} = constants[{}]", setting.name, at.constants);
                break;
            case Kind::vector:
                value = fmt::format("wr_vec3 {} = wr_v3({})", setting.name, here);
                break;
            case Kind::lattice:
                value = fmt::format("constant const WR_SCALAR *{} = {}", setting.name, here);
                break;
            case Kind::camera:
                value =
                    fmt::format("constant const wr_camera *{} = (constant const wr_camera *)({})", setting.name, here);
                break;
            case Kind::projector:
                value = fmt::format("global const wr_projector *{} = (global const wr_projector *)(records + {})",
                                    setting.name, at.records);
                break;
            case Kind::height_texture:
            case Kind::slope_texture:
                value = fmt::format("wr_texture {} = wr_texture_at(texels, textures, (uint)constants[{}])",
                                    setting.name, at.constants);
                break;
            case Kind::volume:
            case Kind::smooth_volume:
            case Kind::vector_volume:
                value = fmt::format("wr_volume {} = wr_volume_at(texels, textures, (uint)constants[{}])", setting.name,
                                    at.constants);
                break;
        }
        kernel.body += fmt::format("    {};\n", value);
        const SettingSize size = size_of(setting);
        at.constants += size.constants, at.records += size.records;
    }
    for (const Result& result : function.results) {
        const char* const types[] = {"wr_real", "wr_vec2", "wr_vec3"};
        kernel.body += fmt::format("    {} {};\n", types[static_cast<int>(result.shape)], result.name);
        for (const std::string& column : result.columns()) kernel.outputs.push_back(column);
    }
    kernel.body += "    " + variant.text;
    return kernel;
}

}  // namespace wrinkle
