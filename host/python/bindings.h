#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

/// What Python sees of the library, a file a concept. The package in wrinkle/ builds its own classes on it; nothing
/// else calls it.
namespace wrinkle::python {

using PlaneIn = nanobind::ndarray<const float, nanobind::c_contig, nanobind::device::cpu>;
using PlaneOut = nanobind::ndarray<float, nanobind::c_contig, nanobind::device::cpu>;
using BytesIn = nanobind::ndarray<const std::uint8_t, nanobind::c_contig, nanobind::device::cpu>;
using BytesOut = nanobind::ndarray<std::uint8_t, nanobind::c_contig, nanobind::device::cpu>;
using DoublesIn = nanobind::ndarray<const double, nanobind::c_contig, nanobind::device::cpu>;
using DoublesOut = nanobind::ndarray<double, nanobind::c_contig, nanobind::device::cpu>;

void bind_devices(nanobind::module_& module);
void bind_scenes(nanobind::module_& module);
void bind_frames(nanobind::module_& module);
void bind_passes(nanobind::module_& module);
void bind_functions(nanobind::module_& module);

}  // namespace wrinkle::python
