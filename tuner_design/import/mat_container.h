#pragma once
// The outer form of a MATLAB v5 file: a header of 128 bytes (text, version 0x0100, "IM" or "MI" for the order of
// bytes), then elements {type u32, size u32, data}: miMATRIX (14) or miCOMPRESSED (15). Checked here, so that a file
// that is cut off is refused as such, and does not seem to lack its last variables. Source: MathWorks, MAT-File Format,
// chapter 1, "Level 5 MAT-File Format".

#include <cstddef>
#include <string>

namespace ehm::bench {

/// Number of elements, which is the number of variables.
/// @throws files::FileError if the file cannot be read, is of another version (v4, v7.3: says how to save it), is no
///         MATLAB file at all, or ends within an element.
std::size_t count_mat_elements(const std::string& path);

}  // namespace ehm::bench
