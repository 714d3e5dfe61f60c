#include "run/condition.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "base/error_stats.h"
#include "run/normals_only.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kUnit = 0x1p-24 * 180 / std::numbers::pi;  // degrees

/// Planes that hold labels instead of measurements are not moved: the next float would be another object.
bool is_label(const std::string& plane) {
    return plane == "object" || plane == "tangent_sign" || plane.starts_with("crypto.");
}

/// Wellons's "lowbias32".
std::uint32_t hash(std::uint32_t h) {
    h = (h ^ h >> 16) * 0x7feb352dU;
    h = (h ^ h >> 15) * 0x846ca68bU;
    return h ^ h >> 16;
}

/// v's neighbour among floats, away from 0 or towards it.
float moved(float v, bool away) {
    if (v == 0 || !std::isfinite(v)) return v;
    const auto bits = std::bit_cast<std::uint32_t>(v);
    const float next = std::bit_cast<float>(away ? bits + 1 : bits - 1);
    return std::isfinite(next) ? next : v;
}

}  // namespace

Condition::Condition(const Device& device, const Scene& scene, const Frame& frame, TextureStore* store)
    : pass_([&] {
          if (!device.info.fp64)
              throw Error(
                  fmt::format("condition = true needs double precision (cl_khr_fp64), and {} has none; choose another "
                              "--device (see \"wrinkle devices\"), or leave it out",
                              device.info.name));
          return wrinkle::evaluate(device, normals_only(scene), frame, {.fp64 = true}, store);
      }()) {}

std::array<std::vector<double>, 3> Condition::normals(const DevicePlanes& inputs, std::vector<cl::Event> wait,
                                                      const Rows& rows, std::size_t pixels) {
    wait.insert(wait.end(), outputs_.ready().begin(), outputs_.ready().end());
    pass_.impl().enqueue(inputs, outputs_.planes(), rows, wait).wait();
    std::array<std::vector<double>, 3> out;
    for (std::size_t k = 0; k < 3; ++k) {
        const double* plane = outputs_.map<double>(fmt::format("normal.{}", "xyz"[k]), CL_MAP_READ);
        out[k].assign(plane, plane + pixels);
    }
    outputs_.unmap();
    return out;
}

std::vector<float> Condition::evaluate(PlaneBuffers& inputs, const Rows& rows) {
    const Pass::Impl& impl = pass_.impl();
    const std::size_t width = impl.size.width, pixels = width * rows.count;
    const std::size_t read = width * (rows.before + rows.count + rows.after);
    if (room_ < read) {
        moved_ = PlaneBuffers(impl.device, {"moved"}, read, sizeof(float));
        outputs_ = PlaneBuffers(impl.device, impl.plan.outputs, read, sizeof(double));
        room_ = read;
    }
    const auto base = normals(inputs.planes(), inputs.ready(), rows, pixels);
    std::vector<bool> valid(pixels);
    const double* marked = outputs_.map<double>("marked", CL_MAP_READ);
    for (std::size_t i = 0; i < pixels; ++i) valid[i] = (static_cast<int>(marked[i]) & 1) == 0;
    outputs_.unmap();

    std::vector<double> degrees(pixels);
    const std::size_t first = width * (rows.first - rows.before);
    std::uint32_t number = 0;
    for (const std::string& name : impl.plan.inputs) {
        if (is_label(name)) continue;
        const std::uint32_t salt = hash(++number);
        const float* from = inputs.written<float>(name);
        float* to = moved_.map<float>("moved", CL_MAP_WRITE);
        for (std::size_t i = 0; i < read; ++i)
            to[i] = moved(from[i], (hash(static_cast<std::uint32_t>(first + i) ^ salt) & 1) != 0);
        moved_.unmap();
        inputs.unmap();
        DevicePlanes planes = inputs.planes();
        planes[name] = moved_.planes().at("moved");
        const auto other = normals(planes, both_ready(inputs, moved_), rows, pixels);
        for (std::size_t i = 0; i < pixels; ++i)
            if (valid[i])
                degrees[i] +=
                    angle_degrees({base[0][i], base[1][i], base[2][i]}, {other[0][i], other[1][i], other[2][i]});
    }
    pass_.impl().save();
    std::vector<float> out(pixels);
    for (std::size_t i = 0; i < pixels; ++i) out[i] = static_cast<float>(degrees[i] / kUnit);
    return out;
}

}  // namespace wrinkle
