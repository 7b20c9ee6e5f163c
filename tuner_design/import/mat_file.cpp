#include "tuner_design/import/mat_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "deploy/files/file_error.h"
#include "tuner_design/import/mat_container.h"
#include "tuner_design/import/mat_value.h"

namespace ehm::bench {
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
      content.remove_prefix(static_cast<std::size_t>(written));
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
};

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
    if (variable->class_type == MAT_C_STRUCT && has_field(*variable, "A")) directory.structures.push_back(name);
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

void take_structure(mat_t* file, const std::string& name, Variables& result) {
  const MatVariable structure = read_variable(file, name, result.path);
  result.source += ": " + name;
  if (structure->rank != 2 || structure->dims[0] * structure->dims[1] != 1)
    throw FileError(result.source +
                    " is an array of structures; allowed: one. Save the element for one operating point.");
  char* const* fields = Mat_VarGetStructFieldnames(structure.get());
  const unsigned count = Mat_VarGetNumberOfFields(structure.get());
  for (unsigned i = 0; i < count; ++i) {
    const std::string field = fields[i];
    if (!is_known(field)) {
      result.ignored.push_back(field);
      continue;
    }
    const matvar_t* value = Mat_VarGetStructFieldByIndex(structure.get(), i, 0);
    if (value == nullptr) throw FileError(result.source + ": " + field + " cannot be read. Save it again.");
    take(*value, field, result);
  }
}

/// A is at the top level, or in one structure.
void take_all(mat_t* file, const Directory& directory, Variables& result) {
  const bool at_top = std::find(directory.names.begin(), directory.names.end(), "A") != directory.names.end();
  if (!at_top && directory.structures.size() > 1) {
    std::string names;
    for (const std::string& name : directory.structures) names += (names.empty() ? "" : ", ") + name;
    throw FileError(result.path + ": the structures " + names +
                    " have a field A; allowed: one model in a file. Save one.");
  }
  if (!at_top && directory.structures.size() == 1) return take_structure(file, directory.structures.front(), result);
  for (const std::string& name : directory.names) {
    if (!is_known(name)) {
      result.ignored.push_back(name);
      continue;
    }
    take(*read_variable(file, name, result.path), name, result);
  }
}

}  // namespace

bool is_mat_file(const std::string& path) {
  std::string ending = path.size() < 4 ? "" : path.substr(path.size() - 4);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".mat") return true;
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
  take_all(file.get(), read_directory(file.get(), path, image.variables), result);
  return result;
}

}  // namespace ehm::bench
