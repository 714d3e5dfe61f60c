#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "tools/render.h"

namespace wrinkle {

/// What a report tells besides the pictures.
struct ReportOf {
    const Scene& scene;
    const RenderReport& run;
    int frame = 0;                   ///< whose pictures are shown
    std::string source;              ///< the scene's text
    std::vector<std::string> set{};  ///< values that replaced the file's
    std::string provenance;
    std::string device;  ///< as Device::open takes it
};

/// Writes a page of a run that needs no other file: the picture before and after, other pictures, each layer alone,
/// times, errors, warnings, where it all came from. Pictures are evaluated for it, in standard precision, and shrunk to
/// 1920 pixels. Throws Error.
void write_report(AtomicFile& file, const ReportOf& report);

}  // namespace wrinkle
