#include "python/bindings.h"
#include "wrinkle/error.h"

NB_MODULE(_wrinkle, module) {
    nanobind::object error = nanobind::exception<wrinkle::Error>(module, "Error");
    error.attr("__module__") = "wrinkle";
    error.attr("__doc__") =
        "What went wrong, written for whoever made the call: which file, line, layer, plane or column, what was found, "
        "what was expected, what to do.";
    wrinkle::python::bind_devices(module);
    wrinkle::python::bind_scenes(module);
    wrinkle::python::bind_frames(module);
    wrinkle::python::bind_passes(module);
    wrinkle::python::bind_functions(module);
}
