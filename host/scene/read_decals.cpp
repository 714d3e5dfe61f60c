#include <fmt/format.h>

#include "scene/layer_readers.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {

void read_decals(Table& table, Layer& layer) {
    DecalsLayer bump;
    table.require("textures");
    for (Table& each : table.tables("textures")) {
        TextureUse& texture = bump.textures.emplace_back();
        each.rename(fmt::format("texture {} of {}", bump.textures.size() - 1, table.where()));
        each.require("file");
        each.read_file("file", texture.file);
        each.choose("content", texture.content,
                    {{"height", Content::height}, {"normal", Content::normal}, {"slope", Content::slope}});
        read_green(each, texture);
        if (texture.content == Content::height && each.has("y") && !each.is_bad("content"))
            each.complain("y", "has an effect only with content = \"normal\" or \"slope\"; remove it or set that");
        each.finish();
    }
    if (table.has("textures") && bump.textures.empty() && !table.is_bad("textures"))
        table.complain("textures", "must list at least one { file = \"...\" }");
    table.require("file");
    if (table.read_file("file", bump.file) && !bump.textures.empty()) {
        try {
            bump.rows = std::make_shared<const std::vector<Projector>>(load_decals(bump.file, bump.textures.size()));
        } catch (const Error& error) { table.complain("file", fmt::format("cannot be used:\n{}", error.what())); }
    }
    read_weight(table, layer);
    layer.bump = std::move(bump);
}

}  // namespace wrinkle::scene
