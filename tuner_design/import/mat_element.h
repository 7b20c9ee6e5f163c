// SPDX-License-Identifier: Apache-2.0
#pragma once
// Whether an array of a MATLAB v5 file holds what its sizes claim, with everything in it. An array (miMATRIX) is
//   flags {class, complex}, dimensions, name, then by class: numbers or characters; row numbers, column starts and
//   values (sparse); an array for each cell; the names' length, the names, and an array for each field (structure).
// An element {type u32, size u32, data} is padded to 8 bytes; one of at most 4 bytes is {type u16, size u16, data}.
// Source: MathWorks, MAT-File Format, chapter 1, "Level 5 MAT-File Format".

#include <string_view>

namespace ehm::tuner_design {

/// `content` is what follows the tag of the miMATRIX element. Objects and functions are not looked into.
bool is_sound_array(std::string_view content, bool little_endian, int depth = 0);

}  // namespace ehm::tuner_design
