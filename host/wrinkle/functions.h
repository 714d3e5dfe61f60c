#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "wrinkle/camera.h"
#include "wrinkle/device.h"
#include "wrinkle/precision.h"

/// Every kernel function that can be asked by itself, described once: tests, benchmarks, `wrinkle eval` and the
/// reference page all read this table.
///
///     const wrinkle::Function& resolve = wrinkle::function("resolve");
///     std::cout << resolve.summary << " (" << resolve.source << ")\n";
///     const std::vector<float> zero(100), one(100, 1), slope(100, 0.75f);
///     std::vector<float> x(100), z(100);
///     wrinkle::Columns in{{"n.x", zero}, {"n.y", zero}, {"n.z", one}, {"g.y", zero}, {"g.z", zero}};
///     in["g.x"] = slope;
///     wrinkle::evaluate_function(wrinkle::Device::open(), resolve, in, {{"normal.x", x}, {"normal.z", z}});
///
/// Threads: all of it may be called from several at once, evaluate_function() on one Device too.
namespace [[gnu::visibility("default")]] wrinkle {

/// Columns of a parameter or result: `name`; `name.x`, `name.y`; `name.x`, `name.y`, `name.z`.
enum class Shape { number, pair, vector };

struct Parameter {
    std::string name;
    Shape shape = Shape::number;
    std::string unit;          ///< "metres per pixel, world"; "unit, world" for directions of length 1
    std::string meaning;       ///< "base normal"
    bool unit_length = false;  ///< of length 1 to the digits it is given in

    std::vector<std::string> columns() const;
};

/// Angle in degrees; relative vector error; absolute vector error; degrees between the normals that the surface
/// gradients got and wanted resolve to, on the parameter `n`.
enum class ErrorMeasure { degrees, relative, absolute, resolved_degrees };

struct Result : Parameter {
    std::vector<ErrorMeasure> measures;  ///< one at least
};

/// What is the same for all rows. Kernel text sees a number as a WR_SCALAR, a vector as a wr_vec3, a camera as
/// `constant const wr_camera *`, a texture as a wr_texture, a volume as a wr_volume, a projector as `global const
/// wr_projector *`, a lattice as the `constant const WR_SCALAR *` that fractal sums take.
struct Setting {
    enum class Kind {
        number,
        vector,          ///< 3 numbers
        camera,          ///< a camera file and the size of the frame
        height_texture,  ///< an image file: heights, as they are
        slope_texture,   ///< ... their slopes
        volume,          ///< a volume file, or FILE#GRID, for trilinear samples
        smooth_volume,   ///< ... for B-splines
        vector_volume,   ///< ... of 3-vectors; the others are of numbers
        projector,       ///< shape (0 box, 1 sphere, 2 cone), center, axis_x, axis_y, half_size: 13 numbers; then
                         ///< falloff x, y, z, angle_fade as cosines, two_sided (0, 1): 6 more
        lattice,         ///< frequency of the first octave, lacunarity
    };
    std::string name;
    Kind kind = Kind::number;
    std::string meaning;
    std::vector<double> standard{};  ///< the numbers when none are given; empty: must be given
    double least = -std::numeric_limits<double>::max(), most = std::numeric_limits<double>::max();  ///< of each number
    bool whole = false;
};

/// A way to compute the same results.
struct FunctionVariant {
    Precision precision = Precision::standard;
    std::string text;                ///< kernel text: parameters and settings by name are read, results by name are set
    std::vector<double> max_errors;  ///< documented, of each measure of each result, in their order
    bool everywhere = false;         ///< they hold even where `note` allows more
};

struct Function {
    std::string name;     ///< "resolve"
    std::string file;     ///< the concept file, under kernels/
    std::string summary;  ///< what the results are
    std::string source;   ///< paper, listing, equation
    std::vector<Parameter> parameters{};
    std::vector<Setting> settings{};
    std::vector<Result> results{};
    std::vector<FunctionVariant> variants{};  ///< from fast to exact; standard is always there
    double fp64_error = 1e-9;                 ///< largest error of a run in double, by any measure
    std::string note{};                       ///< where the error may be larger, what degenerate input gives

    /// The variant that serves `wanted`: itself, else the next more accurate, else the most accurate one.
    const FunctionVariant& variant(Precision wanted) const;
};

/// All functions, by concept; the table is made at the first call and stays.
const std::vector<Function>& functions();
/// Throws Error with the nearest name when there is none such.
const Function& function(const std::string& name);

using Columns = std::map<std::string, std::span<const float>>;
using ColumnResults = std::map<std::string, std::span<float>>;
using ColumnsInDouble = std::map<std::string, std::span<const double>>;
using ColumnResultsInDouble = std::map<std::string, std::span<double>>;

/// A camera and the frame that it fills.
struct CameraSetting {
    Camera camera;
    Size size;
};
using SettingValue = std::variant<std::vector<double>, CameraSetting, std::filesystem::path>;

struct FunctionOptions {
    Precision precision = Precision::standard;  ///< fp64 is what the overload in double does by itself
    int lanes = 0;                              ///< rows a work-item: 1, 4, 8 or 16; 0: the device's choice
    std::map<std::string, SettingValue> settings{};
};

/// Evaluates `function` for every row. Every column has the same length. Results that are not asked for are not stored.
/// Results may be put where the input was: they are stored once all rows are done.
/// Throws Error naming the column or setting that is missing, unknown or of another length.
void evaluate_function(const Device& device, const Function& function, const Columns& in, const ColumnResults& out,
                       const FunctionOptions& options = {});
void evaluate_function(const Device& device, const Function& function, const ColumnsInDouble& in,
                       const ColumnResultsInDouble& out, const FunctionOptions& options = {});

}  // namespace wrinkle
