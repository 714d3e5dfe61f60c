#include "functions/kernel_listing.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>

namespace wrinkle {

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

bool begins_function(const std::string& line) {
    static const std::regex start("^(wr_fn|wr_long_fn|wr_rare_fn|static inline) ");
    return std::regex_search(line, start);
}

/// The declaration from line `at` on, up to its body, without what is before the type.
std::string declaration(const std::vector<std::string>& lines, std::size_t at) {
    std::string text;
    for (; at < lines.size(); ++at) {
        const std::size_t body = lines[at].find('{');
        text += lines[at].substr(0, body);
        if (body != std::string::npos) break;
        text += '\n';
    }
    text.erase(text.find_last_not_of(" \n") + 1);
    const std::size_t type = text.find(' ') + 1;
    std::string out;
    for (std::string line : lines_of(text.substr(type))) {
        if (!out.empty()) line.erase(0, std::min(type, line.find_first_not_of(' ')));
        out += line + '\n';
    }
    out.back() = ';';
    return out;
}

/// The declarations of functions that a macro defines: one for every use of the macro in the file.
std::vector<std::string> macro_declarations(const std::vector<std::string>& lines, std::size_t at) {
    static const std::regex define("^#define (\\w+)\\(NAME\\b");
    std::smatch found;
    if (!std::regex_search(lines[at], found, define)) return {};
    const std::string macro = found[1];
    std::vector<std::string> body, declarations;
    for (++at; at < lines.size() && lines[at].ends_with('\\'); ++at) {
        std::string line = lines[at].substr(0, lines[at].size() - 1);
        line.erase(line.find_last_not_of(' ') + 1);
        body.push_back(line.substr(std::min<std::size_t>(4, line.size())));
    }
    const std::string pattern = declaration(body, 0);
    const std::size_t name = pattern.find("NAME");
    for (const std::string& line : lines)
        if (line.starts_with(macro + "(")) {
            const std::string used = line.substr(macro.size() + 1, line.find(',') - macro.size() - 1);
            std::string text = pattern;
            text.replace(name, 4, used);
            const std::string further(used.size() > 4 ? used.size() - 4 : 0, ' ');  // keeps parameters aligned
            for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', end + 1))
                text.insert(end + 1, further);
            declarations.push_back(text);
        }
    return declarations;
}

/// A struct or macro from line `at` on, as it is written.
std::string other_declaration(const std::vector<std::string>& lines, std::size_t at) {
    if (lines[at].starts_with("#define")) return lines[at];
    std::string text = lines[at];
    while (text.find(';', text.rfind('}') == std::string::npos ? text.size() : text.rfind('}')) == std::string::npos &&
           ++at < lines.size())
        text += '\n' + lines[at];
    return text;
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

}  // namespace

std::vector<KernelItem> kernel_items(const std::string& text) {
    const std::vector<std::string> lines = lines_of(text);
    std::vector<KernelItem> items;
    bool follows = false;  // a blank line ends what belongs to an item
    for (std::size_t at = 0; at < lines.size(); ++at) {
        if (lines[at].starts_with("///")) {
            KernelItem item;
            for (; lines[at].starts_with("///"); ++at) item.comment += lines[at] + '\n';
            item.declarations = macro_declarations(lines, at);
            item.function = !item.declarations.empty() || begins_function(lines[at]);
            if (item.declarations.empty())
                item.declarations = {item.function ? declaration(lines, at) : other_declaration(lines, at)};
            items.push_back(item);
            follows = true;
        } else if (lines[at].empty()) {
            follows = false;
        } else if (follows && begins_function(lines[at]) && items.back().function) {
            items.back().declarations.push_back(declaration(lines, at));
        }
    }
    return items;
}

std::string kernel_file_summary(const std::string& text) {
    std::string summary;
    for (const std::string& line : lines_of(text)) {
        if (!line.starts_with("//")) break;
        summary += line.substr(std::min<std::size_t>(3, line.size())) + '\n';
    }
    return summary;
}

std::vector<LayoutStruct> layout_structs(const std::string& text) {
    static const std::regex member("(\\w+)(?:\\[(\\d+)\\])?\\s*[,;]"), end("^\\} (\\w+);");
    std::vector<LayoutStruct> structs;
    std::string comment, above;
    bool inside = false;
    for (const std::string& line : lines_of(text)) {
        const std::size_t slashes = line.find("//");
        const std::string said = slashes == std::string::npos ? "" : trimmed(line.substr(slashes + 2));
        std::string code = trimmed(line.substr(0, slashes));
        std::smatch found;
        if (code.starts_with("typedef struct")) {
            structs.push_back({"", comment, {}, 0});
            inside = true, above.clear();
        } else if (inside && std::regex_search(line, found, end)) {
            structs.back().name = found[1];
            inside = false;
        } else if (inside && code.starts_with("WR_SCALAR ")) {
            code.erase(0, 10);
            for (std::sregex_iterator at(code.begin(), code.end(), member), none; at != none; ++at) {
                LayoutStruct& to = structs.back();
                const std::size_t count = (*at)[2].matched ? std::stoul((*at)[2]) : 1;
                to.members.push_back({(*at)[1], said.empty() ? above : said, to.size, count});
                to.size += count;
            }
        } else if (inside && code.empty()) {
            above = said;
        }
        comment = !inside && code.empty() && !said.empty() ? (comment.empty() ? said : comment + ' ' + said) : "";
    }
    return structs;
}

}  // namespace wrinkle
