#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/limits.h"
#include "base/text_file.h"
#include "layers/common.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kKernel = 150;  // expected operations; nobody knows what the user wrote

const KernelLayer& kernel_of(const Layer& layer) { return std::get<KernelLayer>(layer.bump); }

constexpr const char* kNameRule =
    "must be a name as C has them, that is no word of OpenCL C and does not begin with wr_, WR_, M_ or image";

/// Words of OpenCL C that cannot be names. The compiler would report them in generated text, which the user did not
/// write.
constexpr std::string_view kWords[] = {
    "true",     "false",   "NULL",  "auto",   "bool",     "break",  "case",   "char",     "const",   "constant",
    "continue", "default", "do",    "double", "else",     "enum",   "extern", "float",    "for",     "global",
    "goto",     "half",    "if",    "inline", "int",      "kernel", "local",  "long",     "private", "register",
    "restrict", "return",  "short", "signed", "size_t",   "sizeof", "static", "struct",   "switch",  "typedef",
    "uchar",    "uint",    "ulong", "union",  "unsigned", "ushort", "void",   "volatile", "while"};

bool is_name(const std::string& text) {
    const auto letter = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front())) &&
           std::ranges::all_of(text, letter) && !text.starts_with("wr_") && !text.starts_with("WR_") &&
           !text.starts_with("M_") && !text.starts_with("image") && std::ranges::find(kWords, text) == std::end(kWords);
}

/// Reads `parameters`. Their names become members of a structure, their values numbers of the scene.
void read_parameters(scene::Table& table, std::map<std::string, double>& out) {
    for (const std::string& name : table.keys()) out.try_emplace(name);
    for (auto& [name, value] : out) {
        if (!is_name(name)) table.complain(name, kNameRule);
        table.read(name, value);
        table.compiled_in(name, std::string("given"));
    }
    table.finish();
}

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<KernelLayer>(layer);
    table.require("file");
    table.read_file("file", bump.file);
    table.require("function");
    if (table.read("function", bump.function) && !is_name(bump.function)) table.complain("function", kNameRule);
    if (auto parameters = table.table("parameters", "parameters of " + table.where(), !bump.parameters.empty()))
        read_parameters(*parameters, bump.parameters);
    table.choose("over", bump.over_uv, {{"space", false}, {"uv", true}});
    if (auto uv = table.table("uv", "uv of " + table.where(), bump.uv.has_value())) {
        if (!bump.uv) bump.uv.emplace();
        read_uv(*uv, *bump.uv);
    }
    if (bump.over_uv && !bump.uv) bump.uv.emplace();
    table.compiled_in("uv", bump.uv.has_value());
    scene::read_project(table, layer);
    scene::read_weight(table, layer);
    layer.bump = bump;
}

/// The line, from 1 on, where `name` stands as a word that a parenthesis follows; 0 where it never does.
std::size_t line_of_function(const std::string& text, const std::string& name) {
    const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::size_t after = text.find_first_not_of(" \t\r\n", at + name.size());
        if ((at == 0 || !letter(text[at - 1])) && after != std::string::npos && text[after] == '(')
            return 1 + static_cast<std::size_t>(
                           std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    }
    return 0;
}

/// The line of a brace that has no partner; 0 where all have one. The compiler would report it in the text after the
/// file, which the user did not write.
std::size_t line_of_lone_brace(std::string_view text) {
    std::vector<std::size_t> open;  // lines
    std::size_t line = 1;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view rest = text.substr(i);
        if (rest.starts_with("//")) {
            i = std::min(text.find('\n', i), text.size()) - 1;
        } else if (rest.starts_with("/*")) {
            const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 2) + 1;
            line += static_cast<std::size_t>(std::ranges::count(text.substr(i, end - i), '\n'));
            i = end;
        } else if (rest.starts_with('"')) {
            do i = std::min(text.find('"', i + 1), text.size());
            while (i < text.size() && text[i - 1] == '\\');
        } else if (text[i] == '\n') {
            ++line;
        } else if (text[i] == '{') {
            open.push_back(line);
        } else if (text[i] == '}') {
            if (open.empty()) return line;
            open.pop_back();
        }
    }
    return open.empty() ? 0 : open.back();
}

/// Says that what follows is the file's, from a line of it on.
std::string line_directive(std::size_t line, const std::string& file) {
    std::string escaped;
    for (const char c : file) escaped += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return fmt::format("#line {} \"{}\"\n", line, escaped);
}

/// Adds the user's file to the kernel text, once for all layers that use it, and the structure of this layer's
/// parameters.
void add_source(LayerText& at, const KernelLayer& l) {
    if (!limits().sandbox.empty())
        throw Error(at.who + ": a kernel is native code on a CPU, which a sandbox cannot hold: it is not run here");
    const std::string file = l.file.string();
    const std::string text = read_text(l.file, "a kernel source");
    if (const std::size_t brace = line_of_lone_brace(text); brace != 0)
        throw Error(fmt::format("{}: {}:{}: this brace has no partner", at.who, file, brace));
    const std::size_t line = line_of_function(text, l.function);
    if (line == 0)
        throw Error(
            fmt::format("{}: {} has no function \"{}\"; it must be: wr_fn wr_dual {}(wr_bump_point at, "
                        "{}_parameters k)",
                        at.who, file, l.function, l.function, l.function));
    std::string members;
    for (const auto& [name, value] : l.parameters) members += fmt::format("    WR_SCALAR {};\n", name);
    if (members.empty()) members = "    WR_SCALAR none;\n";
    const std::string type = fmt::format("typedef struct {{\n{}}} {}_parameters;\n", members, l.function);
    const auto [known, added] = at.emitter.user_parameters.try_emplace(l.function, type);
    if (known->second != type)
        throw Error(fmt::format("{}: another layer gives \"{}\" other parameters; a function has one list of them",
                                at.who, l.function));
    constexpr const char* back = "#line 1 \"evaluate.cl\"\n";
    at.emitter.user_files[file] = line_directive(1, file) + text + "\n" + back;
    if (!added) return;
    // Called by another name, the function may have one that variables of the kernel have; and a compiler that finds
    // its signature wrong says so of the user's line.
    at.emitter.helpers +=
        line_directive(line, file) +
        fmt::format("wr_fn wr_dual wr_user_{0}(wr_bump_point at, {0}_parameters k) {{ return {0}(at, k); }}\n",
                    l.function) +
        back;
}

std::string emit(LayerText& at) {
    const KernelLayer& l = kernel_of(at.layer);
    if (!is_name(l.function)) throw Error(fmt::format("{}: \"{}\" is no name of a function", at.who, l.function));
    for (const auto& [name, value] : l.parameters)
        if (!is_name(name)) throw Error(fmt::format("{}: \"{}\" is no name of a parameter", at.who, name));
    if (l.over_uv && !l.uv) throw Error(at.who + ": a gradient along s and t needs a uv");
    add_source(at, l);
    at.section.reads.insert({"p", "n"});
    if (at.layer.footprint) at.section.reads.insert({"dp_dx", "dp_dy"});
    at.section.operations += kKernel;

    std::string text,
        coordinates = "{(wr_real)(0), (wr_real)(0)}, {(wr_real)(0), (wr_real)(0)}, {(wr_real)(0), (wr_real)(0)}";
    if (l.uv) {
        text = emit_texcoord(at.emitter, at.layer, own_uv, Wrap::clamp, at.who, at.section);
        if (l.uv->source == UvSource::aov) text += "        m = uv_valid ? m : (wr_real)(0);\n";
        coordinates = "c.st, c.dx, c.dy";
        if (at.over_area() && l.over_uv) at.prepared += text;
    }
    std::string parameters;
    for (const auto& [name, value] : l.parameters)
        parameters += (parameters.empty() ? "" : ", ") +
                      at.number("parameter " + name,
                                [name = name](const Layer& layer) { return kernel_of(layer).parameters.at(name); });
    text += fmt::format(
        "        wr_bump_point point = {{wr_world_position(camera, p), n, {}, {}}};\n"
        "        {}_parameters parameters = {{{}}};\n"
        "        wr_dual f = wr_user_{}(point, parameters);\n",
        coordinates, at.layer.footprint ? "wr_footprint_size(dp_dx, dp_dy)" : "(wr_real)(0)", l.function,
        parameters.empty() ? "0" : parameters, l.function);
    if (!l.over_uv) return text + at.volume("f.gradient");
    return text + "        wr_vec2 slope = wr_v2(f.gradient.x, f.gradient.y);\n" +
           at.slopes("scale_dependent", "c.dx, c.dy, slope");
}

/// Every function has costs of its own.
CostKind cost(const Layer& layer) { return {"kernel " + kernel_of(layer).function}; }

}  // namespace

const LayerKind& layers::kernel() {
    static constexpr LayerKind row{
        .name = KernelLayer::kind, .read = read, .emit = emit, .users_own = true, .cost = cost};
    return row;
}

}  // namespace wrinkle
