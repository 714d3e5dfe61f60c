#include "plan/mask_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/cryptomatte.h"
#include "io/object_ids.h"
#include "plan/planned_numbers.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::size_t kMostObjects = 1024;  // every pixel is compared with each of them

/// Text that declares `is_object`, 1 where the pixel's object is one of the mask's.
std::string object_text(Emitter& emitter, const MaskPlace& place, Section& section) {
    emitter.need(place.who, {"object"});
    section.inputs.insert("object");
    const std::size_t count = place.mask(emitter.scene).object.size();
    section.operations += static_cast<double>(count);
    const std::size_t first =
        add_numbers(emitter, "mask object of " + place.what, [mask = place.mask](const NumberSource& source) {
            std::vector<double> labels;
            for (const double object : mask(source.scene).object) labels.push_back(io::object_label(object));
            return labels;
        });
    if (count == 1)
        return fmt::format("        wr_real is_object = wr_mask_object(wr_load(in_object, at.in), numbers[{}]);\n",
                           first);
    return fmt::format(
        "        wr_real is_object = 0;\n"
        "        for (uint k = 0; k < {}; ++k)\n"
        "            is_object = fmax(is_object, wr_mask_object(wr_load(in_object, at.in), numbers[{} + k]));\n",
        count, first);
}

/// Text that declares `covered`, the share of the pixel that objects of a Cryptomatte cover; of a mask for bumps, as
/// far as their surface is the pixel's.
std::string cryptomatte_text(Emitter& emitter, const MaskPlace& place, Section& section) {
    emitter.need(place.who, {"crypto.id0", "crypto.coverage0"});
    // A float cannot hold 32 bits, so a hash is passed as two halves.
    const auto halves = [mask = place.mask, who = place.who](const NumberSource& source) {
        std::vector<double> numbers;
        for (const std::uint32_t id : cryptomatte_hashes(source.cryptomatte, mask(source.scene).cryptomatte, who))
            numbers.insert(numbers.end(), {static_cast<double>(id >> 16), static_cast<double>(id & 0xffff)});
        return numbers;
    };
    const std::size_t count = halves({emitter.scene, emitter.available.cryptomatte}).size() / 2;
    const std::size_t first = add_numbers(emitter, "mask cryptomatte of " + place.what, halves);
    // Frames that somebody else made lack the plane; there Cryptomatte's first rank, which covers most, is in front.
    const std::string front = emitter.has("crypto.front") ? "crypto.front" : "crypto.id0";
    std::string text = fmt::format("        wr_real covered = 0{};\n", place.bumps ? ", in_front = 0" : "");
    const std::string hash = "uint object_hash = (uint)numbers[{0}] << 16 | (uint)numbers[{0} + 1];\n";
    if (count == 1)
        text += "        " + fmt::format(fmt::runtime(hash), first);
    else
        text += fmt::format("        for (uint k = 0; k < {}; ++k) {{\n        ", count) +
                fmt::format(fmt::runtime(hash), fmt::format("{} + 2 * k", first));
    for (int rank = 0; emitter.has(fmt::format("crypto.id{}", rank)); ++rank) {
        const std::string id = fmt::format("crypto.id{}", rank), coverage = fmt::format("crypto.coverage{}", rank);
        section.inputs.insert({id, coverage});
        text += fmt::format(
            "        covered += wr_mask_cryptomatte(wr_load_floats({}, at.in), wr_load({}, at.in), object_hash);\n",
            identifier(id), identifier(coverage));
        section.operations += 3 * static_cast<double>(count);
    }
    if (!place.bumps) return text + (count == 1 ? "" : "        }\n");
    section.inputs.insert(front);
    const std::string load = fmt::format("wr_load_floats({}, at.in)", identifier(front));
    return text +
           fmt::format("        in_front += wr_mask_cryptomatte({}, (wr_real)(1), object_hash);\n{}", load,
                       count == 1 ? "" : "        }\n") +
           fmt::format("        covered = wr_mask_front({}, in_front, covered, {});\n", load,
                       place.mask(emitter.scene).invert ? 1 : 0);
}

}  // namespace

MaskPlace mask_of_layer(const Emitter& emitter, const Layer& layer) {
    return {
        layer_label(layer), layer_label(layer) + ": its mask",
        [index = emitter.index_of(layer)](const Scene& scene) -> const Mask& { return scene.layers.at(index).mask; },
        /*bumps=*/true};
}

std::string mask_of_planes(Emitter& emitter, const MaskPlace& place, Section& section) {
    const Mask& mask = place.mask(emitter.scene);
    std::string text = "        wr_real m = 1;\n";
    const auto factor = [&](const std::string& value) {
        text += fmt::format("        m *= {};\n", value);
        section.operations += 2;
    };
    if (!mask.object.empty()) {
        text += object_text(emitter, place, section);
        factor("is_object");
    }
    if (!mask.cryptomatte.empty()) {
        text += cryptomatte_text(emitter, place, section);
        factor("wr_mask_channel(covered)");
    }
    if (mask.channel) {
        const std::string plane = "channel:" + *mask.channel;
        emitter.need(place.who, {plane});
        section.inputs.insert(plane);
        factor(fmt::format("wr_mask_channel(wr_load({}, at.in))", identifier(plane)));
    }
    return text;
}

std::vector<std::uint32_t> cryptomatte_hashes(const std::map<std::string, std::uint32_t>& known,
                                              const std::vector<std::string>& names, const std::string& who) {
    std::vector<std::uint32_t> hashes;
    for (const std::string& name : names) {
        if (known.contains(name) || !io::is_name_pattern(name)) {
            hashes.push_back(cryptomatte_hash(known, name, who));
            continue;
        }
        const std::size_t before = hashes.size();
        std::string all;
        for (const auto& [other, hash] : known) {
            if (io::matches_name(name, other)) hashes.push_back(hash);
            all += (all.empty() ? "" : ", ") + other;
        }
        if (hashes.size() == before)
            throw Error(fmt::format("{} names the Cryptomatte objects \"{}\", which matches none; the file knows {}",
                                    who, name, all.empty() ? "no names" : all));
    }
    std::ranges::sort(hashes);
    hashes.erase(std::unique(hashes.begin(), hashes.end()), hashes.end());
    if (hashes.size() > kMostObjects)
        throw Error(fmt::format("{} names {} Cryptomatte objects; at most {} can be told apart from the rest", who,
                                hashes.size(), kMostObjects));
    return hashes;
}

}  // namespace wrinkle
