#pragma once

#include <cstddef>
#include <span>

/// Object numbers. A frame may hold them as whole numbers of 32 bits, as floats (which filters average: 2.9999998 for
/// 3), or as the bits of floats. Kernels compare floats, so numbers get labels first.
namespace wrinkle::io {

/// The float that stands for an object number: the number itself up to 2^24, as long as floats hold all of them; above,
/// the float of the number's bits, normal and finite. Numbers that are not whole stand for themselves.
float object_label(double number);
/// The number that a label of a whole number stands for, to be told.
double object_number(float label);

enum class ObjectStorage {
    whole,   ///< unsigned integers
    single,  ///< floats that hold the number
    bits,    ///< floats whose bits are the number
};

/// What a sample of an object plane of floats holds: bits, if a value is too small to be anything else, or if most are
/// no whole numbers, and yet few differ.
ObjectStorage object_storage(std::span<const float> sample);

/// Brings stored values into labels, in place; integers come as their bits. Floats near a whole number become it.
void label_objects(std::span<float> values, ObjectStorage storage);

/// Whether a float is no object's number but a mixture of several: an edge that the renderer's filter has averaged.
bool is_mixed_object(float stored);

}  // namespace wrinkle::io
