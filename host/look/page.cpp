#include "look/page.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "look/page_sources.h"

namespace wrinkle {
namespace {

std::string source(std::string_view name) {
    for (const PageSource& source : page_sources())
        if (source.name == name) return source.text;
    throw std::logic_error("a part of the page is not embedded");
}

}  // namespace

std::string page_json(const nlohmann::json& data) {
    return data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string page_of(const nlohmann::json& data, bool live) {
    std::string json;
    for (const char c : page_json(data)) c == '<' ? json += "\\u003c" : json += c;  // else "</script>" would end it
    std::string out;
    // Text that was put in is not looked at for places.
    std::string_view rest;
    const std::string html = source("page.html");
    rest = html;
    for (const auto& [place, text] : {std::pair<std::string_view, std::string>{"@CSS@", source("page.css")},
                                      {"@DATA@", json},
                                      {"@JS@", source("page.js") + (live ? source("live.js") : "")}}) {
        const std::size_t at = rest.find(place);
        out += rest.substr(0, at);
        out += text;
        rest.remove_prefix(at + place.size());
    }
    return out += rest;
}

}  // namespace wrinkle
