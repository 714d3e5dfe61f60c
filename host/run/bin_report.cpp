#include "run/bin_report.h"

#include <fmt/format.h>

#include "base/limits.h"
#include "device/guarded.h"
#include "run/pass_impl.h"
#include "run/plane_buffers.h"

namespace wrinkle {

FrameBins bin_report(const Device& device, const Scene& scene, const Frame& frame, const GBufferReader& reader) {
    return guarded("bin decals and lights", [&] {
        Pass pass = evaluate(device, scene, frame);
        Pass::Impl& impl = pass.impl();
        if (!impl.plan.tiles) return FrameBins{};
        const Size size = frame.size;
        const std::vector<std::string>& names = impl.plan.tiles->inputs;
        check_memory(reader.path().string(), 4.0 * size.width * size.height * static_cast<double>(names.size()),
                     fmt::format("{} planes of {} x {} pixels", names.size(), size.width, size.height));
        PlaneBuffers planes(device, names, std::size_t{size.width} * size.height, sizeof(float));
        std::vector<float*> into;
        std::vector<cl::Buffer> buffers;
        for (const std::string& name : names) {
            into.push_back(planes.map<float>(name, CL_MAP_WRITE));
            buffers.push_back(planes.planes().at(name));
        }
        reader.read_rows(0, size.height, names, into);
        planes.unmap();
        const auto read = [&](TileBins& bins) -> std::optional<BinReport> {
            if (bins.rows() == 0) return {};
            bins.enqueue(impl.frame, impl.numbers, buffers, {.first = 0, .count = size.height}, size.width, 0,
                         size.width * size.height, planes.ready())
                .wait();
            return bins.read(size.width, size.height);
        };
        return FrameBins{read(impl.bins), read(impl.light_bins)};
    });
}

}  // namespace wrinkle
