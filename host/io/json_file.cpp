#include "io/json_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/names.h"
#include "base/only_errors.h"
#include "base/text_file.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

using nlohmann::json;

json parse(const std::filesystem::path& file, const char* what, const char* expected) {
    const std::string content = read_text(file, what);
    try {
        auto value = json::parse(content);
        if (value.is_object()) return value;
    } catch (const json::out_of_range& error) {
        const std::string text = error.what();  // "[json.exception...] number overflow parsing '1e999'"
        const auto begin = text.find('\''), end = text.rfind('\'');
        const std::string number = begin < end ? text.substr(begin + 1, end - begin - 1) : "";
        const auto place =
            content.begin() + static_cast<std::ptrdiff_t>(std::min(content.find(number), content.size()));
        throw Error(fmt::format("{}: not {}: a number at line {} is out of range: {}", file.string(), what,
                                1 + std::count(content.begin(), place, '\n'), quote(number)));
    } catch (const json::exception& error) {
        const std::string text = error.what();  // "[json.exception...] parse error at line 3, column 5: ..."
        const auto at = text.find("at line");
        throw Error(fmt::format("{}: not {}: the JSON is malformed{}", file.string(), what,
                                at == std::string::npos ? "" : " " + text.substr(at)));
    }
    throw Error(fmt::format("{}: not {}: expected {}", file.string(), what, expected));
}

}  // namespace

json read_json_object(const std::filesystem::path& file, const char* what, const char* expected) {
    return only_errors(file.c_str(), [&] { return parse(file, what, expected); });
}

}  // namespace wrinkle::io
