#include "run/mask_matches.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/cryptomatte.h"
#include "io/front_objects.h"
#include "layers/kinds.h"
#include "plan/section.h"

namespace wrinkle {

namespace {

constexpr std::size_t kMostListed = 16;
constexpr double kManyMixed = 0.005;  // of all pixels

/// Both zeros are one label.
std::uint32_t label_of(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return bits == 0x80000000u ? 0 : bits;
}

std::string listed(const std::vector<std::string>& names, bool more) {
    return fmt::format("{}{}", fmt::join(names, ", "), more ? ", ..." : "");
}

}  // namespace

void MaskMatches::add(const Mask& mask, std::size_t layer) {
    for (const double object : mask.object) wanted_.push_back({.layer = layer, .index = object});
    for (const std::string& name : mask.cryptomatte) wanted_.push_back({.layer = layer, .name = name});
}

MaskMatches::MaskMatches(const Scene& scene) {
    for (const Layer& layer : scene.layers) {
        const std::size_t number = layers_.size();
        layers_.push_back(layer_label(layer));
        if (!layer.mask.invert) add(layer.mask, number);
        const LayerKind& kind = kind_of(layer_kinds(), layer);
        if (!kind.objects) continue;
        for (const NamedObject& object : kind.objects(layer))
            wanted_.push_back(
                {.layer = number, .name = object.cryptomatte, .index = object.index, .place = object.place});
    }
    if (scene.lighting.leave && !scene.lighting.leave->invert) {
        layers_.emplace_back("leave in [lighting]");
        add(*scene.lighting.leave, layers_.size() - 1);
    }
}

bool MaskMatches::looks_for_the_same(const MaskMatches& other) const {
    return layers_ == other.layers_ && std::ranges::equal(wanted_, other.wanted_, [](const auto& a, const auto& b) {
               return a.layer == b.layer && a.name == b.name && a.index == b.index;
           });
}

void MaskMatches::begin(const Frame& frame, io::ObjectStorage objects) {
    storage_ = objects;
    objects_.unseen.clear(), ids_.unseen.clear();
    for (const auto& [name, id] : frame.cryptomatte) names_.emplace(id, name);
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        const Wanted& wanted = wanted_[i];
        if (wanted.seen) continue;
        if (wanted.name.empty())
            objects_.unseen[label_of(io::object_label(wanted.index))].push_back(i);
        else if (const auto id = frame.cryptomatte.find(wanted.name); id != frame.cryptomatte.end())
            ids_.unseen[id->second].push_back(i);
        else if (io::is_name_pattern(wanted.name))
            for (const auto& [name, hash] : frame.cryptomatte)
                if (io::matches_name(wanted.name, name)) ids_.unseen[hash].push_back(i);
    }
}

void MaskMatches::look(Labels& labels, const float* values, const float* coverages, std::size_t pixels) {
    std::uint32_t last = 0;
    bool any = false;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint32_t label = label_of(values[i]);
        if ((any && label == last) || (coverages != nullptr && !(coverages[i] > 0))) continue;
        last = label, any = true;
        if (std::ranges::find(labels.shown, label) == labels.shown.end()) {
            labels.more = labels.shown.size() == kMostListed;
            if (!labels.more) labels.shown.push_back(label);
        }
        const auto found = labels.unseen.find(label);
        if (found == labels.unseen.end()) continue;
        for (const std::size_t wanted : found->second) wanted_[wanted].seen = true;
        labels.unseen.erase(found);
        if (labels.unseen.empty()) return;
    }
}

void MaskMatches::see(const std::map<std::string, const float*>& planes, std::size_t pixels) {
    if (const auto object = planes.find("object"); object != planes.end()) {
        if (!objects_.unseen.empty()) look(objects_, object->second, nullptr, pixels);
        if (storage_ == io::ObjectStorage::single) {
            object_pixels_ += pixels;
            mixed_pixels_ +=
                static_cast<std::uint64_t>(std::count_if(object->second, object->second + pixels, io::is_mixed_object));
        }
    }
    if (const auto front = planes.find(std::string(io::kFrontPlane)); front != planes.end()) {
        front_pixels_ += pixels;
        unknown_pixels_ += static_cast<std::uint64_t>(
            std::count_if(front->second, front->second + pixels, [](float id) { return id == 0 && std::signbit(id); }));
    }
    for (int rank = 0; !ids_.unseen.empty(); ++rank) {
        const auto id = planes.find(fmt::format("crypto.id{}", rank));
        const auto coverage = planes.find(fmt::format("crypto.coverage{}", rank));
        if (id == planes.end() || coverage == planes.end()) return;
        look(ids_, id->second, coverage->second, pixels);
    }
}

double MaskMatches::number_of(std::uint32_t label) const {
    const auto value = std::bit_cast<float>(label);
    return storage_ == io::ObjectStorage::single && !(std::abs(value) > 1 << 24) ? value : io::object_number(value);
}

std::string MaskMatches::shown(const Labels& labels, bool names) const {
    std::vector<std::string> texts;
    std::vector<double> indices;
    for (const std::uint32_t label : labels.shown) {
        if (!names)
            indices.push_back(number_of(label));
        else if (const auto name = names_.find(label); name != names_.end())
            texts.push_back(name->second);
        else
            texts.push_back(fmt::format("#{:08x}", label));
    }
    std::ranges::sort(indices);
    std::ranges::sort(texts);
    for (const double index : indices) texts.push_back(fmt::format("{}", index));
    return texts.empty() ? "nothing" : listed(texts, labels.more);
}

std::vector<std::string> MaskMatches::warnings_of_pixels() const {
    std::vector<std::string> lines;
    const double mixed =
        static_cast<double>(mixed_pixels_) / static_cast<double>(std::max<std::uint64_t>(object_pixels_, 1));
    const bool asked_for = std::ranges::any_of(
        wanted_, [](const Wanted& wanted) { return io::is_mixed_object(static_cast<float>(wanted.index)); });
    if (mixed >= kManyMixed && !asked_for)
        lines.push_back(fmt::format(
            "object numbers: {:.1f}% of the pixels hold no whole number but the average of several objects, and "
            "belong to none of them; render the object pass with one sample a pixel, or mask by Cryptomatte",
            100 * mixed));
    const double unknown =
        static_cast<double>(unknown_pixels_) / static_cast<double>(std::max<std::uint64_t>(front_pixels_, 1));
    if (unknown >= kManyMixed)
        lines.push_back(fmt::format(
            "Cryptomatte: {:.1f}% of the pixels show several objects, and nothing tells which of them the depth and "
            "normal passes are of; masks by Cryptomatte bump none of them there. Render those passes with one sample a "
            "pixel, an object index pass beside them, or mask by that",
            100 * unknown));
    return lines;
}

std::vector<std::string> MaskMatches::warnings() const {
    std::vector<std::string> lines;
    for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
        std::string line;
        for (const bool names : {false, true}) {
            std::vector<std::string> missing;
            std::size_t count = 0;
            for (const Wanted& wanted : wanted_) {
                if (wanted.layer != layer || wanted.seen || wanted.name.empty() == names) continue;
                if (++count > kMostListed) continue;
                missing.push_back(names ? "\"" + wanted.name + "\"" : fmt::format("{}", wanted.index));
                if (!wanted.place.empty()) missing.back() += fmt::format(" ({})", wanted.place);
            }
            if (missing.empty()) continue;
            line += fmt::format("{}no pixel has {} {}; the frame has {}", line.empty() ? "" : "; ",
                                names ? "the Cryptomatte object" : "object", listed(missing, count > kMostListed),
                                shown(names ? ids_ : objects_, names));
        }
        if (!line.empty()) lines.push_back(layers_[layer] + ": " + line);
    }
    for (std::string& line : warnings_of_pixels()) lines.push_back(std::move(line));
    return lines;
}

}  // namespace wrinkle
