// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/mat_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"
#include "deploy/runtime/numbers/index.h"
#include "tuner_design/import/mat_container.h"
#include "tuner_design/import/mat_value.h"

namespace ehm::tuner_design {
namespace {

using files::FileError;
using MatFile = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using MatVariable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

/// A file that is nowhere on a disk, for a library that reads only files.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content) : descriptor_(memfd_create("ehm-import", MFD_CLOEXEC)) {
    while (descriptor_ >= 0 && !content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) break;
      content.remove_prefix(as_size(written));
    }
    if (descriptor_ >= 0 && content.empty()) return;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw std::runtime_error("no memory file can be made for a MATLAB file");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// What stands at the top level of the file, without its data.
struct Directory {
  std::vector<std::string> names;
  std::vector<std::string> structures;  ///< those of them that have a field A
  std::vector<std::string> linmod;      ///< those that have fields a, b, c, d instead: what linmod and dlinmod return
};

/// The names that linmod gives to what a model needs.
constexpr std::array<std::pair<const char*, const char*>, 7> linmod_names{{{"a", "A"},
                                                                           {"b", "B"},
                                                                           {"c", "C"},
                                                                           {"d", "D"},
                                                                           {"StateName", "state_names"},
                                                                           {"InputName", "control_names"},
                                                                           {"OutputName", "sensor_names"}}};

/// The name that this project has for what linmod names so; the same for others.
std::string from_linmod(const std::string& name) {
  for (const auto& [theirs, ours] : linmod_names)
    if (name == theirs) return ours;
  return name;
}

bool is_number(const std::string& name) {
  return contains(matrix_variables, name) || contains(vector_variables, name) || contains(scalar_variables, name);
}

bool is_known(const std::string& name) {
  return is_number(name) || contains(text_variables, name);
}

bool has_field(const matvar_t& structure, const std::string& name) {
  char* const* fields = Mat_VarGetStructFieldnames(&structure);
  const unsigned count = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&structure));
  return fields != nullptr && std::find(fields, fields + count, name) != fields + count;
}

Directory read_directory(mat_t* file, const std::string& path, std::size_t count) {
  Directory directory;
  for (std::size_t i = 0; i < count; ++i) {
    const MatVariable variable(Mat_VarReadNextInfo(file), &Mat_VarFree);
    if (!variable) {
      throw FileError(path + ": variable " + std::to_string(i + 1) + " of " + std::to_string(count) +
                      " cannot be read; the file is damaged, or it is an object. Save only the matrices, with -v7.");
    }
    if (variable->name == nullptr || *variable->name == '\0') continue;  // what belongs to MATLAB's objects
    const std::string name = variable->name;
    if (std::find(directory.names.begin(), directory.names.end(), name) != directory.names.end())
      throw FileError(path + ": variable " + name + " is there twice. Save it once.");
    directory.names.push_back(name);
    if (variable->class_type != MAT_C_STRUCT) continue;
    if (has_field(*variable, "A"))
      directory.structures.push_back(name);
    else if (has_field(*variable, "a") && has_field(*variable, "c"))
      directory.linmod.push_back(name);
  }
  return directory;
}

void take(const matvar_t& variable, const std::string& name, Variables& result) {
  const std::string place = result.source + ": " + name;
  if (is_number(name)) {
    result.numbers[name] = mat_numbers(variable, place);
  } else {
    result.texts[name] = mat_texts(variable, place);
  }
}

MatVariable read_variable(mat_t* file, const std::string& name, const std::string& path) {
  MatVariable variable(Mat_VarRead(file, name.c_str()), &Mat_VarFree);
  if (!variable) throw FileError(path + ": variable " + name + " cannot be read; the file is damaged. Save it again.");
  return variable;
}

/// An object in the place of something that is needed is refused, others are told as ignored.
void refuse_or_ignore(const MatObject& object, const std::string& known_name, Variables& result) {
  if (!is_known(known_name)) {
    result.ignored.push_back(object.name + " (an object of class " + object.class_name + ")");
    return;
  }
  throw FileError(result.path + ": " + object.name + " is an object of class " + object.class_name +
                  "; allowed: a matrix of numbers, a text, or a cell array of texts. " + saved_otherwise(object) + ".");
}

/// Objects that are variables of their own, or fields of the structure `within`.
void take_objects(const std::vector<MatObject>& objects, const std::string& within, bool linmod, Variables& result) {
  const std::string prefix = within.empty() ? "" : within + ".";
  for (const MatObject& object : objects) {
    if (!object.name.starts_with(prefix)) continue;
    const std::string name = object.name.substr(prefix.size());
    if (name.find('.') == std::string::npos) refuse_or_ignore(object, linmod ? from_linmod(name) : name, result);
  }
}

void take_structure(mat_t* file, const std::string& name, bool linmod, Variables& result) {
  const MatVariable structure = read_variable(file, name, result.path);
  result.source += ": " + name;
  if (structure->rank != 2 || structure->dims[0] * structure->dims[1] != 1)
    throw FileError(result.source +
                    " is an array of structures; allowed: one. Save the element for one operating point.");
  char* const* fields = Mat_VarGetStructFieldnames(structure.get());
  const unsigned count = Mat_VarGetNumberOfFields(structure.get());
  for (unsigned i = 0; i < count; ++i) {
    const std::string field = linmod ? from_linmod(fields[i]) : fields[i];
    if (!is_known(field)) {
      result.ignored.push_back(field);
      continue;
    }
    const matvar_t* value = Mat_VarGetStructFieldByIndex(structure.get(), i, 0);
    if (value == nullptr) throw FileError(result.source + ": " + field + " cannot be read. Save it again.");
    take(*value, field, result);
  }
}

/// What stands beside the structure that holds the model. It may be of another model, and may be meant for this one: what
/// this one would need and lacks is not passed over.
void check_beside(const Directory& directory, const std::vector<MatObject>& objects, const std::string& structure,
                  Variables& result) {
  const auto check = [&](const std::string& name, const std::string& shown) {
    if (!is_known(name)) {
      result.ignored.push_back(shown);
    } else if (result.find(name) == nullptr && !result.texts.contains(name)) {
      throw FileError(result.path + ": " + shown + " stands beside the structure " + structure +
                      ", which holds the model "
                      "and has no " +
                      name + "; allowed: all of the model in one place. Save it as " + structure + "." + name +
                      ", or leave it out of the file.");
    }
  };
  for (const MatObject& object : objects)
    if (object.name.find('.') == std::string::npos)
      check(object.name, object.name + " (an object of class " + object.class_name + ")");
  for (const std::string& name : directory.names)
    if (name != structure) check(name, name);
}

/// All but the structure `taken`, which has been read already.
void take_top_level(mat_t* file, const Directory& directory, bool linmod, const std::string& taken, Variables& result) {
  for (const std::string& theirs : directory.names) {
    if (theirs == taken) continue;
    const std::string name = linmod ? from_linmod(theirs) : theirs;
    if (!is_known(name)) {
      result.ignored.push_back(theirs);
    } else if (result.find(name) == nullptr && !result.texts.contains(name)) {
      take(*read_variable(file, theirs, result.path), name, result);
    }
  }
}

/// What linmod returns has no health parameters.
void explain_linmod(const std::string& what, const Variables& result) {
  if (result.find("L") != nullptr && result.find("M") != nullptr) return;
  throw FileError(
      result.path + ": " + what +
      " has a, b, c, d, as linmod returns them, which are A, B, C, D here; a model also needs L and M, the "
      "effect of health on states and sensors. Let the health parameters be further inputs when you "
      "linearise, then save L = b(:,k+1:end), M = d(:,k+1:end), and the first k columns of b and d as B and "
      "D, beside A = a and C = c.");
}

void require_one(const std::vector<std::string>& structures, const char* field, const std::string& path) {
  if (structures.size() < 2) return;
  std::string names;
  for (const std::string& name : structures) names += (names.empty() ? "" : ", ") + name;
  throw FileError(path + ": the structures " + names + " have a field " + field +
                  "; allowed: one model in a file. Save one.");
}

/// A is at the top level, or in one structure; or a, as linmod has it.
void take_all(mat_t* file, const Directory& directory, const std::vector<MatObject>& objects, Variables& result) {
  const auto at_top = [&](const char* name) {
    return std::find(directory.names.begin(), directory.names.end(), name) != directory.names.end();
  };
  if (!at_top("A")) require_one(directory.structures, "A", result.path);
  const bool in_structure = !at_top("A") && directory.structures.size() == 1;
  if (in_structure) {
    take_objects(objects, directory.structures.front(), false, result);
    take_structure(file, directory.structures.front(), false, result);
    return check_beside(directory, objects, directory.structures.front(), result);
  }
  const bool linmod_at_top = !at_top("A") && at_top("a") && at_top("c");
  const bool linmod = !at_top("A") && !linmod_at_top && !directory.linmod.empty();
  if (linmod) {
    require_one(directory.linmod, "a", result.path);
    take_objects(objects, directory.linmod.front(), true, result);
    take_structure(file, directory.linmod.front(), true, result);
  }
  take_objects(objects, "", linmod_at_top, result);
  take_top_level(file, directory, linmod_at_top, linmod ? directory.linmod.front() : "", result);
  if (linmod || linmod_at_top) explain_linmod(linmod ? directory.linmod.front() : "the file", result);
  const auto system = std::find_if(objects.begin(), objects.end(), is_system);
  if (result.find("A") == nullptr && system != objects.end())
    throw FileError(result.path + ": A is missing or empty, and " + system->name + " is an object of class " +
                    system->class_name + ". " + saved_otherwise(*system) +
                    ", and L and M, the effect of health on states and sensors.");
}

}  // namespace

bool is_mat_file(const std::string& path) {
  std::string ending = path.size() < 4 ? "" : path.substr(path.size() - 4);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".mat") return true;
  files::require_input_file(path, files::matlab_file);
  std::ifstream in(path, std::ios::binary);
  std::string start(6, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == "MATLAB";
}

Variables read_mat_file(const std::string& path) {
  const MatImage image = read_mat_image(path);
  const MemoryFile memory(image.bytes);
  const MatFile file(Mat_Open(memory.path().c_str(), MAT_ACC_RDONLY), &Mat_Close);
  if (!file) throw FileError(path + ": cannot be opened as a MATLAB v5 file. Save it again with -v7.");
  Variables result;
  result.path = path;
  result.source = path;
  result.format = "MATLAB v5 file";
  take_all(file.get(), read_directory(file.get(), path, image.variables), image.objects, result);
  return result;
}

}  // namespace ehm::tuner_design
