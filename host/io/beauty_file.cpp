#include "io/beauty_file.h"

#include <fmt/format.h>

#include <vector>

#include "base/names.h"
#include "io/channel_index.h"
#include "io/writer_names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

void require_one_beauty(std::span<const std::string> channels, const std::string& file) {
    const ChannelIndex index(channels);
    const Role colours{"beauty", {"", "", ""}};
    std::vector<std::string> found;
    for (const std::string& layer : index.layers) {
        if (index.match(colours, layer).empty()) continue;
        if (layer.empty()) return;
        const std::string base = layer.substr(layer.rfind('.') + 1);  // npos + 1 is 0
        if (role_of_layer(plain_layer_name(base)) == "beauty") found.push_back(layer);
    }
    if (found.size() > 1)
        throw Error(
            fmt::format("{}: the layers {} could be the beauty; say which, as in beauty = {{ file = \"...\", "
                        "layer = {} }}",
                        file, quote_list(found), quote(found.front())));
}

}  // namespace wrinkle::io
