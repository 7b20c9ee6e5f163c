// SPDX-License-Identifier: Apache-2.0
#pragma once
// Objects in a MATLAB v5 file: strings in double quotes, tables, ss, timeseries and whatever else has a class. What
// they hold lies apart, in a form that no document describes; libmatio takes them for something else, and their name
// for "MCOS". So they are found here, by the name and class that their own element states, and kept from it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ehm::tuner_design {

struct MatObject {
  std::string name;        ///< of the variable; of a field: structure.field
  std::string class_name;  ///< "string", "table", "ss", ...
};

/// What this array (the content of a miMATRIX element that is sound) is, if it is an object.
std::optional<MatObject> object_in(std::string_view array, bool little_endian);

/// Makes zeros of the objects within this array, at any depth, and returns them.
std::vector<MatObject> hide_objects(std::string& image, std::size_t array_begin, bool little_endian);

/// How to save what the object holds, for a message: "Save it as a cell array of texts, x = cellstr(x)".
std::string saved_otherwise(const MatObject& object);

/// A model of MATLAB's toolboxes for control: ss, tf, idss ...
bool is_system(const MatObject& object);

}  // namespace ehm::tuner_design
