#include <fmt/format.h>

#include "base/names.h"
#include "scene/kinds.h"
#include "scene/readers.h"

namespace wrinkle::scene {

namespace {

void visit_layer(Table& table, LayerKinds kinds, Layer& layer) {
    if (table.read("name", layer.name, Compiled::no)) table.rename("layer " + quote(layer.name));
    const LayerKind& kind = kind_of(kinds, layer);
    table.compiled_in("kind", std::string(kind.name));
    table.compiled_in("project", layer.project);
    kind.read(table, layer);
}

}  // namespace

void read_layer(Table& table, LayerKinds kinds, std::size_t number, Layer& out) {
    if (table.visits()) return visit_layer(table, kinds, out);
    out.location = table.location();
    const bool is_named = table.read("name", out.name);
    if (is_named) table.rename("[[layer]] " + quote(out.name));
    std::vector<Kind<Layer>> rows;
    for (const LayerKind* kind : kinds) rows.push_back({kind->name, kind->read});
    const Kind<Layer>* kind = choose_kind<Layer>(table, rows);
    if (!is_named) {
        out.name = fmt::format("{} {}", kind ? kind->name : "layer", number);
        if (kind) table.rename("[[layer]] " + quote(out.name));
    }
    read_as_kind<Layer>(table, rows, kind, out);
}

}  // namespace wrinkle::scene
