#include "stack.h"

#include "wrinkle/error.h"

namespace wrinkle::baseline {

namespace {

void put(float (&to)[3], const float3& from) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

}  // namespace

DecalStack::DecalStack(const Scene& scene, Size size, const Camera& camera,
                       const std::map<std::filesystem::path, Image>& textures)
    : size_(size) {
    const CameraTerms terms = camera_terms(camera, size);
    const std::vector<Stage> stages = LayerBuilder(terms, textures, {}).stages(scene);
    if (stages.size() != 1 || !terms.pinhole) throw Unsupported("baseline: a stack of decals has one stage");
    put(job_.d0, terms.d0), put(job_.dx, terms.dx), put(job_.dy, terms.dy);
    job_.width = static_cast<int>(size.width);
    for (const PreparedLayer& layer : stages.front().layers) {
        const auto* decal = std::get_if<Decal>(&layer.bump);
        if (decal == nullptr || decal->source.slopes == nullptr || layer.footprint || layer.mask.any ||
            decal->per_falloff == 0 || decal->per_fade == 0)
            throw Unsupported("baseline: a stack holds decals of smooth slopes and edges, without footprint or mask");
        textures_.push_back(decal->source.slopes);
        const Pyramid<float2>& slopes = *decal->source.slopes;
        StackDecal& out = decals_.emplace_back();
        put(out.to_x, decal->to_x), put(out.to_y, decal->to_y), put(out.to_z, decal->to_z);
        put(out.centre, decal->centre), put(out.axis_z, decal->axis_z);
        put(out.grad_s, layer.scale * decal->grad_s), put(out.grad_t, layer.scale * decal->grad_t);
        out.per_falloff = decal->per_falloff, out.fade_from = decal->fade_from, out.per_fade = decal->per_fade;
        out.slopes = &slopes.finest()->x;
        out.width = slopes.width(), out.height = slopes.height(), out.stride = slopes.width() + 2;
    }
    job_.decals = decals_.data(), job_.count = static_cast<int>(decals_.size());
}

void DecalStack::run(StackRows rows, const PlaneMap& planes, Planes out) const {
    constexpr int kRows = 8;
    StackJob job = job_;
    job.depth = planes.at("depth").data();
    job.n_x = planes.at("normal.x").data(), job.n_y = planes.at("normal.y").data();
    job.n_z = planes.at("normal.z").data();
    job.out_x = out.x.data(), job.out_y = out.y.data(), job.out_z = out.z.data();
    const int height = static_cast<int>(size_.height);
#pragma omp parallel for schedule(dynamic, 1)
    for (int y = 0; y < height; y += kRows) rows(job, y, std::min(y + kRows, height));
}

std::map<std::string, StackRows> stack_forms() {
    return {
        {"plain C++", stack_rows_plain},
        {"plain C++, fast-math", stack_rows_plain_fast},
        {"omp simd, g++", stack_rows_simd},
#ifdef WRINKLE_BASELINE_CLANG
        {"omp simd, clang++", stack_rows_simd_clang},
#endif
#ifdef WRINKLE_BASELINE_AVX2
        {"by hand, 8 lanes", stack_rows_hand8},
#endif
#ifdef WRINKLE_BASELINE_AVX512
        {"by hand, 16 lanes", stack_rows_hand16},
#endif
    };
}

}  // namespace wrinkle::baseline
