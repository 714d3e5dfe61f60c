#pragma once

#include <set>
#include <string>
#include <vector>

#include "wrinkle/plane_format.h"

/// Planes in other formats than one float a pixel, as kernel text. Kernels know them by the names that planes of floats
/// have, too; only their arguments and declarations differ.
namespace wrinkle {

/// The formats of those planes that are not simply floats. Throws Error, which begins with `who`, for one that cannot
/// be: numbers off their alignment or beyond their pixels, scales of encodings that have none, a memory of two strides
/// or of another plane's name. `apart`: planes are written, so none may lie where another does.
PlaneFormats checked_formats(const PlaneFormats& formats, const std::string& who, bool apart);

/// Throws Error, which begins with `who`, unless all that have a format are planes.
void require_planes(const PlaneFormats& formats, const std::set<std::string>& planes, const std::string& who);

/// Where planes are, each once: themselves if they are floats, else by the names of their memories.
std::vector<std::string> memories_of(const std::vector<std::string>& planes, const PlaneFormats& formats);
/// Bytes from pixel to pixel of such a memory.
std::uint32_t pixel_bytes(const std::string& memory, const PlaneFormats& formats);
/// What such a memory must be aligned to where vectors of so many lanes are stored to it: their numbers together where
/// one plane has it to itself, else a number.
std::uint32_t store_alignment(const std::string& memory, const PlaneFormats& formats, int lanes);
/// Whether planes leave bytes of its pixels out.
bool has_gaps(const std::string& memory, const PlaneFormats& formats);

/// Whether a plane holds bits that no arithmetic may touch: Cryptomatte's ids.
bool holds_bits(const std::string& plane);

/// Kernel text: the arguments for the planes that a kernel reads, in the order of memories_of(); what goes before its
/// statements; the type of a plane that is read.
std::string input_arguments(const std::vector<std::string>& planes, const PlaneFormats& formats);
std::string input_declarations(const std::vector<std::string>& planes, const PlaneFormats& formats);
std::string input_type(const std::string& plane, const PlaneFormats& formats);

/// The same of the planes that it writes.
std::string output_arguments(const std::vector<std::string>& planes, const PlaneFormats& formats);
std::string output_declarations(const std::vector<std::string>& planes, const PlaneFormats& formats);

/// Whether the normal is stored octahedrally.
bool is_octahedral(const PlaneFormats& formats);

}  // namespace wrinkle
