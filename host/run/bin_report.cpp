#include "run/bin_report.h"

#include "device/guarded.h"
#include "run/open_frame.h"
#include "run/pass_impl.h"
#include "run/plane_buffers.h"

namespace wrinkle {

BinReport bin_report(const Device& device, const Scene& scene, const Frame& frame, int number) {
    return guarded("bin decals", [&] {
        Pass pass = evaluate(device, scene, frame);
        Pass::Impl& impl = pass.impl();
        if (!impl.plan.tiles) return BinReport{};
        GBufferReader reader = open_frame(scene, number);
        camera_of_frame(scene, reader, number, CameraCheck::none);  // turns normals of camera space
        const Size size = frame.size;
        PlaneBuffers planes(device, impl.plan.tiles->inputs, std::size_t{size.width} * size.height, sizeof(float));
        std::vector<float*> into;
        std::vector<cl::Buffer> buffers;
        for (const std::string& name : impl.plan.tiles->inputs) {
            into.push_back(planes.map<float>(name, CL_MAP_WRITE));
            buffers.push_back(planes.planes().at(name));
        }
        reader.read_rows(0, size.height, impl.plan.tiles->inputs, into);
        planes.unmap();
        impl.bins
            .enqueue(impl.frame, impl.numbers, buffers, {.first = 0, .count = size.height}, size.width, 0,
                     size.width * size.height, planes.ready())
            .wait();
        return impl.bins.read(size.width, size.height);
    });
}

}  // namespace wrinkle
