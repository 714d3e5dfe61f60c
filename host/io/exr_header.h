#pragma once

#include <memory>

#include "base/input_file.h"

namespace wrinkle::io {

/// Judges the header of an EXR file before any library reads it: OpenEXR takes memory for a row of blocks as wide as a
/// header says, and its two parsers (of OpenEXR and OpenEXRCore) differ about an attribute that is there twice.
///
/// Throws Error when an attribute that decides about the layout is there twice, an attribute is longer than the file,
/// or the file is too small for the blocks or the frame that it claims. Whatever else may be wrong with it is left to
/// the libraries.
void check_exr_header(const std::shared_ptr<const InputFile>& file);

}  // namespace wrinkle::io
