#pragma once

#include "plan/section.h"

namespace wrinkle {

/// How a pixel's position is computed, as kernel text.
struct GeometryText {
    std::vector<std::string> planes;
    std::string depth;     ///< a depth, with {} for the number that its plane holds
    std::string valid;     ///< mask of the planes, as text
    std::string position;  ///< declares p, from pixel (x, y) and the values z, or px, py, pz, of the planes
    std::string along;     ///< r in p = r d, where d is the pixel's ray; a planar depth is r itself
    std::string pairs;     ///< the position as a wr_pair3, in twice the precision; empty where there is no more than p
    std::string here;      ///< parameters of the helper for neighbours: what it must know of the pixel itself ...
    std::string given;     ///< ... and the arguments for them
    std::string step;      ///< declares p, a neighbour's position relative to the pixel's
};

GeometryText geometry_text(const Emitter& emitter);
/// Text that loads one pixel's geometry; `load` is the loading function with its place.
std::string load_geometry(const GeometryText& geometry, const std::string& load, const std::string& indent);
std::string load_normal(const std::string& load, const std::string& indent);
/// Text that gives invalid pixels harmless values, so that nothing later has to test for NaN or Inf.
std::string sanitize(const GeometryText& geometry, const std::string& indent);
/// Text of a vector along the pixel's ray, away from the viewer, of any length.
const char* view_text(const Emitter& emitter);
/// Text of the unit vector to the viewer from the point that the text `p` gives.
std::string to_viewer_text(const Emitter& emitter, const std::string& p = "p");

}  // namespace wrinkle
