#pragma once

#include "functions/column_kernel.h"
#include "wrinkle/functions.h"

/// The rows of functions(), one file a concept.
namespace wrinkle {

std::vector<Function> surface_functions();
std::vector<Function> source_functions();
std::vector<Function> projector_functions();
std::vector<Function> volume_functions();
std::vector<Function> noise_functions();
std::vector<Function> compose_functions();
std::vector<Function> prologue_functions();
std::vector<Function> displacement_functions();

/// The kernel that computes every result, and its outputs in the order of the results' columns.
ColumnKernel column_kernel(const Function& function, const FunctionVariant& variant);

/// Every function in every precision as a kernel wr_columns_FUNCTION_PRECISION, as evaluate_function() builds them one
/// by one: for those who want to know what a compiler makes of them.
std::string every_column_kernel();

/// How many constants or records a setting takes up; constants follow one another in the order of the settings.
struct SettingSize {
    std::size_t constants = 0, records = 0;
};
SettingSize size_of(const Setting& setting);

/// The numbers that a setting takes, "whole numbers from 1 to 16"; empty where any will do.
std::string range_text(const Setting& setting);

/// "3 numbers"
const char* wanted_text(Setting::Kind kind);

/// The numbers and textures of the settings. Throws Error for one that is missing, unknown, of another kind, or too
/// large for the device.
ColumnData column_data(const Function& function, const std::map<std::string, SettingValue>& values,
                       const DeviceInfo& device);

}  // namespace wrinkle
