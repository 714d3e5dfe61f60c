#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "tests/reference/area_light.h"
#include "tests/reference/vec.h"
#include "wrinkle/scene.h"

namespace wrinkle::reference {

template <class T>
struct Surface {
    Vec<T> albedo;
    T roughness{}, f0{};
};

/// Specular reflectance D G F / (4 nl nv). GGX D [Walter et al. 2007], alpha = roughness^2; height-correlated Smith G
/// [Heitz 2014]; Schlick F [1994]. Roughness is at least 0.03, nv = max(|n.v|, 1e-4).
template <class T>
T mirrored(Vec<T> n, Vec<T> v, Vec<T> l, const Surface<T>& s) {
    constexpr T pi = std::numbers::pi_v<T>;
    const Vec<T> h = normalize(v + l);
    const T nl = std::max(dot(n, l), T(0)), nv = std::max(std::abs(dot(n, v)), T(1) / 10000);
    const T nh = dot(n, h), vh = dot(v, h);
    const T roughness = std::max(s.roughness, T(3) / 100), alpha = roughness * roughness, a2 = alpha * alpha;
    const T q = nh * nh * (a2 - 1) + 1;
    const T d = a2 / (pi * q * q);
    const auto lambda = [&](T c) { return (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1) / 2; };
    const T g = nl > 0 ? 1 / (1 + lambda(nl) + lambda(nv)) : T(0);
    const T f = s.f0 + (1 - s.f0) * std::pow(1 - saturate(vh), T(5));
    return nl > 0 ? d * g * f / (4 * nl * nv) : T(0);
}

/// Diffuse plus specular reflectance of a surface without bumps.
template <class T>
Vec<T> brdf(Vec<T> n, Vec<T> v, Vec<T> l, const Surface<T>& s) {
    const T specular = mirrored(n, v, l, s);
    return s.albedo / std::numbers::pi_v<T> + Vec<T>{specular, specular, specular};
}

/// The normal that mirrors: n, or, where the viewer's reflection would rise above the base surface by less than 0.01 or
/// than 0.9 of what the view does, the normal on the way from n to base whose reflection rises by just that. In the
/// plane of base and n at an angle a from base, the reflection rises by |v'| cos(2 a - b), where v' is the view in that
/// plane and b its angle from base.
template <class T>
Vec<T> mirror_normal(Vec<T> n, Vec<T> base, Vec<T> v) {
    const T rise = std::max(dot(v, base), T(0)), least = std::min(rise * 9 / 10, T(1) / 100);
    if (2 * dot(n, v) * dot(n, base) - rise >= least) return n;
    const Vec<T> aside = normalize(n - base * dot(n, base));
    const T along = dot(v, aside), size = std::hypot(along, rise);
    if (!(size > 0)) return base;
    const T angle = (std::atan2(along, rise) + std::acos(std::clamp(least / size, T(-1), T(1)))) / 2;
    return base * std::cos(angle) + aside * std::sin(angle);
}

/// Share of a light that a bumped surface keeps by the terminator of its base [Chiang et al. 2019].
template <class T>
T terminator(Vec<T> n, Vec<T> base, Vec<T> l) {
    if (!(dot(base, l) > 0)) return 0;
    const T below = std::max(dot(n, l), T(0)) * std::max(dot(n, base), T(0));
    const T g = below > dot(base, l) ? dot(base, l) / below : T(1);
    return -g * g * g + g * g + g;
}

/// The pictures that show what of a light is diffuse, and what is specular; "": none does.
inline const std::string& diffuse_picture(const Light& light) {
    return light.diffuse.empty() ? light.picture : light.diffuse;
}
inline const std::string& specular_picture(const Light& light) {
    return light.specular.empty() ? light.picture : light.specular;
}

/// The different pictures of lights, and "".
inline std::set<std::string> pictures(const Lighting& lighting) {
    std::set<std::string> all{""};
    for (const Light& light : lighting.lights) all.insert({diffuse_picture(light), specular_picture(light)});
    return all;
}

/// Radiance of a sky from the direction d.
template <class T>
Vec<T> sky_radiance(const Light& sky, Vec<T> d) {
    const T sine = dot(d, normalize(from_array<T>(sky.up))), intensity = sky.intensity;
    if (sine < 0) return from_array<T>(sky.ground) * intensity;
    return (from_array<T>(sky.horizon) * (1 - sine) + from_array<T>(sky.zenith) * sine) * intensity;
}

/// Irradiance / pi of the sky on a surface with the normal n: its radiance projected onto real spherical harmonics of
/// order 2, each times its factor of the clamped cosine, pi, 2 pi / 3 and pi / 4 [Ramamoorthi and Hanrahan 2001]; and
/// of that the share of directions which the base does not hide, (1 + n.base) / 2. The projection is a sum that is
/// exact for radiance which is linear in the sine of the elevation, above the horizon and below.
template <class T>
Vec<T> sky_light(const Lighting& lighting, Vec<T> n, Vec<T> base) {
    constexpr T pi = std::numbers::pi_v<T>;
    const auto harmonics = [&](Vec<T> d) {
        const T one = std::sqrt(3 / (4 * pi)), two = std::sqrt(15 / (4 * pi));
        return std::array<T, 9>{std::sqrt(1 / (4 * pi)),
                                one * d.x,
                                one * d.y,
                                one * d.z,
                                two * d.x * d.y,
                                two * d.y * d.z,
                                two * d.z * d.x,
                                two / 2 * (d.x * d.x - d.y * d.y),
                                std::sqrt(5 / (16 * pi)) * (3 * d.z * d.z - 1)};
    };
    Vec<T> sum = from_array<T>(lighting.ambient);
    const std::array<T, 9> of_normal = harmonics(n);
    for (const Light& light : lighting.lights) {
        if (light.kind != LightKind::sky) continue;
        const Vec<T> up = normalize(from_array<T>(light.up));
        const Vec<T> x = normalize(cross(up, std::abs(up.x) < T(1) / 2 ? Vec<T>{1, 0, 0} : Vec<T>{0, 1, 0}));
        const Vec<T> y = cross(up, x);
        const T node = std::sqrt(T(3) / 5) / 2;  // Gauss and Legendre, three points
        const std::pair<T, T> nodes[] = {
            {T(1) / 2 - node, T(5) / 18}, {T(1) / 2, T(4) / 9}, {T(1) / 2 + node, T(5) / 18}};
        constexpr int turns = 8;
        for (const auto& [at, weight] : nodes)
            for (const int side : {-1, 1})
                for (int turn = 0; turn < turns; ++turn) {
                    const T sine = side * at, cosine = std::sqrt(1 - sine * sine), angle = 2 * pi * turn / turns;
                    const Vec<T> d = up * sine + (x * std::cos(angle) + y * std::sin(angle)) * cosine;
                    const std::array<T, 9> of_sky = harmonics(d);
                    T kernel = of_sky[0] * of_normal[0];
                    for (int k = 1; k < 9; ++k) kernel += of_sky[k] * of_normal[k] * (k < 4 ? T(2) / 3 : T(1) / 4);
                    sum = sum + sky_radiance(light, d) * (kernel * weight * 2 * pi / turns);
                }
    }
    return sum * ((1 + dot(n, base)) / 2);
}

/// What of lights one picture shows (of "": what none does): the sums of albedo / pi max(n.l, 0) and of the specular
/// of the mirroring normal, each * irradiance * terminator.
template <class T>
struct Lobes {
    Vec<T> diffuse, specular;
};
template <class T>
Lobes<T> lobes_by(const std::string& picture, const Lighting& lighting, Vec<T> n, Vec<T> base, Vec<T> v, Vec<T> p,
                  const Surface<T>& s) {
    const auto times = [](Vec<T> a, Vec<T> b) { return Vec<T>{a.x * b.x, a.y * b.y, a.z * b.z}; };
    Lobes<T> sum;
    const Vec<T> mirror = mirror_normal(n, base, v);
    const auto add = [&](const Light& light) {
        if (light.kind == LightKind::sky) return;
        each_arrival(light, p, [&](const Arrival<T>& a) {
            const T nl = std::max(dot(n, a.direction), T(0)), ml = std::max(dot(mirror, a.direction), T(0));
            const T specular = ml > 0 ? ml * mirrored(mirror, v, a.direction, s) : T(0);
            const Vec<T> arrives = a.irradiance * terminator(n, base, a.direction);
            if (diffuse_picture(light) == picture)
                sum.diffuse = sum.diffuse + times(s.albedo * (nl / std::numbers::pi_v<T>), arrives);
            if (specular_picture(light) == picture) sum.specular = sum.specular + arrives * specular;
        });
    };
    std::ranges::for_each(lighting.lights, add);
    if (lighting.table) std::ranges::for_each(*lighting.table, add);
    return sum;
}

/// Both together.
template <class T>
Vec<T> lit_by(const std::string& picture, const Lighting& lighting, Vec<T> n, Vec<T> base, Vec<T> v, Vec<T> p,
              const Surface<T>& s) {
    const Lobes<T> both = lobes_by(picture, lighting, n, base, v, p, s);
    return both.diffuse + both.specular;
}

/// albedo * sky + all lights. v is unit, p is the world position, base the normal of the surface that carries the
/// bumps.
template <class T>
Vec<T> lit(const Lighting& lighting, Vec<T> n, Vec<T> base, Vec<T> v, Vec<T> p, const Surface<T>& s) {
    const auto times = [](Vec<T> a, Vec<T> b) { return Vec<T>{a.x * b.x, a.y * b.y, a.z * b.z}; };
    Vec<T> sum = times(s.albedo, sky_light(lighting, n, base));
    for (const std::string& picture : pictures(lighting)) sum = sum + lit_by(picture, lighting, n, base, v, p, s);
    return sum;
}

/// The same of a surface without bumps.
template <class T>
Vec<T> lit(const Lighting& lighting, Vec<T> n, Vec<T> v, Vec<T> p, const Surface<T>& s) {
    return lit(lighting, n, n, v, p, s);
}

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

/// What relighting knows of a pixel: its picture, those of lights, and what lights and sky give with the bumped and
/// with the base normal.
template <class T>
struct Relit {
    enum class Shows { both, diffuse, specular };
    struct Part {
        Vec<T> picture, now, old;
        Shows shows = Shows::both;
    };
    Vec<T> beauty;
    std::vector<Part> own;      ///< lights with pictures
    Part others, sky;           ///< lights without (no picture), and the irradiance / pi of the sky
    std::vector<Part> alone{};  ///< each of those whose shadows are read apart; none: they are read together
    /// What the frame shows as specular of all light, and what is specular of lights without pictures, where it is
    /// known apart; `others` is what is diffuse then.
    std::optional<Part> mirrored{};

    /// Every light's own picture times its ratio; of the rest, what lights without pictures can give where the picture
    /// shows that they reach it times theirs, and all else times the sky's. What is specular of the rest and known
    /// apart: what the lights can give times theirs, and all else as it is.
    Vec<T> picture(const Lighting& lighting, Vec<T> albedo) const {
        const auto each = [](auto&& of) { return Vec<T>{of(&Vec<T>::x), of(&Vec<T>::y), of(&Vec<T>::z)}; };
        const auto times_ratio = [&](Vec<T> a, const Part& part) {
            return each([&](auto c) { return a.*c * relight_ratio(part.now.*c, part.old.*c, T(lighting.max_ratio)); });
        };
        Vec<T> rest = beauty, result;
        for (const Part& part : own) {
            const Vec<T> shown = each([&](auto c) { return std::max(part.picture.*c, T(0)); });
            rest = rest - shown, result = result + times_ratio(shown, part);
        }
        // What lights' pictures show beyond the beauty is not taken from it twice.
        const Vec<T> over = each([&](auto c) { return std::min(rest.*c, T(0)); });
        rest = rest - over, result = result + over;
        const Vec<T> shine = mirrored ? specular_of(rest) : Vec<T>{};
        rest = rest - shine;
        const auto sky_now = each([&](auto c) { return albedo.*c * sky.now.*c; });
        const auto sky_old = each([&](auto c) { return albedo.*c * sky.old.*c; });
        if (lighting.shadows != Shadows::read) {
            result = result + times_ratio(rest, {{}, others.now + sky_now, others.old + sky_old});
            const Vec<T> around = sky.old * T(lighting.f0);
            if (mirrored) result = result + times_ratio(shine, {{}, mirrored->now + around, mirrored->old + around});
        } else {
            const Vec<T> beyond = rest - sky_old;
            const T given = others.old.x + others.old.y + others.old.z;
            const bool dark =
                std::ranges::none_of(lighting.lights, [](const Light& l) { return l.kind == LightKind::sky; }) &&
                lighting.ambient == Vec3{};
            const T least = dark ? T(1) / 2 : T(0);
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
