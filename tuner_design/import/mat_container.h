// SPDX-License-Identifier: Apache-2.0
#pragma once
// The outer form of a MATLAB v5 file: a header of 128 bytes (text, version 0x0100, "IM" or "MI" for the order of
// bytes), then elements {type u32, size u32, data}: miMATRIX (14), or miCOMPRESSED (15), a deflated miMATRIX.
//
// What libmatio then reads is an image of it: inflated, without objects (mat_object.h), and checked for sizes that the
// file does not hold, for which it would allocate and search for minutes. Compressed texts that libmatio 1.5.23 has
// written claim more bytes than they have, and are refused as damaged.
// Source: MathWorks, MAT-File Format, chapter 1, "Level 5 MAT-File Format".

#include <cstddef>
#include <string>
#include <vector>

#include "tuner_design/import/mat_object.h"

namespace ehm::tuner_design {

struct MatImage {
  std::string bytes;               ///< header and miMATRIX elements
  std::size_t variables = 0;       ///< number of elements
  std::vector<MatObject> objects;  ///< that the file holds beside them, or within them, where zeros stand now
};

/// @throws files::FileError if the file cannot be read, is of another version (v4, v7.3: says how to save it), is no
///         MATLAB file at all, ends within an element, does not inflate, has an element larger than what is around it,
///         or inflates to more than 256 MB.
MatImage read_mat_image(const std::string& path);

}  // namespace ehm::tuner_design
