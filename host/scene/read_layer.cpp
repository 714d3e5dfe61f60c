#include <fmt/format.h>

#include "base/names.h"
#include "scene/kinds.h"
#include "scene/readers.h"

namespace wrinkle::scene {

void read_layer(Table& table, LayerKinds kinds, std::size_t number, Layer& out) {
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
