// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/data_path.h"

#include <cstdlib>
#include <filesystem>

#include "core/errors.h"

namespace sidestep {

std::string withVariables(const std::string& path, const std::string& where, const std::string& or_else) {
  std::string out = path;
  for (size_t from = out.find("${"); from != std::string::npos; from = out.find("${", from)) {
    const size_t to = out.find('}', from);
    if (to == std::string::npos) throw ConfigError(where + ": " + path + ": ${ without }");
    const std::string name = out.substr(from + 2, to - from - 2);
    const char* value = std::getenv(name.c_str());
    if (value == nullptr || *value == '\0')
      throw DatasetError::missing(where + ": " + path + ": the environment variable " + name +
                                  " is not set; set it to the folder of the data" + or_else);
    out.replace(from, to + 1 - from, value);
  }
  return out;
}

std::string resolvedPath(const std::string& path, const std::string& study_file) {
  const std::filesystem::path file(withVariables(path, study_file, ", or leave these scenarios out with --scenarios"));
  return (file.is_absolute() ? file : std::filesystem::path(study_file).parent_path() / file)
      .lexically_normal()
      .string();
}

}  // namespace sidestep
