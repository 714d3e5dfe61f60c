#pragma once

#include <string>

#include "wrinkle/functions.h"

/// functions() as text.
namespace wrinkle {

/// Every function by its concept file, with its variants and their errors.
std::string function_list();

/// All about one function: columns, settings, errors, an example.
std::string function_help(const Function& function);

/// The page kernels/README.md.
std::string reference_page();

/// A command that evaluates one row; files stand for the settings that need one.
std::string function_example(const Function& function);

}  // namespace wrinkle
