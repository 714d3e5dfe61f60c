#pragma once

#include <string>
#include <vector>

/// What the kernel files declare, as their comments describe it: the text of kernels/README.md.
namespace wrinkle {

/// A declaration with the comment above it.
struct KernelItem {
    std::string comment;                    ///< "/// " lines, each with its line break
    std::vector<std::string> declarations;  ///< overloads share a comment; C, without the body
    bool function = false;                  ///< else a struct or a macro
};

/// The commented declarations of a kernel file, in order. A function without a comment of its own that follows another
/// directly is an overload of it; one after a blank line is an inner matter of the file, and left out.
std::vector<KernelItem> kernel_items(const std::string& text);

/// The comment that a kernel file begins with, without its slashes.
std::string kernel_file_summary(const std::string& text);

/// A member of a struct of layout.h.
struct LayoutMember {
    std::string name, meaning;
    std::size_t offset = 0, count = 1;  ///< in WR_SCALARs
};

struct LayoutStruct {
    std::string name, meaning;
    std::vector<LayoutMember> members;
    std::size_t size = 0;  ///< in WR_SCALARs
};

/// The structs of layout.h, which `text` is.
std::vector<LayoutStruct> layout_structs(const std::string& text);

}  // namespace wrinkle
