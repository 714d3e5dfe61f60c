#pragma once

#include <string>

#include "cli/commands.h"

/// What the program does about the process that it is, before and beside its commands.
namespace wrinkle::cli {

/// Makes a process that cannot be ended by what is around it without a word: signals, closed streams, a home that
/// cannot be written to, a library that gives up.
void prepare_process();

/// --memory and --sandbox, of all commands; volumes are read by a process of their own.
void add_limit_options(CLI::App& app);

/// "wrinkle: TEXT" on standard error, if there is one. Never throws.
void tell(const std::string& text) noexcept;

}  // namespace wrinkle::cli
