#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tests/reference/lighting.h"

namespace wrinkle::reference {

/// clamp((new + 1e-4) / (old + 1e-4), 1 / max_ratio, max_ratio), of one channel.
template <class T>
T relight_ratio(T lit_new, T lit_old, T max_ratio) {
    const T small = T(1) / 10000;
    return std::clamp((lit_new + small) / (lit_old + small), 1 / max_ratio, max_ratio);
}

/// How much of each light reaches a pixel, and of all their light: of every choice of lights the mean, weighted by
/// 1 / (1 + (distance / width)^2)^2 of what it gives from what the picture shows; no more than that is given. `dark` of
/// all light is other light.
template <class T>
std::pair<std::vector<T>, T> visibilities(Vec<T> shown, Vec<T> sky, const std::vector<Vec<T>>& lit, T dark) {
    const auto sum = [](Vec<T> a) { return a.x + a.y + a.z; };
    Vec<T> all;
    for (const Vec<T>& light : lit) all = all + light;
    const T width = (sum(all) + sum(sky) / 10) / 20 + sum(shown) / 1000000 + T(1e-20);
    shown = shown - sky - all * dark;
    std::vector<T> reached(lit.size());
    T weights = 0, given = 0;
    for (std::size_t choice = 0; choice < (std::size_t{1} << lit.size()); ++choice) {
        Vec<T> gap = shown;
        for (std::size_t k = 0; k < lit.size(); ++k)
            if (choice >> k & 1) gap = gap - lit[k] * (1 - dark);
        const T weight = 1 / std::pow(1 + dot(gap, gap) / (width * width), T(2));
        weights += weight;
        for (std::size_t k = 0; k < lit.size(); ++k)
            if (choice >> k & 1) reached[k] += weight;
    }
    for (std::size_t k = 0; k < lit.size(); ++k) reached[k] /= weights, given += reached[k] * sum(lit[k]);
    const T bound = given > 0 ? std::clamp(sum(shown) / ((1 - dark) * given), T(0), T(1)) : T(0);
    for (T& share : reached) share *= bound;
    return {reached, sum(all) > 0 ? bound * given / sum(all) : T(0)};
}

/// What a white surface at a point shows of a light that it faces, whatever its cone.
template <class T>
Vec<T> facing(const Light& light, Vec<T> world) {
    T strength = T(light.intensity) / std::numbers::pi_v<T>;
    if (light.kind != LightKind::sun) {
        const Vec<T> gap = from_array<T>(light.position) - world;
        const T square = dot(gap, gap), part = light.range ? square / T(*light.range * *light.range) : T(0);
        const T left = std::max(T(1) - part * part, T(0));
        strength = strength / square * left * left;
    }
    return from_array<T>(light.color) * strength;
}

/// Whether a scene tells of no sky. What no light explains then comes from all around, as a tenth of what a white
/// surface shows of the lights that it faces.
inline bool is_dark(const Lighting& lighting) {
    const auto none = [](const Light& l) { return l.kind == LightKind::sky; };
    return std::ranges::none_of(lighting.lights, none) && lighting.ambient == Vec3{};
}
template <class T>
Lighting with_faint_light(Lighting lighting, Vec<T> world) {
    if (!is_dark(lighting)) return lighting;
    for (const Light& light : lighting.lights) {
        const Vec<T> given = facing(light, world) / T(10);
        lighting.ambient[0] += double(given.x), lighting.ambient[1] += double(given.y);
        lighting.ambient[2] += double(given.z);
    }
    return lighting;
}

/// What relighting knows of a pixel: its picture, those of lights, and what lights and sky give with the bumped and
/// with the base normal.
template <class T>
struct Relit {
    enum class Shows { both, diffuse, specular };
    struct Part {
        Vec<T> picture, now, old;
        Shows shows = Shows::both;
        T facing = 0;  ///< the sum of what a white surface shows of these lights where it faces them
    };
    Vec<T> beauty;
    std::vector<Part> own;      ///< lights with pictures
    Part others, sky;           ///< lights without (no picture), and the irradiance / pi of the sky
    std::vector<Part> alone{};  ///< each of those whose shadows are read apart; none: they are read together
    /// What the frame shows as specular of all light, and what is specular of lights without pictures, where it is
    /// known apart; `others` is what is diffuse then.
    std::optional<Part> mirrored{};

    /// Every light's own picture times its ratio, in which as much of the sky as is .007 of the light stands for what
    /// surfaces send on of it; of the rest, what lights without pictures can give where the picture shows that they
    /// reach it times theirs, and all else times the sky's. What is specular of the rest and known apart: what the
    /// lights can give times theirs, and all else as it is.
    Vec<T> picture(const Lighting& lighting, Vec<T> albedo) const {
        const auto each = [](auto&& of) { return Vec<T>{of(&Vec<T>::x), of(&Vec<T>::y), of(&Vec<T>::z)}; };
        const auto times_ratio = [&](Vec<T> a, const Part& part) {
            return each([&](auto c) { return a.*c * relight_ratio(part.now.*c, part.old.*c, T(lighting.max_ratio)); });
        };
        Vec<T> rest = beauty, result;
        const auto sky_now = each([&](auto c) { return albedo.*c * sky.now.*c; });
        const auto sky_old = each([&](auto c) { return albedo.*c * sky.old.*c; });
        for (const Part& part : own) {
            const Vec<T> shown = each([&](auto c) { return std::max(part.picture.*c, T(0)); });
            rest = rest - shown;
            const T bounce = T(7) / 1000 * part.facing / (sky.old.x + sky.old.y + sky.old.z);
            result = result + times_ratio(shown, {{}, part.now + sky_now * bounce, part.old + sky_old * bounce});
        }
        // What lights' pictures show beyond the beauty is not taken from it twice.
        const Vec<T> over = each([&](auto c) { return std::min(rest.*c, T(0)); });
        rest = rest - over, result = result + over;
        const Vec<T> shine = mirrored ? specular_of(rest) : Vec<T>{};
        rest = rest - shine;
        if (lighting.shadows != Shadows::read) {
            result = result + times_ratio(rest, {{}, others.now + sky_now, others.old + sky_old});
            const Vec<T> around = sky.old * T(lighting.f0);
            if (mirrored) result = result + times_ratio(shine, {{}, mirrored->now + around, mirrored->old + around});
        } else {
            const Vec<T> beyond = rest - sky_old;
            const T given = others.old.x + others.old.y + others.old.z;
            const T least = is_dark(lighting) ? T(1) / 2 : T(0);
            const T share = given > 0 ? ((beyond.x + beyond.y + beyond.z) / given - least) / (1 - least) : T(0);
            T reached = std::clamp(share, T(0), T(1));
            const auto give = [&](const Part& part, T of_it) {
                const Vec<T> lamps = each([&](auto c) { return std::min(part.old.*c * of_it, rest.*c); });
                result = result + times_ratio(lamps, part), rest = rest - lamps;
            };
            if (alone.empty()) {
                give(others, reached);
            } else {
                std::vector<Vec<T>> lit;
                for (const Part& part : alone) lit.push_back(part.old);
                const auto [shares, of_all] = visibilities(rest, sky_old, lit, least);
                for (std::size_t k = 0; k < alone.size(); ++k) give(alone[k], shares[k]);
                reached = of_all;
            }
            result = result + times_ratio(rest, sky);
            if (mirrored) {
                const Vec<T> lit = each([&](auto c) { return std::min(mirrored->old.*c * reached, shine.*c); });
                result = result + times_ratio(lit, *mirrored) + (shine - lit);
            }
        }
        return each([&](auto c) { return std::max(result.*c, std::min(beauty.*c, T(0))); });
    }

private:
    /// What of the rest of the picture is specular: all that is, less what pictures of lights show of it alone, and of
    /// that as much as the rest is of what it and pictures of both show.
    Vec<T> specular_of(Vec<T> rest) const {
        Vec<T> all = mirrored->picture, both;
        for (const Part& part : own)
            for (T Vec<T>::*c : {&Vec<T>::x, &Vec<T>::y, &Vec<T>::z}) {
                if (part.shows == Shows::specular) all.*c -= std::max(part.picture.*c, T(0));
                if (part.shows == Shows::both) both.*c += std::max(part.picture.*c, T(0));
            }
        for (T Vec<T>::*c : {&Vec<T>::x, &Vec<T>::y, &Vec<T>::z}) {
            if (both.*c > 0) all.*c *= rest.*c / (rest.*c + both.*c);
            all.*c = std::clamp(all.*c, T(0), rest.*c);
        }
        return all;
    }
};

}  // namespace wrinkle::reference
