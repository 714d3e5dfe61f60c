#include "look/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "base/vec.h"
#include "device/guarded.h"
#include "io/whole_planes.h"
#include "layers/kinds.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

const std::vector<std::string> kNormal{"normal.x", "normal.y", "normal.z"};

/// At a scale of 0, or of a nanometre where it is a depth, which has to be more.
Scene without_layers(Scene scene, const std::set<std::size_t>& off) {
    constexpr double nanometre = 1e-9;
    for (const std::size_t i : off) {
        if (i >= scene.layers.size()) continue;
        Layer& layer = scene.layers[i];
        layer.scale = std::holds_alternative<ParallaxLayer>(layer.bump) ? nanometre : 0;
        // One that is flat may turn the surface towards its axis all the same.
        if (DecalLayer* const decal = std::get_if<DecalLayer>(&layer.bump))
            decal->half_size = {nanometre, nanometre, nanometre};
    }
    return scene;
}

std::set<std::size_t> all_layers(const Scene& scene) {
    std::set<std::size_t> all;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) all.insert(all.end(), i);
    return all;
}

}  // namespace

Look::Look(Device device) : device_(std::move(device)), store_(std::make_unique<TextureStore>(device_)) {}

void Look::open(const Scene& scene, int frame) {
    auto reader = std::make_unique<GBufferReader>(open_frame(scene, frame));
    FrameCamera camera = camera_of_frame(scene, *reader, frame);
    Frame frame_now = frame_of(scene, *reader, camera);
    if (!same_shape(frame_now, pass_for_)) pass_.reset(), bare_.reset();
    pass_for_ = std::move(frame_now);
    reader_ = std::move(reader);
    camera_ = std::move(camera);
    number_ = frame;
    planes_ = std::make_shared<WholePlanes>();
    lights_.reset();
    metals_.reset();
    for (auto* const pass : {&pass_, &bare_})
        if (*pass) (*pass)->set_camera(camera_.camera);
}

void Look::forget_textures() {
    pass_.reset();
    bare_.reset();
    store_ = std::make_unique<TextureStore>(device_);
}

/// With the outputs that pictures and pixels are made of, in place of the scene's own.
Scene Look::prepared(const Scene& scene) {
    Scene out = scene;
    out.budget = {};
    out.output = {};
    out.output.roughness = out.output.dp_dx = out.output.dp_dy = out.output.marked = true;
    if (wants_metals(out)) {
        if (!metals_) metals_ = metals_of_frame(out, number_);
        if (!metals_) metals_ = std::make_shared<const std::vector<MetalPicture>>();
        out = with_metals(std::move(out), metals_);
    }
    if (!wants_lights(out)) return out;
    // Lights that a scene names may have been edited, and with them how strong they are beside the picture.
    if (!lights_ || !lights_->all || !scene.lighting.lights.empty()) lights_ = find_lights(scene, number_);
    return with_lights(std::move(out), *lights_);
}

/// Gives a pass the scene's numbers. Returns whether it had to be made anew.
bool Look::take(std::optional<Pass>& pass, const Scene& scene) {
    if (pass) {
        try {
            pass->set_parameters(scene);
            return false;
        } catch (const Error&) {
            pass.reset();  // other code is needed, or something is wrong, which making a pass tells as well
        }
    }
    pass_for_ = frame_of(scene, *reader_, camera_);
    pass.emplace(wrinkle::evaluate(device_, scene, pass_for_, {}, store_.get()));
    return true;
}

/// Images that were given away keep the planes that they have.
void Look::read_missing(const std::vector<std::string>& names) {
    std::set<std::string> missing;
    for (const std::string& name : names)
        if (!planes_->contains(name)) missing.insert(name);
    if (missing.empty()) return;
    WholePlanes more = io::read_whole_planes(*reader_, std::vector(missing.begin(), missing.end()));
    more.merge(WholePlanes(*planes_));
    planes_ = std::make_shared<WholePlanes>(std::move(more));
}

WholePlanes Look::run(Pass& pass) {
    read_missing(pass.inputs());
    WholePlanes out;
    HostOutputs spans;
    for (const std::string& name : pass.outputs())
        spans[name] = out[name] = std::vector<float>(std::size_t{pass_for_.size.width} * pass_for_.size.height);
    HostPlanes in;
    for (const std::string& name : pass.inputs()) in[name] = planes_->at(name);
    pass.run(in, spans);
    return out;
}

std::shared_ptr<const LookImage> Look::evaluate(const Scene& scene, const std::set<std::size_t>& off,
                                                bool with_condition) {
    return guarded("evaluate a scene", [&] {
        Scene wanted = prepared(scene);
        auto image = std::make_shared<LookImage>();
        image->built = take(pass_, without_layers(wanted, off));
        std::vector<std::string> names = kNormal;
        for (const char* name : {"beauty.r", "beauty.g", "beauty.b", "object", "crypto.id0"})
            if (reader_->has_plane(name)) names.emplace_back(name);
        names.insert(names.end(), pass_->inputs().begin(), pass_->inputs().end());
        read_missing(names);
        if (wanted.lighting.relight == Relight::lit) {
            Scene lights = wanted;
            lights.layers.clear();
            take(bare_, lights);
            image->unbumped = std::make_shared<WholePlanes>(run(*bare_));
        }
        const auto start = std::chrono::steady_clock::now();
        image->out = run(*pass_);
        image->kernel_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (with_condition) image->out["condition"] = condition(without_layers(wanted, off));
        image->size = pass_for_.size;
        image->frame = planes_;
        image->relight = wanted.lighting.relight;
        image->exposure = wanted.lighting.exposure;
        for (const std::string& name : reader_->cryptomatte().names())
            image->objects.emplace(reader_->cryptomatte().id(name), name);
        if (image->built) store_->keep_latest();
        scene_ = std::move(wanted);
        return std::shared_ptr<const LookImage>(std::move(image));
    });
}

std::vector<float> Look::condition(const Scene& scene) {
    Condition condition(device_, scene, pass_for_, store_.get());
    read_missing(condition.inputs());
    PlaneBuffers buffers(device_, condition.inputs(), std::size_t{pass_for_.size.width} * pass_for_.size.height,
                         sizeof(float));
    for (const std::string& name : condition.inputs())
        std::ranges::copy(planes_->at(name), buffers.map<float>(name, CL_MAP_WRITE));
    buffers.unmap();
    return condition.evaluate(buffers, {.first = 0, .count = pass_for_.size.height});
}

LookPixel Look::pixel(std::uint32_t x, std::uint32_t y) {
    return guarded("evaluate a pixel", [&] {
        const Size size = pass_for_.size;
        if (!pass_ || x >= size.width || y >= size.height) throw Error(fmt::format("there is no pixel {}, {}", x, y));
        Pass::Impl& impl = pass_->impl();
        const std::uint32_t halo = impl.plan.neighbours ? 1 : 0;
        const Rows rows{
            .first = y, .count = 1, .before = std::min(halo, y), .after = std::min(halo, size.height - 1 - y)};
        const std::size_t read = std::size_t{size.width} * (rows.before + 1 + rows.after);
        PlaneBuffers in(device_, impl.plan.inputs, read, sizeof(float));
        PlaneBuffers out(device_, impl.plan.outputs, size.width, sizeof(float));
        for (const std::string& name : impl.plan.inputs)
            std::copy_n(planes_->at(name).begin() + std::ptrdiff_t{size.width} * (y - rows.before), read,
                        in.map<float>(name, CL_MAP_WRITE));
        in.unmap();
        const Pass::Impl::Items group{x / static_cast<std::uint32_t>(impl.options.lanes), 1};
        const auto normal_with = [&](const std::set<std::size_t>& off) {
            pass_->set_parameters(without_layers(scene_, off));
            impl.enqueue(in.planes(), out.planes(), rows, both_ready(in, out), {&group, 1}).wait();
            Vec3 n{};
            for (std::size_t k = 0; k < 3; ++k) n[k] = static_cast<double>(out.map<float>(kNormal[k], CL_MAP_READ)[x]);
            out.unmap();
            return n;
        };
        const std::set<std::size_t> all = all_layers(scene_);
        const Vec3 flat = normal_with(all);
        LookPixel pixel;
        for (std::size_t i = 0; i < scene_.layers.size(); ++i) {
            if (kind_of(layer_kinds(), scene_.layers[i]).ends_stage) continue;
            std::set<std::size_t> others = all;
            others.erase(i);
            const Vec3 bumped = normal_with(others);
            // The new normal is normalize(n - g), and g is tangent to n. Equal normals give exactly 0.
            const double along = dot(flat, bumped), whole = dot(flat, flat);
            Vec3 g{};
            if (along > 0)
                for (std::size_t k = 0; k < 3; ++k) g[k] = flat[k] - bumped[k] * (whole / along);
            pixel.gradients.emplace_back(scene_.layers[i].name, g);
        }
        return pixel;
    });
}

}  // namespace wrinkle
