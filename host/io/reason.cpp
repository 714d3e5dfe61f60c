#include "io/reason.h"

#include <fmt/format.h>

namespace wrinkle::io {

std::string reason(std::string text) {
    text = text.substr(0, text.find('\n'));
    while (text.ends_with(' ')) text.pop_back();
    // OpenEXR says 'Cannot read image file "F". WHY'. Only WHY is kept, as our message has named the file already.
    if (const auto name = text.find("image file \""); name != std::string::npos) {
        const auto why = text.find("\". ", name);
        if (why != std::string::npos) text = text.substr(why + 3);
    }
    while (text.ends_with('.')) text.pop_back();
    constexpr std::size_t longest = 200;
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return text.empty() ? "" : fmt::format(" ({})", text);
}

}  // namespace wrinkle::io
