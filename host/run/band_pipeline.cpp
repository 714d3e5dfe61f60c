#include "run/band_pipeline.h"

#include <oneapi/tbb/parallel_pipeline.h>

namespace wrinkle {

void run_bands(std::uint32_t bands, std::uint32_t in_flight, const BandStages& stages) {
    using Mode = tbb::filter_mode;
    std::uint32_t next = 0;
    const auto read = tbb::make_filter<void, std::uint32_t>(Mode::serial_in_order, [&](tbb::flow_control& control) {
        if (next == bands) {
            control.stop();
            return next;
        }
        stages.read(next);
        return next++;
    });
    const auto evaluate =
        tbb::make_filter<std::uint32_t, std::uint32_t>(Mode::serial_in_order, [&](std::uint32_t band) {
            stages.evaluate(band);
            return band;
        });
    const auto write = tbb::make_filter<std::uint32_t, void>(Mode::serial_in_order, stages.write);
    tbb::parallel_pipeline(in_flight, read & evaluate & write);
}

}  // namespace wrinkle
