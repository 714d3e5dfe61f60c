#include "plan/planned_numbers.h"

#include <utility>

namespace wrinkle {

std::size_t add_numbers(Emitter& emitter, const std::string& name,
                        std::function<std::vector<double>(const NumberSource&)> of) {
    std::size_t first = 0;
    for (const PlannedNumbers& known : emitter.plan.numbers) first += known.count;
    PlannedNumbers planned{name, 0, std::move(of)};
    const NumberSource source{emitter.scene, emitter.available.cryptomatte};
    planned.count = planned.of(source).size();
    numbers_of(planned, source);
    emitter.plan.numbers.push_back(std::move(planned));
    return first;
}

}  // namespace wrinkle
