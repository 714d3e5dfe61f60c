#pragma once

#include <cstddef>

#include "tools/render.h"

/// What `wrinkle run` prints.
namespace wrinkle::cli {

/// Prints a line for every frame of a sequence, with how long the rest will take: for people to standard error, or as
/// JSON to standard output.
class FrameLines {
public:
    FrameLines(std::size_t frames, bool json) : frames_(frames), json_(json) {}

    void operator()(const FrameReport& frame);

private:
    std::size_t frames_, told_ = 0, evaluated_ = 0;
    bool json_;
    double seconds_ = 0;
};

void print_table(const RenderReport& report);
void print_json(const RenderReport& report, bool one_line);

}  // namespace wrinkle::cli
