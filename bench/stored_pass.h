#pragma once

#include <string>
#include <vector>

#include "frame.h"
#include "tests/reference/vec.h"

namespace wrinkle::bench {

/// The vector of planes `role`x, y and z.
reference::Vec<double> vector_at(const BenchFrame& frame, const std::string& role, std::size_t i);

/// A way to store the planes of a frame.
struct StoredWay {
    const char* name;
    PlaneFormats in, out;
};

/// The formats of all.
PlaneFormats united(std::initializer_list<PlaneFormats> all);

/// The same format of each plane, alone in its memory.
PlaneFormats planar(PlaneEncoding encoding, const std::vector<std::string>& planes);

/// A pass with its planes on the device in the formats of a way: floats, halves and octahedral normals of 16 bits.
struct StoredPass {
    Pass pass;
    PlaneBuffers in, out;

    StoredPass(const Device& device, const Scene& scene, const BenchFrame& frame, const StoredWay& way);
    void run() { pass.enqueue(in.planes(), out.planes(), both_ready(in, out)).wait(); }
};

/// The numbers that planes x, y and z hold, of which `x` is named.
class StoredVectors {
public:
    StoredVectors(PlaneBuffers& buffers, const PlaneFormats& formats, std::string x);
    reference::Vec<double> at(std::size_t i) const;

private:
    std::vector<PlaneFormat> formats_;
    std::vector<const std::byte*> memory_;
};

}  // namespace wrinkle::bench
