#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/set.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "io/cryptomatte.h"
#include "python/bindings.h"
#include "run/open_frame.h"
#include "wrinkle/camera.h"
#include "wrinkle/error.h"
#include "wrinkle/passes.h"

namespace nb = nanobind;

namespace wrinkle::python {

namespace {

/// A frame of a scene, open, with its camera.
struct OpenedFrame {
    GBufferReader reader;
    FrameCamera camera;
    Frame frame;

    OpenedFrame(const Scene& scene, int number)
        : reader(open_frame(scene, number)),
          camera(camera_of_frame(scene, reader, number)),
          frame(frame_of(scene, reader, camera)) {}

    /// The frame, with the ids of the names that another scene's masks have.
    Frame frame_for(const Scene& scene) const {
        Frame out = frame;
        out.cryptomatte = frame_of(scene, reader, camera).cryptomatte;
        return out;
    }

    void read(const std::vector<std::string>& planes, const std::vector<PlaneOut>& out) const {
        const Size size = reader.size();
        std::vector<float*> rows;
        for (const PlaneOut& plane : out) {
            if (plane.size() != std::size_t{size.width} * size.height) throw Error("a plane of another size");
            rows.push_back(plane.data());
        }
        if (rows.size() != planes.size()) throw Error("as many planes as names are needed");
        reader.require(planes);
        nb::gil_scoped_release unlocked;
        reader.read_rows(0, size.height, planes, rows);
    }
};

DeviceDepth device_depth_of(const std::string& name) {
    if (name.empty()) return DeviceDepth::none;
    if (name == "zero_to_one") return DeviceDepth::zero_to_one;
    if (name == "minus_one_to_one") return DeviceDepth::minus_one_to_one;
    throw Error("device_depth is \"" + name + "\"; it can be \"zero_to_one\" or, of OpenGL, \"minus_one_to_one\"");
}

PlaneEncoding encoding_of(const std::string& name) {
    for (int i = 0; i <= static_cast<int>(PlaneEncoding::uint32); ++i)
        if (encoding_name(static_cast<PlaneEncoding>(i)) == name) return static_cast<PlaneEncoding>(i);
    throw Error("no encoding of planes is called \"" + name + "\"");
}

}  // namespace

void bind_frames(nb::module_& module) {
    nb::class_<Camera>(module, "Camera",
                       "A camera in world space: clip = proj @ view @ p, column vectors; it looks down -z of view "
                       "space, y up, as in OpenGL.")
        .def(
            "__init__",
            [](Camera* self, const Mat4& view, const Mat4& proj) {
                new (self) Camera{view, proj};
            },
            nb::arg("view"), nb::arg("proj"), "Two matrices of 4 rows: numpy arrays or lists.")
        .def_ro("view", &Camera::view, "world to camera, rigid; 4 rows")
        .def_ro("proj", &Camera::proj, "camera to clip; 4 rows")
        .def_static("look_at", &Camera::look_at, nb::arg("eye"), nb::arg("target"), nb::arg("up"), nb::arg("fov_y"),
                    nb::arg("aspect"), "A camera at `eye` that looks at `target`; `fov_y` in radians, vertical.")
        .def(
            "project",
            [](const Camera& camera, std::uint32_t width, std::uint32_t height, const Vec3& point) {
                return project(camera, {width, height}, point);
            },
            nb::arg("width"), nb::arg("height"), nb::arg("point"),
            "Pixel coordinates of a point, x right, y down; None at or behind the eye.");
    nb::class_<Frame>(module, "Frame", "What a pass is made for: a size, a camera, the planes that there are.")
        .def(
            "__init__",
            [](Frame* self, std::uint32_t width, std::uint32_t height, const Camera& camera,
               std::set<std::string> planes, bool ray_depth, const std::vector<std::string>& objects,
               PlaneFormats formats, const std::string& device_depth, std::uint32_t beauty_scale) {
                Frame frame{.size = {width, height},
                            .camera = camera,
                            .planes = std::move(planes),
                            .ray_depth = ray_depth,
                            .beauty_scale = beauty_scale,
                            .formats = std::move(formats),
                            .device_depth = device_depth_of(device_depth)};
                for (const std::string& name : objects) frame.cryptomatte.emplace(name, CryptomatteManifest().id(name));
                new (self) Frame(std::move(frame));
            },
            nb::arg("width"), nb::arg("height"), nb::arg("camera"), nb::arg("planes"), nb::arg("ray_depth"),
            nb::arg("objects"), nb::arg("formats"), nb::arg("device_depth"), nb::arg("beauty_scale"))
        .def_prop_ro("width", [](const Frame& frame) { return frame.size.width; })
        .def_prop_ro("height", [](const Frame& frame) { return frame.size.height; })
        .def_ro("camera", &Frame::camera)
        .def_ro("beauty_scale", &Frame::beauty_scale)
        .def_ro("planes", &Frame::planes);
    nb::class_<PlaneFormat>(module, "PlaneFormat", "How a plane is stored: its encoding, and where in pixels it lies.")
        .def(
            "__init__",
            [](PlaneFormat* self, const std::string& encoding, std::uint32_t offset, std::uint32_t stride, double scale,
               double bias, std::string memory) {
                new (self) PlaneFormat{.encoding = encoding_of(encoding),
                                       .offset = offset,
                                       .stride = stride,
                                       .scale = scale,
                                       .bias = bias,
                                       .memory = std::move(memory)};
            },
            nb::arg("encoding"), nb::arg("offset"), nb::arg("stride"), nb::arg("scale"), nb::arg("bias"),
            nb::arg("memory"))
        .def("__eq__", [](const PlaneFormat& a, const PlaneFormat& b) { return a == b; });
    nb::class_<OpenedFrame>(module, "OpenedFrame", "A frame of a scene, open.")
        .def(nb::init<const Scene&, int>(), nb::arg("scene"), nb::arg("number"),
             nb::call_guard<nb::gil_scoped_release>())
        .def_ro("frame", &OpenedFrame::frame)
        .def("frame_for", &OpenedFrame::frame_for, nb::arg("scene"))
        .def_prop_ro("origin", [](const OpenedFrame& f) { return f.camera.origin; })
        .def_prop_ro("channels", [](const OpenedFrame& f) { return f.reader.channels(); })
        .def("read", &OpenedFrame::read, nb::arg("planes"), nb::arg("out"));
    module.def("gbuffer_roles", [] {
        nb::dict roles;
        for (const Role& role : gbuffer_roles()) {
            nb::list planes;
            for (const std::string& plane : role.planes) planes.append(plane);
            if (role.name != "cryptomatte") roles[role.name.c_str()] = planes;
        }
        return roles;
    });
    module.def(
        "cryptomatte_id", [](const std::string& name) { return cryptomatte_hash(name); }, nb::arg("name"),
        "Cryptomatte's id of an object's name, as the id channels hold its bits.");
}

}  // namespace wrinkle::python
