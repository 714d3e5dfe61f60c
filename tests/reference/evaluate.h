#pragma once

#include "tests/reference/scene_mask.h"
#include "tests/reference/triplanar_layer.h"

namespace wrinkle::reference {

/// One evaluated pixel.
template <class T>
struct Evaluated {
    bool valid = false;
    Vec<T> normal;                   ///< the new normal; of an invalid pixel the one it had, zero if that is not finite
    Vec<T> base_normal;              ///< decoded: unit, towards the viewer
    Vec<T> surface_gradient;         ///< of the last stage
    ScreenDerivative<T> base, last;  ///< dp_dx and dp_dy, on the base normal and on the last stage's
    Vec<T> position, view;           ///< eye-relative, where parallax moved it to; unit vector towards the eye
    int marked = 0;                  ///< as Marked in wrinkle/gbuffer.h
    bool stage_reflected = false;    ///< the normal of an earlier stage faced away and was reflected
};

/// Evaluates a scene pixel by pixel, in T, which is double. `planes` and `images` must outlive it.
template <class T>
class SceneEvaluator {
public:
    SceneEvaluator(const Scene& scene, Size size, const Camera& camera, Planes planes, const Images& images);

    const Scene& scene() const { return scene_; }
    const Frame<T>& frame() const { return frame_; }

    Evaluated<T> evaluate(std::size_t i) const;

    /// The colour that the scene's lighting writes: the lit colour, or the beauty plane times the ratio of lit colours
    /// with the new and with the base normal.
    Vec<T> relit(std::size_t i, const Evaluated<T>& e) const;
    Vec<T> relit_metal(std::size_t i, const Evaluated<T>& e, Vec<T> beauty) const;

private:
    struct Entry {
        LayerFunction<T> function;  ///< empty for a resolve
        ShiftFunction<T> shift;     ///< of a parallax; else empty
        bool curved;                ///< of a parallax: it turns the normal, too
        T scale;                    ///< negative when the layer is subtracted
        SceneMask<T> mask;
        bool project = true;
        Combine combine = Combine::surface_gradient;
    };

    /// Moves the surfel along the pixel's ray. Texture coordinates are continued linearly, and keep their derivatives.
    void move(std::size_t i, const Entry& layer, T depth, Surfel<T>& s, Evaluated<T>& out) const;

    /// What of the picture is specular, where the frame tells.
    std::optional<Vec<T>> specular(std::size_t i) const;

    Vec<T> rgb(const std::string& layer, std::size_t i, const char* names = "rgb") const;

    Scene scene_;
    Frame<T> frame_;
    std::vector<Entry> layers_;
    bool uses_uv_ = false, uses_vertex_ = false;
};

extern template class SceneEvaluator<double>;

}  // namespace wrinkle::reference
