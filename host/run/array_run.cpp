#include "run/array_run.h"

#include <cstring>

#include "plan/stored_planes.h"
#include "run/bands.h"

namespace wrinkle {

namespace {

/// Hands a band to the device.
void begin(Band& band, Pass::Impl& impl, const HostBytes& in, const HostByteOutputs& out) {
    const Rows& rows = band.rows;
    for (const std::string& name : impl.plan.input_memories) {
        const std::size_t row = impl.size.width * std::size_t{pixel_bytes(name, impl.plan.formats)};
        std::memcpy(band.inputs.map<std::byte>(name, CL_MAP_WRITE),
                    in.at(name).data() + (rows.first - rows.before) * row,
                    (rows.before + rows.count + rows.after) * row);
    }
    band.inputs.unmap();
    for (const std::string& name : impl.plan.output_memories) {
        if (!has_gaps(name, impl.plan.output_formats)) continue;  // what no plane lies in stays as it is
        const std::size_t row = impl.size.width * impl.output_bytes(name);
        std::memcpy(band.outputs.map<std::byte>(name, CL_MAP_WRITE), out.at(name).data() + rows.first * row,
                    rows.count * row);
    }
    band.outputs.unmap();
    band.outputs.fetch({band.enqueue(impl, rows)});
}

/// Waits for a band, and gives its results to the caller.
void finish(Band& band, Pass::Impl& impl, const HostByteOutputs& out) {
    for (const std::string& name : impl.plan.output_memories) {
        const std::size_t row = impl.size.width * impl.output_bytes(name);
        std::memcpy(out.at(name).data() + band.rows.first * row, band.outputs.map<std::byte>(name, CL_MAP_READ),
                    band.rows.count * row);
    }
    band.outputs.unmap();
}

}  // namespace

void run_arrays(Pass::Impl& impl, const HostBytes& in, const HostByteOutputs& out, const ToldShare& progress) {
    // Where the device's memory is the host's, there is nothing to overlap: the cores that would copy evaluate.
    const std::uint32_t in_flight = impl.device.info.own_memory ? 3 : 1;
    const BandGrid grid = band_grid(impl, impl.plan.sums_over, in_flight);
    const std::uint32_t bands = grid.count();
    std::vector<Band> slots;
    while (slots.size() < std::min(in_flight, bands)) slots.emplace_back(impl, grid, impl.plan.input_memories);
    for (std::uint32_t band = 0; band < bands + in_flight; ++band) {
        if (band >= in_flight && band - in_flight < bands) {
            Band& slot = slots[band % in_flight];
            finish(slot, impl, out);
            if (progress)
                progress(static_cast<double>(slot.rows.first + slot.rows.count) /
                         static_cast<double>(grid.size.height));
        }
        if (band >= bands) continue;
        slots[band % in_flight].begin(grid, band);
        begin(slots[band % in_flight], impl, in, out);
    }
}

}  // namespace wrinkle
