#include "tools/metal_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "base/vec.h"
#include "io/object_ids.h"
#include "resources/octahedral_map.h"
#include "run/open_frame.h"
#include "tools/frame_rows.h"

#include "layout.h"

namespace wrinkle {
namespace {

constexpr std::size_t kSide = MetalPicture::kVertices, kCells = kSide - 1;
constexpr double kLeastPixels = 200;             // of an object, else bumps would show a few pixels over and over
constexpr double kLeastCovered = 0.25;           // of all directions: a box shows 3%, cans and balls 70% and more
constexpr float kMetal = 0.9f, kBlack = 1e-3f;   // of the metallic pass, of an albedo
constexpr std::uint32_t kRows = 64, kStep = 16;  // read at a time; from one row that is looked at for metal to the next

/// What an object shows of directions, as sums at the vertices around each of its pixels.
class Sums {
public:
    void add(const Vec3& l, const Vec3& radiance) {
        const auto [x, y] = place(l);
        const std::size_t left = std::min(static_cast<std::size_t>(x), kCells - 1),
                          low = std::min(static_cast<std::size_t>(y), kCells - 1);
        const double right = x - static_cast<double>(left), up = y - static_cast<double>(low);
        for (const std::size_t k : {0, 1, 2, 3}) {
            Vertex& v = at(left + (k & 1), low + (k >> 1));
            const double weight = (k & 1 ? right : 1 - right) * (k >> 1 ? up : 1 - up);
            v.weight += weight;
            for (std::size_t c = 0; c < 3; ++c) v.sum[c] += weight * radiance[c];
        }
        ++pixels_;
    }

    double pixels() const { return pixels_; }

    /// The share of directions that are shown.
    double covered() const {
        const auto shown = std::ranges::count_if(vertices_, [](const Vertex& v) { return v.weight > kLeastWeight; });
        return static_cast<double>(shown) / static_cast<double>(vertices_.size());
    }

    /// Means where something is shown; elsewhere what is shown nearest. Nothing where nothing is.
    std::vector<Vec3> picture() {
        join_folds();
        std::vector<Vec3> out(vertices_.size());
        std::vector<bool> known(vertices_.size());
        for (std::size_t k = 0; k < vertices_.size(); ++k) {
            known[k] = vertices_[k].weight > kLeastWeight;
            if (known[k]) out[k] = scaled(vertices_[k].sum, 1 / vertices_[k].weight);
        }
        if (std::ranges::find(known, true) == known.end()) return {};
        while (std::ranges::find(known, false) != known.end()) spread(out, known);
        return out;
    }

private:
    static constexpr double kLeastWeight = 0.5;
    struct Vertex {
        double weight = 0;
        Vec3 sum{};
    };

    static Vec3 scaled(const Vec3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

    Vertex& at(std::size_t x, std::size_t y) { return vertices_[y * kSide + x]; }

    /// A direction's place on the octahedron, in cells.
    static std::array<double, 2> place(const Vec3& d) {
        const auto [s, t] = OctahedralMap::place(d);
        return {std::clamp(s, 0.0, 1.0) * kCells, std::clamp(t, 0.0, 1.0) * kCells};
    }

    /// The other vertex that a vertex of the rim meets where the square is folded.
    static std::size_t twin(std::size_t x, std::size_t y) {
        if (x == 0 || x == kCells)
            y = kCells - y;
        else if (y == 0 || y == kCells)
            x = kCells - x;
        return y * kSide + x;
    }

    template <class Both>
    static void each_fold(const Both& both) {
        for (std::size_t k = 0; k < kSide; ++k)
            for (const std::size_t rim : {std::size_t{0}, kCells}) {
                both(k * kSide + rim, twin(rim, k));
                both(rim * kSide + k, twin(k, rim));
            }
    }

    void join_folds() {
        const std::vector<Vertex> once = vertices_;
        each_fold([&](std::size_t k, std::size_t other) {
            if (k == other) return;
            Vertex& v = vertices_[k];
            v.weight = once[k].weight + once[other].weight;
            for (std::size_t c = 0; c < 3; ++c) v.sum[c] = once[k].sum[c] + once[other].sum[c];
        });
    }

    /// Gives what is unknown the mean of what is known around it.
    static void spread(std::vector<Vec3>& colours, std::vector<bool>& known) {
        const std::vector<bool> before = known;
        for (std::size_t y = 0; y < kSide; ++y)
            for (std::size_t x = 0; x < kSide; ++x) {
                if (before[y * kSide + x]) continue;
                Vec3 sum{};
                double count = 0;
                for (std::size_t j = y - std::min<std::size_t>(y, 1); j <= std::min(y + 1, kCells); ++j)
                    for (std::size_t i = x - std::min<std::size_t>(x, 1); i <= std::min(x + 1, kCells); ++i)
                        if (before[j * kSide + i]) {
                            ++count;
                            for (std::size_t c = 0; c < 3; ++c) sum[c] += colours[j * kSide + i][c];
                        }
                if (count == 0) continue;
                colours[y * kSide + x] = scaled(sum, 1 / count);
                known[y * kSide + x] = true;
            }
        each_fold([&](std::size_t k, std::size_t other) {
            if (!known[k] && known[other]) colours[k] = colours[other], known[k] = true;
            if (!before[k] && known[other]) colours[other] = colours[k];
        });
    }

    std::vector<Vertex> vertices_ = std::vector<Vertex>(kSide * kSide);
    double pixels_ = 0;
};

/// Metal of some rows of a frame.
class Metal {
public:
    Metal(const GBufferReader& reader, const PinholeRays& rays)
        : rows_(reader, {"normal", "beauty", "albedo", "metallic", "object"}),
          rays_(rays),
          width_(reader.size().width) {}

    /// Without a pass of its own metal is what is black, which other things are, too: of those only objects count.
    bool is_told() const { return rows_.has("metallic") || (rows_.has("albedo.r") && rows_.has("object")); }
    void read(std::uint32_t first, std::uint32_t end) { first_ = first, height_ = end - first, rows_.read(first, end); }
    bool any() const {
        for (std::size_t i = 0; i < height_ * width_; ++i)
            if (is_metal(i)) return true;
        return false;
    }

    /// Adds the pixels between the first row and the last, whose neighbours show the same object.
    void add_to(std::map<float, Sums>& objects) const {
        for (std::size_t y = 1; y + 1 < height_; ++y)
            for (std::size_t x = 1; x + 1 < width_; ++x) {
                const std::size_t i = y * width_ + x;
                const auto same = [&](std::size_t other) { return is_metal(other) && label(other) == label(i); };
                if (!is_metal(i) || !same(i - 1) || !same(i + 1) || !same(i - width_) || !same(i + width_)) continue;
                const Vec3 n = normalize(rows_.vec("normal", "xyz", i)), v = to_viewer(x, y);
                const double cosine = dot(n, v);
                if (!(cosine > 0)) continue;
                objects[label(i)].add({2 * cosine * n[0] - v[0], 2 * cosine * n[1] - v[1], 2 * cosine * n[2] - v[2]},
                                      rows_.vec("beauty", "rgb", i));
            }
    }

private:
    float label(std::size_t i) const { return rows_.has("object") ? rows_.at("object", i) : 0; }

    bool is_metal(std::size_t i) const {
        if (rows_.has("metallic") ? !(rows_.at("metallic", i) >= kMetal) : !is_black(i)) return false;
        const Vec3 n = rows_.vec("normal", "xyz", i), shown = rows_.vec("beauty", "rgb", i);
        const double length = dot(n, n), sum = shown[0] + shown[1] + shown[2];
        return length > 0.25 && std::isfinite(length) && sum > 0 && std::isfinite(sum);
    }
    bool is_black(std::size_t i) const {
        return std::max({rows_.at("albedo.r", i), rows_.at("albedo.g", i), rows_.at("albedo.b", i)}) <= kBlack;
    }

    Vec3 to_viewer(std::size_t x, std::size_t y) const {
        Vec3 out;
        for (std::size_t c = 0; c < 3; ++c)
            out[c] = -(rays_.d0[c] + (static_cast<double>(x) + 0.5) * rays_.dx[c] +
                       (static_cast<double>(first_ + y) + 0.5) * rays_.dy[c]);
        return normalize(out);
    }

    ReadRows rows_;
    PinholeRays rays_;
    std::size_t width_, height_ = 0;
    std::uint32_t first_ = 0;
};

/// The objects that are relit: those of the frame before, else the largest that show enough directions.
std::vector<float> chosen(const std::map<float, Sums>& objects, const MetalPictures& before) {
    std::vector<float> labels;
    if (before) {
        for (const MetalPicture& known : *before) labels.push_back(io::object_label(known.object));
        return labels;
    }
    for (const auto& [label, sums] : objects)
        if (sums.pixels() >= kLeastPixels && sums.covered() >= kLeastCovered) labels.push_back(label);
    std::ranges::stable_sort(labels, std::greater{}, [&](float label) { return objects.at(label).pixels(); });
    if (labels.size() > WR_METALS) labels.resize(WR_METALS);
    return labels;
}

}  // namespace

bool wants_metals(const Scene& scene) {
    return scene.lighting.relight == Relight::ratio && !scene.layers.empty() && !scene.lighting.metals;
}

MetalPictures metals_of_frame(const Scene& scene, int frame, const MetalPictures& before) {
    GBufferReader reader = open_frame(scene, frame);
    if (!reader.has_role("normal") || !reader.has_role("beauty")) return before;
    const FrameCamera camera = camera_of_frame(scene, reader, frame, CameraCheck::none);  // turns normals of its space
    const Frame facts = frame_of(scene, reader, camera);
    const auto rays = pinhole_rays(facts.camera, facts.size);
    if (!rays) return before;
    Metal metal(reader, *rays);
    if (!metal.is_told()) return before;
    const std::uint32_t height = reader.size().height;
    bool any = before != nullptr;
    for (std::uint32_t row = 0; row < height && !any; row += kStep) {
        metal.read(row, row + 1);
        any = metal.any();
    }
    if (!any) return before;
    std::map<float, Sums> objects;
    for (std::uint32_t first = 0; first + 2 < height; first += kRows - 2) {  // rows of two bands are neighbours
        metal.read(first, std::min(first + kRows, height));
        metal.add_to(objects);
    }
    auto pictures = std::make_shared<std::vector<MetalPicture>>();
    for (const float label : chosen(objects, before)) {
        const auto found = objects.find(label);
        MetalPicture picture{.object = io::object_number(label), .seen = {}};
        if (found != objects.end() && found->second.pixels() >= kLeastPixels) picture.seen = found->second.picture();
        if (picture.seen.empty()) picture.seen = (*before)[pictures->size()].seen;  // hidden, or too small to tell
        pictures->push_back(std::move(picture));
    }
    return pictures;
}

Scene with_metals(Scene scene, const MetalPictures& metals) {
    if (metals && !metals->empty()) scene.lighting.metals = metals;
    return scene;
}

}  // namespace wrinkle
