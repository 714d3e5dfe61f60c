#pragma once

#include "io/camera_file.h"
#include "io/gbuffer_reader.h"
#include "wrinkle/passes.h"

namespace wrinkle {

/// Opens the scene's G-buffer, with the files that its layers read beside it; `number` fills in frame patterns. Throws
/// Error.
GBufferReader open_frame(const Scene& scene, int number);

/// The camera of an open frame, by which the reader turns normals of camera space. `refuse` throws Error for a camera
/// that does not fit the positions.
enum class CameraCheck { none, refuse };
FrameCamera camera_of_frame(const Scene& scene, GBufferReader& reader, int number,
                            CameraCheck check = CameraCheck::refuse);

/// What a plan may count on in an open frame, and the ids of every Cryptomatte name that the scene or the file has.
/// Throws Error naming the layer whose name has no id.
Frame frame_of(const Scene& scene, const GBufferReader& reader, const FrameCamera& camera);

/// The same of a frame of the scene, without reading pixels. Throws Error.
Frame describe_frame(const Scene& scene, int number = 0);

}  // namespace wrinkle
