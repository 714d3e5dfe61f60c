#pragma once

#include "plan/section.h"

namespace wrinkle {

/// Where positions come from.
struct GeometryText {
    std::vector<std::string> planes;
    std::string valid;     ///< mask of the planes, as text
    std::string position;  ///< sets p from pixel (x, y) and plane values z or px, py, pz
    std::string along;     ///< the factor r of p = r d, d the pixel's ray; the depth itself where that is the factor
    std::string pairs;     ///< the position with more digits, a wr_pair3; empty where the planes have no more
    std::string here;      ///< parameters by which a neighbour is told of the pixel being evaluated ...
    std::string given;     ///< ... and the arguments for them
    std::string step;      ///< sets p to a neighbour's position less that of the pixel being evaluated
};

GeometryText geometry_text(const Emitter& emitter);
/// Text that loads one pixel's geometry; `load` is the loading function with its place.
std::string load_geometry(const GeometryText& geometry, const std::string& load, const std::string& indent);
std::string load_normal(const std::string& load, const std::string& indent);
/// Replaces what invalid pixels hold by something harmless, so that nothing later needs to ask.
std::string sanitize(const GeometryText& geometry, const std::string& indent);
/// What lies along the ray from the viewer, of any length.
const char* view_text(const Emitter& emitter);
/// Unit vector from p to the viewer.
const char* to_viewer_text(const Emitter& emitter);

}  // namespace wrinkle
